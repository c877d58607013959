#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "signweave/formats/eaf/eaf.h"

/// Annotation files of every format that is read: EAF and ANVIL. Which of them a text is, its root element tells.
namespace signweave::annotation_file {

using File = eaf::File;
using Unsound = eaf::Unsound;

/// True for the names of files that can be annotation: .eaf, .anvil.
bool is_name(const std::filesystem::path& path);

/// The format of a text: ANVIL where its root element is ANVIL's; else EAF, whose reader tells what is wrong.
SourceFormat format_of(std::string_view text);

/// Reads a file, an ANVIL file with the specification beside it. Throws as eaf::read and anvil::read do.
File read(const std::filesystem::path& path, Unsound unsound = Unsound::left_out);

/// The same from text. `specification`: of an ANVIL document, what it was read with (AnnotationDocument).
File read_text(std::string name, std::string_view text, std::string_view specification = {});

/// Changes with everything that a file is read from: its bytes and, for ANVIL, those of the specification beside it.
std::uint64_t fingerprint(const std::filesystem::path& path);

}  // namespace signweave::annotation_file
