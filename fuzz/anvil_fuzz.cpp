#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/formats/anvil/anvil.h"

/// Any bytes are read as ANVIL or rejected with an Error, with and without themselves as their specification. A
/// document that was read can be read again from its stored bytes, and is either written as EAF that can be read or
/// rejected.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace signweave;
  // A specification may follow after a zero byte.
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = bytes.find(std::string_view("\0<", 2));
  const std::string_view text = bytes.substr(0, cut);
  const std::string_view specification = cut == bytes.npos ? std::string_view() : bytes.substr(cut + 1);
  AnnotationDocument document;
  try {
    document = anvil::read_text("fuzz.anvil", text, specification).document;
  } catch (const Error&) {
    return 0;
  }
  if (annotation_file::format_of(document.source) == SourceFormat::anvil &&
      annotation_file::read_text("again.anvil", document.source, document.specification).document != document) {
    std::abort();
  }
  signs_in(document, guess_tier_names(document));
  std::string written;
  try {
    written = eaf::write_text(document);
  } catch (const Error&) {
    return 0;
  }
  if (eaf::read_text("written.eaf", written).document.tiers.size() != document.tiers.size()) std::abort();
  return 0;
}
