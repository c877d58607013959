#include "signweave/evaluation/annotated_loci.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::array<std::pair<std::string_view, std::optional<Locus> LociOfSign::*>, 3> kTiers = {
    {{"from", &LociOfSign::from}, {"to", &LociOfSign::to}, {"at", &LociOfSign::at}}};

Milliseconds common(TimeSpan a, TimeSpan b) {
  return std::min(a.end, b.end) - std::max(a.begin, b.begin);
}

/// The annotation that covers most of a span; null if none covers half of it.
const Annotation* covering(const Tier& tier, TimeSpan span) {
  const Annotation* found = nullptr;
  Milliseconds most = (span.end - span.begin) / 2;
  for (const Annotation& one : tier.annotations) {
    if (common(one.span, span) < most) continue;
    most = common(one.span, span);
    found = &one;
  }
  return found;
}

}  // namespace

AnnotatedLoci annotated_loci(const AnnotationDocument& document, std::span<const Sign> signs, const SignerBody& body) {
  AnnotatedLoci found;
  std::map<std::string, std::optional<Locus>> known;  // [label]
  const auto locus_of = [&](const std::string& tier, const std::string& label) {
    const auto [at, is_new] = known.try_emplace(label);
    if (!is_new) return at->second;
    try {
      at->second = resolve(read_locus(label), {}, 0, body);
    } catch (const Error& error) {
      found.notices.push_back({.where = tier, .text = error.what(), .remedies = {}, .code = {}});
    }
    return at->second;
  };
  for (const Tier& tier : document.tiers) {
    const std::string name = fold_case(match_form(tier.id));
    const auto row = std::ranges::find_if(kTiers, [&](const auto& one) { return one.first == name; });
    if (row == kTiers.end()) continue;
    for (std::size_t i = 0; i < signs.size(); ++i) {
      const Annotation* const covers = covering(tier, signs[i].span);
      if (covers == nullptr) continue;
      const std::optional<Locus> locus = locus_of(tier.id, covers->label);
      if (!locus) continue;
      found.of.resize(signs.size());
      found.of[i].*(row->second) = locus;
    }
  }
  return found;
}

}  // namespace signweave
