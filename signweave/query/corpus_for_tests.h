#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "signweave/semantic_db/segment_table.h"

namespace signweave {

/// Handmade recordings for the tests of this module.
class TestCorpus {
 public:
  /// Starts a recording; the following calls add to it.
  TestCorpus& recording(const std::string& name) {
    recordings_.push_back({name, {}, {}});
    return *this;
  }
  TestCorpus& tier(const std::string& id, const std::string& parent = "") {
    Tier tier;
    tier.id = id;
    tier.parent = parent;
    recordings_.back().document.tiers.push_back(tier);
    return *this;
  }
  /// Adds an annotation to the tier added last. Returns its id.
  std::string annotation(const std::string& label, TimeSpan span, const std::string& parent = "") {
    return annotate(recordings_.back().document.tiers.back(), label, span, parent);
  }
  std::string annotation_on(const std::string& tier, const std::string& label, TimeSpan span,
                            const std::string& parent = "") {
    for (Tier& each : recordings_.back().document.tiers) {
      if (each.id == tier) return annotate(each, label, span, parent);
    }
    return {};
  }
  struct PhaseToBe {
    PhaseKind kind;
    Milliseconds end;
  };
  /// Adds a sign on the tier; its phases are on `phase_tier`, contiguous from its begin. Without phases it gets an
  /// inferred stroke. Returns the annotation's id.
  std::string sign(const std::string& tier, const std::string& gloss, TimeSpan span,
                   const std::vector<PhaseToBe>& phases = {}, Hand hand = Hand::both, const std::string& parent = "",
                   const std::string& phase_tier = "Phase") {
    Sign sign;
    sign.gloss = gloss;
    sign.span = span;
    sign.hand = hand;
    sign.tier = tier;
    sign.annotation = annotation_on(tier, gloss, span, parent);
    sign.inferred = phases.empty();
    if (phases.empty()) sign.phases.push_back({PhaseKind::stroke, span, "", ""});
    Milliseconds begin = span.begin;
    for (const PhaseToBe& phase : phases) {
      const std::string label(1, "psrho"[static_cast<std::size_t>(phase.kind)]);
      const std::string id = annotation_on(phase_tier, label, {begin, phase.end}, sign.annotation);
      sign.phases.push_back({phase.kind, {begin, phase.end}, label, id});
      begin = phase.end;
    }
    recordings_.back().signs.push_back(sign);
    return sign.annotation;
  }

  /// Adds a sign of the other hand that shares all phases of the sign added last.
  void twin(const std::string& tier, const std::string& gloss, Hand hand) {
    Sign sign = recordings_.back().signs.back();
    sign.gloss = gloss;
    sign.hand = hand;
    sign.tier = tier;
    sign.annotation = annotation_on(tier, gloss, sign.span);
    recordings_.back().signs.push_back(sign);
  }

  SegmentTable table() const {
    std::vector<SegmentChunk> chunks;
    for (const TestRecording& each : recordings_) chunks.push_back(segments_of(each.document, each.signs));
    std::vector<SegmentTable::Source> sources;
    for (std::size_t i = 0; i < chunks.size(); ++i)
      sources.push_back({recordings_[i].name, &chunks[i], recordings_[i].name == "meteo" ? "anna" : ""});
    return SegmentTable(sources);
  }

 private:
  struct TestRecording {
    std::string name;
    AnnotationDocument document;
    std::vector<Sign> signs;
  };

  std::string annotate(Tier& tier, const std::string& label, TimeSpan span, const std::string& parent) {
    Annotation annotation;
    annotation.id = fmt::format("a{}", ++last_id_);
    annotation.label = label;
    annotation.span = span;
    annotation.parent = parent;
    tier.annotations.push_back(annotation);
    return annotation.id;
  }

  std::vector<TestRecording> recordings_;
  int last_id_ = 0;
};

/// Two recordings with sentences, signs of two hands, phases and mouthing. Every example in docs/query.md has an answer
/// in them.
inline TestCorpus weather_corpus() {
  constexpr PhaseKind kPrep = PhaseKind::preparation;
  constexpr PhaseKind kStroke = PhaseKind::stroke;
  constexpr PhaseKind kRetraction = PhaseKind::retraction;
  TestCorpus corpus;
  corpus.recording("cities").tier("Gloss").tier("Phase", "Gloss");
  corpus.sign("Gloss", "VANNES", {100ms, 900ms}, {{kPrep, 300ms}, {kStroke, 700ms}, {kRetraction, 900ms}});
  corpus.sign("Gloss", "BREST", {1'000ms, 1'500ms}, {{kStroke, 1'200ms}, {PhaseKind::hold, 1'500ms}});
  corpus.recording("meteo")
      .tier("Sentence")
      .tier("Gloss", "Sentence")
      .tier("Phase", "Gloss")
      .tier("Left")
      .tier("Mouthing");
  const std::string morning = corpus.annotation_on("Sentence", "This morning, clouds over Vannes", {0ms, 4'000ms});
  const std::string fog = corpus.annotation_on("Sentence", "Tomorrow, fog and rain", {4'000ms, 9'000ms});
  corpus.sign("Gloss", "MATIN", {500ms, 1'000ms}, {{kPrep, 650ms}, {kStroke, 1'000ms}}, Hand::right, morning);
  corpus.sign("Gloss", "NUAGES", {1'000ms, 2'000ms}, {{kStroke, 1'400ms}, {kStroke, 1'800ms}, {kRetraction, 2'000ms}},
              Hand::right, morning);
  corpus.sign("Gloss", "VANNES", {2'300ms, 3'000ms}, {{kPrep, 2'400ms}, {kStroke, 2'900ms}, {kRetraction, 3'000ms}},
              Hand::right, morning);
  corpus.sign("Gloss", "MATIN", {4'200ms, 4'600ms}, {{kPrep, 4'300ms}, {kStroke, 4'600ms}}, Hand::right, fog);
  corpus.sign("Gloss", "BROUILLARD", {4'900ms, 5'600ms}, {{kStroke, 5'200ms}, {kRetraction, 5'600ms}}, Hand::right,
              fog);
  corpus.sign("Gloss", "PLUIE", {6'000ms, 6'700ms}, {{kPrep, 6'200ms}, {kStroke, 6'700ms}}, Hand::right, fog);
  corpus.sign("Gloss", "AUJOURD'HUI", {7'000ms, 7'400ms}, {{kStroke, 7'400ms}}, Hand::right, fog);
  corpus.sign("Left", "NUAGES", {1'000ms, 2'100ms}, {}, Hand::left);
  corpus.sign("Left", "PLUIE", {6'000ms, 6'900ms}, {}, Hand::left);
  corpus.annotation_on("Mouthing", "matin", {450ms, 900ms});
  corpus.annotation_on("Mouthing", "nuage", {1'100ms, 1'900ms});
  corpus.annotation_on("Mouthing", "pluie", {6'050ms, 6'500ms});
  return corpus;
}

}  // namespace signweave
