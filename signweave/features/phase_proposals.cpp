#include "signweave/features/phase_proposals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace signweave {

AnnotationDocument proposals_document(const ProposedPhases& proposed, Seconds length, const std::string& motion_file) {
  AnnotationDocument document;
  document.author = "signweave";
  document.date = "1970-01-01T00:00:00+00:00";  // fixed, so that the same motion gives the same bytes
  document.linked_files.push_back(
      {.url = motion_file, .relative_url = "./" + motion_file, .mime_type = "unknown", .media = false});
  document.properties.emplace_back("signweave:proposed", std::string(kProposalWarning));
  document.types = {{"phase", Stereotype::none, {}}, {"confidence", Stereotype::symbolic_association, {}}};
  int next = 1;
  for (const Side side : {Side::right, Side::left}) {
    const std::vector<ProposedPhase>& phases = proposed.hands[static_cast<std::size_t>(side)];
    if (phases.empty()) continue;
    const std::string hand = side == Side::right ? "RH" : "LH";
    Tier tier{.id = fmt::format("Phase {} (proposed)", hand), .type = "phase", .annotator = "signweave"};
    Tier confidence{
        .id = fmt::format("Confidence {}", hand), .type = "confidence", .parent = tier.id, .annotator = "signweave"};
    for (const ProposedPhase& phase : phases) {
      const auto whole = [&](Seconds time) {
        return Milliseconds(std::llround(1000 * std::min(time, length).count()));
      };
      const TimeSpan span{whole(phase.begin), whole(phase.end)};
      if (span.duration() <= Milliseconds(0)) continue;
      const std::string id = fmt::format("a{}", next++);
      tier.annotations.push_back({.id = id, .label = std::string(name_of(phase.phase)), .span = span});
      confidence.annotations.push_back({.id = fmt::format("a{}", next++),
                                        .label = fmt::format("{:.2f}", phase.confidence),
                                        .span = span,
                                        .parent = id,
                                        .aligned = false});
    }
    document.tiers.push_back(std::move(tier));
    document.tiers.push_back(std::move(confidence));
  }
  return document;
}

}  // namespace signweave
