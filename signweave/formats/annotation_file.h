#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "signweave/formats/eaf/eaf.h"

/// Annotation files of every format that can be read: EAF and ANVIL. The format of a text is determined by its root
/// element.
namespace signweave::annotation_file {

using File = eaf::File;
using Unsound = eaf::Unsound;

/// True for the extensions of annotation files: .eaf, .anvil.
bool is_name(const std::filesystem::path& path);

/// The format of a text: ANVIL if its root element is ANVIL's; otherwise EAF, whose reader reports what is wrong.
SourceFormat format_of(std::string_view text);

/// Reads a file; an ANVIL file together with the specification next to it. Throws as eaf::read and anvil::read do.
File read(const std::filesystem::path& path, Unsound unsound = Unsound::left_out);

/// Reads from text. `specification`: for an ANVIL document, the one it was read with (AnnotationDocument).
File read_text(std::string name, std::string_view text, std::string_view specification = {});

/// Changes with everything a file is read from: its bytes and, for ANVIL, those of the specification next to it.
std::uint64_t fingerprint(const std::filesystem::path& path);

}  // namespace signweave::annotation_file
