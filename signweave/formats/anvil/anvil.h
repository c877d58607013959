#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "signweave/formats/eaf/eaf.h"

/// ANVIL's annotation files (.anvil), read together with the specification that they name. They are not written: a
/// document that was read from one is written as EAF (eaf::write_text).
///
/// The contents are mapped as follows:
/// - a track is a tier of its name, groups included ("Hands.right.phase"). Primary tracks and spans have their own
///   times; a subdivision divides its reference's annotations in time, a singleton is associated with them;
/// - an element is an annotation. Its label is the attribute named like the last part of the track's name, else
///   `token`, else the one that the specification displays, else the first one. The n-th element of the file has the id
///   "aN";
/// - every other attribute is a child tier "TRACK.attribute", associated one to one; comments are one of them. Its
///   annotations have the ids "aN.2", "aN.3" …;
/// - value sets are controlled vocabularies of the same name; media and other files of the head are linked files; the
///   head's `info` are properties.
/// Times, given in seconds, are rounded to whole milliseconds. A point becomes an annotation of 1 ms.
namespace signweave::anvil {

using File = eaf::File;

/// The maximum size of a specification, in bytes.
inline constexpr std::size_t kLargestSpecification = std::size_t{1} << 24;

/// Reads a file, together with the specification that its head names if that lies in the same folder (no other folder
/// is searched). Throws Error{bad_input, "FILE:LINE: …"} if it is not an ANVIL document: a dangling reference, a cycle
/// of tracks, two elements with one index, an invalid time.
File read(const std::filesystem::path& path);

/// Reads from text; `name` is the file name in errors, `specification` is the specification's text, or empty.
File read_text(const std::string& name, std::string_view text, std::string_view specification = {});

/// The path of the specification that a file is read with, or an empty path.
std::filesystem::path specification_of(const std::filesystem::path& path);

}  // namespace signweave::anvil
