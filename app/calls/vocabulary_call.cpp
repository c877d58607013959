#include "app/calls/vocabulary_call.h"

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

}  // namespace signweave::calls
