#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/formats/eaf/eaf.h"

/// Any bytes are read as EAF or rejected with an Error. A document that was read is written back byte for byte; with
/// one label changed, or from its model alone, it is either written as a file that can be read or rejected.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace signweave;
  AnnotationDocument document;
  try {
    document = eaf::read_text("fuzz.eaf", {reinterpret_cast<const char*>(data), size}).document;
  } catch (const Error&) {
    return 0;
  }
  if (eaf::write_text(document) != document.source) std::abort();
  signs_in(document, guess_tier_names(document));
  std::string text;
  for (const bool from_its_model : {false, true}) {
    AnnotationDocument changed = document;
    if (from_its_model) changed.source.clear();
    changed.author += "!";
    for (Tier& tier : changed.tiers) {
      if (!tier.annotations.empty()) tier.annotations.back().label += "<!>";
    }
    try {
      text = eaf::write_text(changed);
    } catch (const Error&) {
      continue;
    }
    const AnnotationDocument again = eaf::read_text("written.eaf", text).document;
    if (again.author != changed.author || again.tiers.size() != changed.tiers.size()) std::abort();
  }
  return 0;
}
