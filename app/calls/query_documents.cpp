#include "app/calls/query_documents.h"

#include <fmt/format.h>

#include <algorithm>

namespace signweave::calls {
namespace {

constexpr const char* kTierType = "query answers";

/// A tier that is free from `begin` on: one of those added, or a new one.
Tier& free_tier(AnnotationDocument& document, std::size_t first, Milliseconds begin) {
  for (std::size_t i = first; i < document.tiers.size(); ++i) {
    const std::vector<Annotation>& there = document.tiers[i].annotations;
    if (there.empty() || there.back().span.end <= begin) return document.tiers[i];
  }
  Tier tier;
  tier.type = kTierType;
  for (std::size_t number = document.tiers.size() - first + 1;; ++number) {
    tier.id = fmt::format("query {}", number);
    if (std::ranges::find(document.tiers, tier.id, &Tier::id) == document.tiers.end()) break;
  }
  document.tiers.push_back(std::move(tier));
  return document.tiers.back();
}

QueryDocument document_with(const Database& database, const std::string& recording, std::vector<Segment> answers) {
  QueryDocument made{recording, database.document(recording)};
  AnnotationDocument& document = made.document;
  document.source = {};  // it is another document now, and is written as EAF
  if (std::ranges::find(document.types, kTierType, &TierType::id) == document.types.end()) {
    document.types.push_back({kTierType, Stereotype::none, {}});
  }
  const std::size_t first = document.tiers.size();
  std::ranges::stable_sort(answers, {}, [](const Segment& one) { return one.span.begin; });
  for (const Segment& answer : answers) {
    Annotation annotation;
    annotation.label = answer.name;
    annotation.span = answer.span;
    free_tier(document, first, answer.span.begin).annotations.push_back(std::move(annotation));
  }
  return made;
}

}  // namespace

std::vector<QueryDocument> documents_of(const Database& database, std::span<const Segment> answers) {
  std::vector<std::pair<std::string, std::vector<Segment>>> recordings;
  for (const Segment& answer : answers) {
    auto at = std::ranges::find(recordings, answer.recording, &std::pair<std::string, std::vector<Segment>>::first);
    if (at == recordings.end()) at = recordings.insert(recordings.end(), {answer.recording, {}});
    at->second.push_back(answer);
  }
  std::vector<QueryDocument> documents;
  for (auto& [recording, own] : recordings) documents.push_back(document_with(database, recording, std::move(own)));
  return documents;
}

}  // namespace signweave::calls
