// The corpus as a whole: its size and contents.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "demo/corpus.h"
#include "demo/test_rate.h"

namespace signweave::demo {
namespace {

TEST(Corpus, OfTwoMinutesIsMeteoAndVilles) {
  for (const double minutes : {0.0, 1.0, 2.0}) {
    const std::vector<Script> scripts = corpus_scripts(minutes);
    ASSERT_EQ(scripts.size(), 2U) << minutes;
    EXPECT_EQ(scripts[0].units, meteo().units);
    EXPECT_EQ(scripts[1].units, villes().units);
  }
}

TEST(Corpus, HasTheRequestedMinutesInRecordingsOfAboutTwo) {
  for (const double minutes : {6.0, 15.0, 44.0}) {
    const std::vector<Script> scripts = corpus_scripts(minutes);
    if (minutes == 44) {
      EXPECT_GE(scripts.size(), 20U);
    }
    std::set<std::string> names;
    double seconds = 0;
    for (std::size_t i = 0; i < scripts.size(); ++i) {
      EXPECT_TRUE(names.insert(scripts[i].name).second) << scripts[i].name;
      const Timeline timeline = timeline_of(scripts[i], kRate, 1);
      const double length = static_cast<double>(timeline.frames) / 100;
      EXPECT_NEAR(expected_seconds(scripts[i]), length, 6) << scripts[i].name;
      if (i >= 2) {
        EXPECT_NEAR(length, 120, 20) << scripts[i].name;
      }
      seconds += length;
    }
    EXPECT_NEAR(seconds, 60 * minutes, 60) << minutes;
  }
}

TEST(Corpus, UsesEveryWordOfTheTableFiveTimesOrMore) {
  std::map<std::string_view, int> tokens;
  for (const Script& script : corpus_scripts(44)) {
    for (const auto& unit : script.units) {
      for (const std::string_view gloss : unit) ++tokens[gloss];
    }
  }
  EXPECT_EQ(tokens.size(), sign_table().size());  // and no others: sign_for would report a word that the table lacks
  for (const auto& [gloss, count] : tokens) EXPECT_GE(count, 5) << gloss;
}

TEST(Corpus, HasDistinctSentencesOfFourToNineSigns) {
  std::set<std::vector<std::string_view>> sentences;
  std::size_t count = 0;
  const std::vector<Script> scripts = corpus_scripts(44);
  for (std::size_t i = 2; i < scripts.size(); ++i) {
    for (const auto& unit : scripts[i].units) {
      EXPECT_GE(unit.size(), 4U) << scripts[i].name;
      EXPECT_LE(unit.size(), 9U) << scripts[i].name;
      for (std::size_t k = 1; k < unit.size(); ++k) EXPECT_NE(unit[k], unit[k - 1]) << scripts[i].name;
      sentences.insert(unit);
      ++count;
    }
  }
  EXPECT_GE(sentences.size(), count * 95 / 100);
}

TEST(Corpus, HasTransitionsBetweenThoseOfMeteoAndOfVilles) {
  const std::vector<Script> scripts = corpus_scripts(44);
  for (std::size_t i = 2; i < scripts.size(); ++i) {
    EXPECT_GE(scripts[i].transition_mean, meteo().transition_mean);
    EXPECT_LE(scripts[i].transition_mean, villes().transition_mean);
    const Timeline timeline = timeline_of(scripts[i], kRate, 1);
    double sum = 0, squares = 0, count = 0;
    for (std::size_t k = 0; k + 1 < timeline.signs.size(); ++k) {
      if (ends_unit(timeline, k)) continue;
      const auto frames = static_cast<double>(timeline.signs[k + 1].stroke_begin - timeline.signs[k].stroke_end);
      EXPECT_GE(frames, 25);
      sum += 10 * frames;
      squares += 100 * frames * frames;
      ++count;
    }
    const double mean = sum / count;
    const auto wanted = static_cast<double>(scripts[i].transition_mean.count());
    const auto deviation = static_cast<double>(scripts[i].transition_deviation.count());
    EXPECT_NEAR(mean, wanted, 0.02 * wanted) << scripts[i].name;
    EXPECT_NEAR(std::sqrt(squares / count - mean * mean), deviation, 0.03 * deviation) << scripts[i].name;
  }
}

TEST(Corpus, IsTheSameEveryTime) {
  const std::vector<Script> first = corpus_scripts(12);
  const std::vector<Script> second = corpus_scripts(12);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].units, second[i].units);
}

}  // namespace
}  // namespace signweave::demo
