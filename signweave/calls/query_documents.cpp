#include "signweave/calls/query_documents.h"

#include <algorithm>

#include "signweave/calls/annotate_call.h"

namespace signweave::calls {

std::vector<QueryDocument> documents_of(const Database& database, std::span<const Segment> answers) {
  std::vector<std::pair<std::string, NewTier>> recordings;
  for (const Segment& answer : answers) {
    auto at = std::ranges::find(recordings, answer.recording, &std::pair<std::string, NewTier>::first);
    if (at == recordings.end()) {
      at = recordings.insert(recordings.end(), {answer.recording, {.name = "query", .type = "query answers"}});
      at->second.spread = true;
    }
    Annotation annotation;
    annotation.label = answer.name;
    annotation.span = answer.span;
    at->second.annotations.push_back(std::move(annotation));
  }
  std::vector<QueryDocument> documents;
  for (auto& [recording, tier] : recordings) {
    documents.push_back({recording, with_tiers(database.document(recording), {.tiers = {std::move(tier)}})});
  }
  return documents;
}

}  // namespace signweave::calls
