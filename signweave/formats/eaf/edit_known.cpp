#include "signweave/formats/eaf/edit_known.h"

#include <set>
#include <unordered_map>

namespace signweave::eaf {

Known recognise(const FileParts& old, const CheckedDocument& checked) {
  struct Origin {
    std::size_t tier;
    const FileAnnotation* annotation;
  };
  std::unordered_map<std::string_view, std::size_t> tiers;
  std::unordered_map<std::string_view, Origin> annotations;
  for (std::size_t t = 0; t < old.tiers.size(); ++t) {
    tiers.emplace(old.tiers[t].tier.id, t);
    for (const FileAnnotation& one : old.tiers[t].annotations) annotations.emplace(one.annotation.id, Origin{t, &one});
  }
  Known known;
  std::set<std::size_t> taken;
  const std::vector<Tier>& now = checked.document.tiers;
  for (std::size_t t = 0; t < now.size(); ++t) {
    const auto same = tiers.find(now[t].id);
    known.tiers.push_back(same == tiers.end() ? kNone : same->second);
    if (same != tiers.end()) taken.insert(same->second);
    std::vector<const FileAnnotation*>& row = known.annotations.emplace_back();
    std::vector<bool>& with_slots = known.with_slots.emplace_back();
    for (const Annotation& one : now[t].annotations) {
      const auto found = annotations.find(one.id);
      const bool is_new = found == annotations.end();
      row.push_back(is_new ? nullptr : found->second.annotation);
      const bool as_before = !is_new && old.tiers[found->second.tier].stereotype == checked.stereotypes[t];
      with_slots.push_back(as_before ? row.back()->has_slots() : !is_symbolic(checked.stereotypes[t]));
    }
  }
  for (std::size_t t = 0; t < now.size(); ++t) {
    if (known.tiers[t] != kNone || now[t].annotations.empty()) continue;
    const auto was = annotations.find(now[t].annotations.front().id);
    if (was != annotations.end() && taken.insert(was->second.tier).second) known.tiers[t] = was->second.tier;
  }
  return known;
}

}  // namespace signweave::eaf
