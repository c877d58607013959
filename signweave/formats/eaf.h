#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/core/error.h"

/// EAF (ELAN annotation format) 2.6 to 3.0. Time slots are known here only.
namespace signweave::eaf {

struct File {
  AnnotationDocument document;
  std::vector<Notice> notices;  ///< oddities that stopped nothing: coincident slots, a tier type that is missing, …
};

/// Reads a document. Times of unaligned slots are interpolated as ELAN does. Throws Error{bad_input, "FILE:LINE: …"}
/// for anything that is no EAF document, has a missing slot, or whose spans are reversed.
File read(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in errors.
File read_text(std::string name, std::string_view text);

/// The document as an EAF file. Where it is as it was read, the very bytes of `document.source`; where it was changed,
/// the bytes of everything that was not, with new elements only for what was. A document without source is written as
/// EAF 3.0 that ELAN opens.
std::string write_text(const AnnotationDocument& document);
/// The same to a file, whole or not at all.
void write(const std::filesystem::path& path, const AnnotationDocument& document);

}  // namespace signweave::eaf
