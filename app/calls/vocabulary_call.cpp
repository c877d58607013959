#include "app/calls/vocabulary_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "signweave/core/text.h"
#include "signweave/query/vocabulary.h"

namespace signweave::calls {

nlohmann::ordered_json vocabulary_json(const Database& database) {
  const Vocabulary words = vocabulary(*database.segments());
  const LanguageWords language = language_words();
  nlohmann::ordered_json glosses = nlohmann::ordered_json::array();
  for (const auto& [gloss, tokens] : words.glosses) glosses.push_back({{"gloss", gloss}, {"tokens", tokens}});
  return {{"glosses", std::move(glosses)},
          {"tiers", words.tiers},
          {"recordings", words.recordings},
          {"signers", words.signers},
          {"language",
           {{"fields", language.fields},
            {"links", language.links},
            {"phases", language.phases},
            {"hands", language.hands},
            {"functions", language.functions},
            {"points", language.points}}}};
}

nlohmann::ordered_json labels_json(const Database& database, const LabelsCall& call) {
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
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& [label, annotations] : labels) rows.push_back({{"label", label}, {"annotations", annotations}});
  return {{"tier", call.tier}, {"labels", std::move(rows)}, {"left_out", left_out}};
}

}  // namespace signweave::calls
