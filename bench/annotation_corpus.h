#pragma once

// Annotation documents for measurements: those of the shared data, and generated ones.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "signweave/formats/eaf/eaf.h"

namespace signweave::bench {

inline std::size_t annotations_in(const AnnotationDocument& document) {
  std::size_t count = 0;
  for (const Tier& tier : document.tiers) count += tier.annotations.size();
  return count;
}

/// The non-empty documents of the shared data; an empty one to generate into if there are none.
inline std::vector<AnnotationDocument> documents() {
  std::vector<AnnotationDocument> found;
  const std::filesystem::path folder = std::filesystem::path(SIGNWEAVE_SHARED_DATA) / "eaf";
  if (std::filesystem::is_directory(folder)) {
    for (const std::filesystem::directory_entry& file : std::filesystem::recursive_directory_iterator(folder)) {
      if (file.path().extension() != ".eaf") continue;
      try {
        AnnotationDocument document = eaf::read(file.path()).document;
        document.source = {};
        document.properties.clear();
        const std::size_t count = annotations_in(document);
        if (count > 20 && count < 20'000) found.push_back(std::move(document));
      } catch (const Error&) {  // some of them are deliberately broken
      }
    }
  }
  std::ranges::sort(found, {}, annotations_in);
  if (found.empty()) {
    fmt::print(stderr, "no shared data: only generated tiers\n");
    found.emplace_back();
  }
  return found;
}

/// Adds a tier of `signs_of_document` signs, a tier of their phases below it, and a tier of mouthings for a third of
/// them.
inline void add_signs(AnnotationDocument& document, std::mt19937& random, std::size_t glosses, int signs_of_document) {
  Tier signs;
  signs.id = "BenchGloss";
  Tier phases;
  phases.id = "BenchPhase";
  phases.parent = signs.id;
  Tier mouthing;
  mouthing.id = "BenchMouthing";
  Milliseconds at{0};
  const auto annotation = [&](Tier& tier, std::string label, TimeSpan span, std::string parent) {
    Annotation made;
    made.id = fmt::format("b{}{}", tier.id.back(), tier.annotations.size());
    made.label = std::move(label);
    made.span = span;
    made.parent = std::move(parent);
    tier.annotations.push_back(std::move(made));
    return tier.annotations.back().id;
  };
  for (int i = 0; i < signs_of_document; ++i) {
    const TimeSpan span{at, at + Milliseconds(400 + static_cast<int>(random() % 400))};
    const std::string gloss = fmt::format("G{}", random() % glosses);
    const std::string sign = annotation(signs, gloss, span, "");
    const Milliseconds third = span.duration() / 3;
    annotation(phases, "prep", {span.begin, span.begin + third}, sign);
    annotation(phases, "stroke", {span.begin + third, span.end - third}, sign);
    annotation(phases, "retr", {span.end - third, span.end}, sign);
    if (random() % 3 == 0) annotation(mouthing, gloss, {span.begin + third, span.end + Milliseconds(50)}, "");
    at = span.end + Milliseconds(60 + static_cast<int>(random() % 200));
  }
  document.types.push_back({"bench", Stereotype::none, {}});
  document.types.push_back({"bench phases", Stereotype::included_in, {}});
  signs.type = mouthing.type = "bench";
  phases.type = "bench phases";
  for (Tier* tier : {&signs, &phases, &mouthing}) document.tiers.push_back(std::move(*tier));
}

}  // namespace signweave::bench
