#include "signweave/calls/vocabulary_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "signweave/core/text.h"
#include "signweave/query/vocabulary.h"

namespace signweave::calls {

VocabularyAnswer vocabulary_of(const Database& database) {
  return {.names = vocabulary(*database.segments()), .language = language_words()};
}

LabelsAnswer run(const Database& database, const LabelsCall& call) {
  const std::shared_ptr<const Segments> segments = database.segments();
  std::vector<LabelCount> labels = labels_of(*segments, call.tier);
  if (labels.empty()) {
    const std::vector<std::string> tiers = segments->tiers();
    if (std::ranges::find(tiers, call.tier) == tiers.end()) {
      throw Error(ErrorCode::not_found,
                  fmt::format("there is no tier '{}'{}", printable(call.tier), did_you_mean(call.tier, tiers)));
    }
  }
  std::size_t left_out = 0;
  if (labels.size() > call.limit) {
    left_out = labels.size() - call.limit;
    std::ranges::stable_sort(labels, std::greater(), &LabelCount::annotations);
    labels.resize(call.limit);
    std::ranges::sort(labels, {}, &LabelCount::label);
  }
  return {.tier = call.tier, .labels = std::move(labels), .left_out = left_out};
}

}  // namespace signweave::calls
