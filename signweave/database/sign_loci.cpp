#include "signweave/database/sign_loci.h"

#include <algorithm>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

std::optional<LocusTier> locus_tier(const std::string& id) {
  const std::string name = fold_case(id);
  if (name == "from") return LocusTier::from;
  if (name == "to") return LocusTier::to;
  if (name == "at") return LocusTier::at;
  return std::nullopt;
}

}  // namespace

std::vector<AnnotatedLocus> loci_in(const AnnotationDocument& document) {
  std::vector<AnnotatedLocus> loci;
  for (const Tier& tier : document.tiers) {
    const std::optional<LocusTier> which = locus_tier(tier.id);
    if (!which) continue;
    for (const Annotation& annotation : tier.annotations) {
      std::string_view label = trimmed(annotation.label);
      if (label.starts_with('@')) label.remove_prefix(1);
      try {
        loci.push_back({*which, annotation.span, read_locus(label)});
      } catch (const Error&) {
        // Tiers of these names may hold other things.
      }
    }
  }
  std::ranges::stable_sort(loci, {}, [](const AnnotatedLocus& one) { return one.span.begin; });
  return loci;
}

std::array<std::optional<LocusRef>, 3> loci_over(const std::vector<AnnotatedLocus>& all, TimeSpan sign) {
  std::array<std::optional<LocusRef>, 3> found;
  std::array<Milliseconds, 3> most{};
  for (const AnnotatedLocus& one : all) {
    if (one.span.begin >= sign.end) break;
    const Milliseconds common = std::min(one.span.end, sign.end) - std::max(one.span.begin, sign.begin);
    const auto tier = static_cast<std::size_t>(one.tier);
    if (common <= most[tier] || 2 * common < sign.duration()) continue;
    most[tier] = common;
    found[tier] = one.locus;
  }
  return found;
}

}  // namespace signweave
