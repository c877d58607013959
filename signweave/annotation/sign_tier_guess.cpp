#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "signweave/annotation/sign.h"
#include "signweave/annotation/tier_name.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

/// True if at least four fifths of a tier's labelled annotations are phases, of more than one kind.
bool holds_phases(const Tier& tier) {
  std::map<std::string, std::size_t> labels;
  for (const Annotation& one : tier.annotations) ++labels[match_form(one.label)];
  labels.erase("");
  std::set<PhaseKind> kinds;
  std::size_t phases = 0;
  std::size_t all = 0;
  for (const auto& [label, count] : labels) {
    all += count;
    const PhaseKind kind = phase_kind_of(label, {});
    if (kind == PhaseKind::other) continue;
    phases += count;
    kinds.insert(kind);
  }
  return kinds.size() > 1 && phases * 5 >= all * 4;
}

class Guesser {
 public:
  explicit Guesser(const AnnotationDocument& document) : document_(document) {
    for (std::size_t i = 0; i < document.tiers.size(); ++i) places_.emplace(document.tiers[i].id, i);
    for (const Tier& tier : document.tiers) {
      TierName name = read_tier_name(tier.id);
      if (name.sign_score == 0 && !name.says_phase) name.sign_score = read_tier_name(tier.type).sign_score / 2;
      names_.push_back(std::move(name));
    }
  }

  TierNames run() {
    find_phase_tiers();
    find_sign_tiers();
    TierNames result;
    for (const std::size_t tier : sign_tiers_) {
      const std::string& participant = document_.tiers[tier].participant;
      result.sign_tiers.push_back(
          {document_.tiers[tier].id, names_[tier].hand, participant.empty() ? names_[tier].signer : std::string()});
    }
    if (result.sign_tiers.empty()) return result;
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      if (phases_[i]) result.phase_tiers.push_back(document_.tiers[i].id);
    }
    return result;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  static constexpr std::size_t kDeepest = 64;  ///< limit of ancestors visited; no annotator nests deeper

  std::size_t parent(std::size_t tier) const {
    const auto found = places_.find(document_.tiers[tier].parent);
    return found == places_.end() ? kNone : found->second;
  }

  void find_phase_tiers() {
    phases_.assign(document_.tiers.size(), false);
    for (std::size_t i = 0; i < document_.tiers.size(); ++i) {
      const Tier& tier = document_.tiers[i];
      const TierName type = read_tier_name(tier.type);
      const bool named = names_[i].says_phase || (type.says_phase && names_[i].sign_score == 0);
      phases_[i] = holds_phases(tier) || (named && tier.annotations.empty());
    }
  }

  void find_sign_tiers() {
    const std::size_t count = document_.tiers.size();
    std::vector<int> scores(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      if (!phases_[i]) scores[i] = std::max(scores[i], names_[i].sign_score);
      // The paper's pair of tiers is recognised by its structure, whatever the names.
      const std::size_t above = parent(i);
      const TierType* type = document_.find_type(document_.tiers[i].type);
      const bool fills = type != nullptr && type->stereotype == Stereotype::time_subdivision;
      if (phases_[i] && fills && above != kNone && !phases_[above]) scores[above] = 4;
    }
    const int best = count == 0 ? 0 : *std::max_element(scores.begin(), scores.end());
    if (best == 0) return;
    // If structure identified one hand's tier, the other hand's may still have no phases: gloss tiers are added.
    const auto is_candidate = [&](std::size_t i) { return scores[i] == best || (best == 4 && scores[i] == 3); };
    for (std::size_t i = 0; i < count; ++i) {
      bool below = false;
      std::size_t steps = 0;
      for (std::size_t up = parent(i); up != kNone && steps < kDeepest; up = parent(up), ++steps) {
        below = below || is_candidate(up);
      }
      if (is_candidate(i) && !below) sign_tiers_.push_back(i);
    }
    std::stable_sort(sign_tiers_.begin(), sign_tiers_.end(), [&](std::size_t a, std::size_t b) {
      if (scores[a] != scores[b]) return scores[a] > scores[b];
      return document_.tiers[a].annotations.size() > document_.tiers[b].annotations.size();
    });
  }

  const AnnotationDocument& document_;
  std::unordered_map<std::string_view, std::size_t> places_;
  std::vector<TierName> names_;
  std::vector<bool> phases_;  ///< [tier]
  std::vector<std::size_t> sign_tiers_;
};

}  // namespace

TierNames guess_tier_names(const AnnotationDocument& document) {
  return Guesser(document).run();
}

}  // namespace signweave
