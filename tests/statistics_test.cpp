// The statistics of the synthetic signer's recordings recover the parameters of the signer.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "demo/corpus.h"
#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

constexpr FrameRate kStatedRate{100, 1};

std::vector<Sign> signs_of_document(const AnnotationDocument& document) {
  return signs_in(document, guess_tier_names(document)).signs;
}

TEST(Statistics, RecoverTheDurationsOfTheSyntheticSigner) {
  std::size_t recordings = 0;
  for (const demo::Script& script : demo::corpus_scripts(44)) {
    SCOPED_TRACE(script.name);
    const demo::Timeline timeline = demo::timeline_of(script, kStatedRate, 1);
    const std::vector<Sign> signs = signs_of_document(demo::annotation_of(script, timeline));
    const Distribution of = describe(recorded_transitions(script.name, signs)).whole.duration;
    const auto asked = static_cast<double>(script.transition_mean.count());
    EXPECT_GE(of.count, 10u);
    EXPECT_LE(of.mean_low, asked);
    EXPECT_GE(of.mean_high, asked);
    EXPECT_LT(of.mean_high - of.mean_low, 0.5 * asked);  // a narrow interval
    EXPECT_NEAR(of.deviation, static_cast<double>(script.transition_deviation.count()), 0.05 * asked);
    ++recordings;
  }
  EXPECT_GE(recordings, 20u);
}

/// The mean duration of a phase over the truth's rows whose neighbour is in the same unit.
TEST(Statistics, PartsEqualThoseOfTheTruth) {
  for (const demo::Script& script : {demo::meteo(), demo::villes()}) {
    SCOPED_TRACE(script.name);
    const demo::SyntheticRecording recording = demo::make_recording(script, kStatedRate, 1);
    struct Span {
      double begin, end;
      auto operator<=>(const Span&) const = default;
    };
    std::map<std::string, std::set<Span>> phases;  // both hands have the same times
    std::istringstream lines(recording.truth);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::istringstream row(line);
      std::string gloss, phase, begin, end;
      std::getline(row, gloss, ',');
      std::getline(row, phase, ',');
      std::getline(row, begin, ',');
      std::getline(row, end, ',');
      phases[phase].insert({std::stod(begin), std::stod(end)});
    }
    double retraction = 0;
    double preparation = 0;
    double count = 0;
    for (const Span& before : phases["Retraction"]) {
      for (const Span& after : phases["Preparation"]) {
        if (before.end != after.begin) continue;
        retraction += before.end - before.begin;
        preparation += after.end - after.begin;
        count += 1;
      }
    }
    const TransitionSummary of = describe(recorded_transitions(script.name, signs_of_document(recording.document)));
    EXPECT_EQ(static_cast<double>(of.whole.duration.count), count);
    EXPECT_NEAR(of.retraction.duration.mean, retraction / count, 1e-9);
    EXPECT_NEAR(of.preparation.duration.mean, preparation / count, 1e-9);
    EXPECT_NEAR(of.whole.duration.mean, of.retraction.duration.mean + of.preparation.duration.mean, 1e-9);
  }
}

}  // namespace
}  // namespace signweave
