#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "signweave/formats/eaf/eaf.h"

/// ANVIL's annotation files (.anvil), read together with the specification that they name. They are not written: a
/// document that was read from one is written as EAF (eaf::write_text).
///
/// What becomes of what is in one:
/// - a track is a tier of its name, groups included ("Hands.right.phase"). Primary tracks and spans have their own
///   times; a subdivision divides its reference's annotations in time, a singleton is associated with them;
/// - an element is an annotation. Its label is the attribute that is called like the track's last name, else `token`,
///   else the one that the specification displays, else the first one. The n-th element of the file has the id "aN";
/// - every other attribute is a child tier "TRACK.attribute", associated one to one; comments are one of them. Its
///   annotations have the ids "aN.2", "aN.3" …;
/// - value sets are controlled vocabularies by their names; media and other files of the head are linked files; the
///   head's `info` are properties.
/// Times, in seconds there, are rounded to whole milliseconds. A point becomes an annotation of 1 ms.
namespace signweave::anvil {

using File = eaf::File;

/// A specification beside a file may have so many bytes.
inline constexpr std::size_t kLargestSpecification = std::size_t{1} << 24;

/// Reads a file, with its specification where one of the name that the head gives lies in the same folder (nothing
/// outside of it is looked at). Throws Error{bad_input, "FILE:LINE: …"} for anything that is no ANVIL document: a
/// reference to nothing, a cycle of tracks, two elements of one index, a time that is none.
File read(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in errors, `specification` is the specification's text, or empty.
File read_text(const std::string& name, std::string_view text, std::string_view specification = {});

/// The specification that a file is read with: its path, or an empty one.
std::filesystem::path specification_of(const std::filesystem::path& path);

}  // namespace signweave::anvil
