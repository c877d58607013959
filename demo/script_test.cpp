// Timing and annotation of the synthetic corpus: the paper's figures for its two sequences.

#include "demo/script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "demo/corpus.h"
#include "demo/test_rate.h"
#include "signweave/core/error.h"

namespace signweave::demo {
namespace {

/// A recording without its motion.
struct Made {
  Made(const Script& script, std::uint64_t seed)
      : name(script.name), timeline(timeline_of(script, kRate, seed)), document(annotation_of(script, timeline)) {}
  std::string name;
  Timeline timeline;
  AnnotationDocument document;
};

std::vector<std::string_view> glosses_of(const Script& script) {
  std::vector<std::string_view> glosses;
  for (const auto& unit : script.units) glosses.insert(glosses.end(), unit.begin(), unit.end());
  return glosses;
}

struct Spread {
  double mean = 0, deviation = 0;
  std::size_t count = 0;
};

Spread spread_of(const std::vector<double>& values) {
  Spread spread{.count = values.size()};
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  for (const double value : values) spread.deviation += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(spread.deviation / static_cast<double>(values.size()));
  return spread;
}

/// Retraction plus preparation of neighbours, milliseconds, computed from the document only.
std::vector<double> transitions(const AnnotationDocument& document, bool across_rests) {
  std::vector<double> durations;
  const auto& phases = document.find_tier("Phase")->annotations;
  for (std::size_t i = 0; i + 1 < phases.size(); ++i) {
    if (phases[i].label != "Retraction" || phases[i + 1].label != "Preparation") continue;
    if (!across_rests && phases[i].span.end != phases[i + 1].span.begin) continue;
    durations.push_back(static_cast<double>((phases[i].span.duration() + phases[i + 1].span.duration()).count()));
  }
  return durations;
}

TEST(Meteo, EndsWithTheSequenceThatThePaperPrints) {
  const std::vector<std::string_view> glosses = glosses_of(meteo());
  const std::vector<std::string_view> printed = {
      "ATTENTION",  "AUJOURD'HUI", "SIX JUILLET", "LE-TEMPS-PREVU", "BRETAGNE",       "MATIN",     "NUAGES",
      "APRES-MIDI", "PLUIE",       "DEMAIN",      "SOLEIL-BRILLER", "CHAUD-SEC-FERA", "NAGER",     "CE-SERA-LE-MOMENT",
      "VENDREDI",   "NUAGES",      "NUIT",        "EN-MER",         "MATIN",          "BROUILLARD"};
  ASSERT_GE(glosses.size(), printed.size());
  EXPECT_THAT(std::vector(glosses.end() - static_cast<std::ptrdiff_t>(printed.size()), glosses.end()),
              testing::ElementsAreArray(printed));
  // The units before do not change the token numbers of the scenarios.
  const std::set<std::string_view> scenario(printed.begin(), printed.end());
  for (std::size_t i = 0; i + printed.size() < glosses.size(); ++i) EXPECT_FALSE(scenario.contains(glosses[i]));
}

TEST(Meteo, BeginsWithARestAndFridaysPredictionEndsIt) {
  const Made made(meteo(), 1);
  const auto& glosses = made.document.find_tier("Gloss")->annotations;
  EXPECT_GE(glosses.front().span.begin, 500ms);
  EXPECT_EQ(glosses.back().label, "BROUILLARD");
  const Milliseconds length(made.timeline.frames * 10);
  EXPECT_GE(length - glosses.back().span.end, 300ms);
  EXPECT_LE(length - glosses.back().span.end, 2000ms);
}

TEST(Villes, NamesAtLeastFourteenCitiesAndSomeTwice) {
  const std::vector<std::string_view> glosses = glosses_of(villes());
  const std::set<std::string_view> cities(glosses.begin(), glosses.end());
  EXPECT_GE(cities.size(), 14U);
  EXPECT_GT(glosses.size(), cities.size());
  for (const char* city : {"VANNES", "MARSEILLE", "RENNES", "LE MANS"}) EXPECT_TRUE(cities.contains(city)) << city;
}

class EveryScript : public testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Script script() const { return std::string_view(std::get<0>(GetParam())) == "meteo" ? meteo() : villes(); }
  std::uint64_t seed() const { return static_cast<std::uint64_t>(std::get<1>(GetParam())); }
};
INSTANTIATE_TEST_SUITE_P(Demo, EveryScript,
                         testing::Combine(testing::Values("meteo", "villes"), testing::Values(1, 2, 3, 77, 12345)));

TEST_P(EveryScript, HasTheTransitionsOfThePaper) {
  const Made made(script(), seed());
  const double mean = made.name == "meteo" ? 735 : 1064;
  const double deviation = made.name == "meteo" ? 224 : 289;
  // The figures are the paper's, whether or not pairs with a rest in between are counted.
  for (const bool across_rests : {false, true}) {
    const std::vector<double> durations = transitions(made.document, across_rests);
    const Spread spread = spread_of(durations);
    EXPECT_GE(spread.count, made.name == "meteo" ? 30U : 20U);
    EXPECT_NEAR(spread.mean, mean, 0.02 * mean);
    EXPECT_NEAR(spread.deviation, deviation, 0.02 * deviation);
    const auto count = static_cast<double>(spread.count);  // and with n − 1 under the root
    EXPECT_NEAR(spread.deviation * std::sqrt(count / (count - 1)), deviation, 0.02 * deviation);
    for (const double duration : durations) EXPECT_GE(duration, 250);
  }
}

TEST_P(EveryScript, FillsEverySignExactlyWithItsPhases) {
  const Made made(script(), seed());
  const Tier& glosses = *made.document.find_tier("Gloss");
  const Tier& phases = *made.document.find_tier("Phase");
  EXPECT_EQ(phases.parent, "Gloss");
  EXPECT_EQ(made.document.find_type(phases.type)->stereotype, Stereotype::time_subdivision);
  EXPECT_EQ(glosses.participant, "synthetic");
  ASSERT_EQ(phases.annotations.size(), 3 * glosses.annotations.size());
  const std::vector<std::string_view> expected = glosses_of(script());
  ASSERT_EQ(glosses.annotations.size(), expected.size());
  for (std::size_t i = 0; i < glosses.annotations.size(); ++i) {
    const Annotation& sign = glosses.annotations[i];
    EXPECT_EQ(sign.label, expected[i]);
    const Annotation* part = &phases.annotations[3 * i];
    Milliseconds at = sign.span.begin;
    for (const char* label : {"Preparation", "Stroke", "Retraction"}) {
      EXPECT_EQ(part->label, label);
      EXPECT_EQ(part->parent, sign.id);
      EXPECT_EQ(part->span.begin, at);
      EXPECT_GT(part->span.duration(), 0ms);
      EXPECT_EQ(part->span.end.count() % 10, 0);  // on a frame, and on a whole millisecond
      at = part->span.end;
      ++part;
    }
    EXPECT_EQ(at, sign.span.end);
    const Milliseconds stroke = phases.annotations[3 * i + 1].span.duration();
    EXPECT_GE(stroke, 350ms);
    EXPECT_LE(stroke, 800ms);
    EXPECT_LE(at.count(), made.timeline.frames * 10);
  }
}

TEST_P(EveryScript, HasNoGapInsideAUnitAndARestBetweenUnits) {
  const Made made(script(), seed());
  std::size_t i = 0;
  for (const auto& unit : script().units) {
    for (std::size_t k = 0; k < unit.size(); ++k, ++i) {
      if (i == 0) continue;
      const std::int64_t gap = made.timeline.signs[i].begin - made.timeline.signs[i - 1].end;
      if (k == 0) {
        EXPECT_GE(gap, 50) << unit[k];
      } else {
        EXPECT_EQ(gap, 0) << unit[k];
      }
    }
  }
}

TEST(Corpus, StatesThatItsShapesAreNotLsf) {
  const AnnotationDocument document = make_recording(villes(), kRate, 1).document;
  const auto placeholder = std::find_if(document.properties.begin(), document.properties.end(),
                                        [](const auto& property) { return property.first == "signweave:placeholder"; });
  ASSERT_NE(placeholder, document.properties.end());
  EXPECT_THAT(placeholder->second, testing::HasSubstr("LSF"));
  ASSERT_EQ(document.linked_files.size(), 1U);
  EXPECT_FALSE(document.linked_files[0].media);
  EXPECT_THAT(document.linked_files[0].relative_url, testing::EndsWith("villes.bvh"));
}

TEST(Schedule, KeepsBoundsOnFramesAndMillisecondsAtOtherRates) {
  for (const FrameRate rate : {FrameRate{50, 1}, FrameRate{120, 1}, FrameRate{60, 1}, FrameRate{200, 1}}) {
    Random random(3);
    const Timeline timeline = schedule(meteo(), rate, random);
    for (const PlacedSign& sign : timeline.signs) {
      for (const std::int64_t frame : {sign.begin, sign.stroke_begin, sign.stroke_end, sign.end}) {
        EXPECT_EQ(frame * 1000 % rate.numerator, 0) << to_string(rate);
      }
    }
  }
}

TEST(Schedule, RejectsARateWhoseFramesSeldomFallOnMilliseconds) {
  Random random(3);
  EXPECT_THROW(schedule(meteo(), FrameRate{30000, 1001}, random), Error);
}

RC_GTEST_PROP(SampleWith, HasMeanAndDeviationAboveTheLeast, (std::uint64_t seed)) {
  Random random(seed);
  const std::size_t count = *rc::gen::inRange<std::size_t>(10, 60);
  const std::vector<double> values = sample_with(random, count, 0.735, 0.224, 0.36);
  const Spread spread = spread_of(values);
  RC_ASSERT(std::abs(spread.mean - 0.735) < 1e-6);
  RC_ASSERT(std::abs(spread.deviation - 0.224) < 1e-6);
  for (const double value : values) RC_ASSERT(value >= 0.36 - 1e-9);
}

TEST(RandomNumbers, AreTheSameOnEveryMachine) {
  Random random(42);
  // splitmix64, as published by its authors.
  EXPECT_EQ(random.bits(), 13679457532755275413ull);
  EXPECT_EQ(random.bits(), 2949826092126892291ull);
}

TEST(RandomNumbers, AreNormalIfRequested) {
  Random random(7);
  std::vector<double> values(20'000);
  for (double& value : values) value = random.normal();
  const Spread spread = spread_of(values);
  EXPECT_NEAR(spread.mean, 0, 0.03);
  EXPECT_NEAR(spread.deviation, 1, 0.03);
}

}  // namespace
}  // namespace signweave::demo
