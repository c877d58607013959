#include "signweave/calls/annotate_call.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "signweave/core/text.h"
#include "signweave/database/import.h"

namespace signweave::calls {
namespace {

/// The name of a tier type without constraints, which is added if the document does not have it.
std::string free_type(AnnotationDocument& document, const std::string& wanted) {
  for (int number = 1;; ++number) {
    std::string name = number > 1 ? fmt::format("{} {}", wanted, number) : wanted;
    const TierType* known = document.find_type(name);
    const bool is_free =
        known == nullptr || (known->stereotype == Stereotype::none && known->controlled_vocabulary.empty());
    if (known == nullptr) document.types.push_back({name, Stereotype::none, {}});
    if (is_free) return name;
  }
}

void remove_tier(AnnotationDocument& document, const std::string& name) {
  std::vector<std::string> known;
  for (const Tier& tier : document.tiers) known.push_back(tier.id);
  if (document.find_tier(name) == nullptr) {
    throw Error(ErrorCode::not_found, fmt::format("no tier '{}'{}", printable(name), did_you_mean(name, known)));
  }
  if (const auto child = std::ranges::find(document.tiers, name, &Tier::parent); child != document.tiers.end()) {
    throw Error(ErrorCode::bad_input, fmt::format("tier '{}' is the parent of '{}': remove that first", printable(name),
                                                  printable(child->id)));
  }
  std::erase_if(document.tiers, [&](const Tier& tier) { return tier.id == name; });
}

/// Adds annotations, ordered by time, to the first of the tiers from `first` that is free, or to a further one.
void spread(AnnotationDocument& document, const Tier& form, const std::vector<Annotation>& annotations) {
  const std::size_t first = document.tiers.size();
  int number = 0;
  for (const Annotation& annotation : annotations) {
    std::size_t at = first;
    while (at < document.tiers.size() && document.tiers[at].annotations.back().span.end > annotation.span.begin) ++at;
    if (at == document.tiers.size()) {
      Tier tier = form;
      do tier.id = fmt::format("{} {}", form.id, ++number);
      while (document.find_tier(tier.id) != nullptr);
      document.tiers.push_back(std::move(tier));
    }
    document.tiers[at].annotations.push_back(annotation);
  }
}

void add_tier(AnnotationDocument& document, const NewTier& wanted) {
  Tier tier;
  tier.id = wanted.name;
  tier.type = free_type(document, wanted.type);
  tier.annotator = wanted.annotator;
  tier.participant = wanted.participant;
  std::vector<Annotation> annotations = wanted.annotations;
  std::ranges::stable_sort(annotations, {}, [](const Annotation& one) { return one.span.begin; });
  if (wanted.spread) return spread(document, tier, annotations);
  const auto overlap = std::ranges::adjacent_find(
      annotations, [](const Annotation& a, const Annotation& b) { return a.span.end > b.span.begin; });
  if (overlap != annotations.end()) {
    throw Error(ErrorCode::bad_input,
                fmt::format("tier '{}': annotations overlap before {} ms; 'spread' puts them onto several tiers",
                            printable(wanted.name), overlap->span.end.count()));
  }
  tier.annotations = std::move(annotations);
  document.tiers.push_back(std::move(tier));
}

void set_property(AnnotationDocument& document, const std::string& name, const std::string& value) {
  const auto known = std::ranges::find(document.properties, name, &std::pair<std::string, std::string>::first);
  if (known != document.properties.end()) {
    known->second = value;
  } else {
    document.properties.emplace_back(name, value);
  }
}

/// A document that annotates nothing yet.
AnnotationDocument empty_document(const std::string& motion_file) {
  AnnotationDocument document;
  document.date = fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", fmt::gmtime(std::time(nullptr)));
  if (!motion_file.empty()) {
    document.linked_files.push_back({.url = "./" + motion_file,
                                     .relative_url = "./" + motion_file,
                                     .mime_type = "application/octet-stream",
                                     .media = false});
  }
  return document;
}

}  // namespace

AnnotationDocument with_tiers(AnnotationDocument document, const TierChanges& changes) {
  if (document.source_format != SourceFormat::eaf) {  // it becomes another document, which is written as EAF
    document.source.clear();
    document.specification.clear();
    document.source_format = SourceFormat::eaf;
  }
  for (const std::string& name : changes.remove) remove_tier(document, name);
  for (const NewTier& tier : changes.tiers) add_tier(document, tier);
  for (const auto& [name, value] : changes.properties) set_property(document, name, value);
  return document;
}

AnnotationDocument run(const Database& database, const AnnotateCall& call, const TierChanges& changes) {
  const std::shared_ptr<const Contents> contents = database.contents();
  const RecordingInfo& info = contents->at(call.recording);
  if (const std::string now = annotation_fingerprint(info); !call.if_annotation.empty() && call.if_annotation != now) {
    throw Error(ErrorCode::conflict,
                fmt::format("the annotation of '{}' has changed: it is {} now, not {}; read it again",
                            printable(call.recording), now, call.if_annotation));
  }
  return with_tiers(info.document != 0 ? database.document(info.name) : empty_document(info.motion_facts.file),
                    changes);
}

}  // namespace signweave::calls
