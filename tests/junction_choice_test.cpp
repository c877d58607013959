// Junctions with individually chosen methods, on the demo corpus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/database/test_recording.h"
#include "tests/demo_database.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_database::TestFolder;

const Database& two_minutes_corpus() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = demo_database(folder / "db", 2);
  return *database;
}

Synthesized sign(const char* utterance, const SynthesisOptions& options) {
  return synthesize(two_minutes_corpus(), parse_utterance(utterance), options);
}

std::string fault_of(const char* utterance, const JunctionChoices& junctions) {
  try {
    sign(utterance, {.junctions = junctions});
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

std::vector<std::size_t> numbers_of(const Synthesized& made) {
  std::vector<std::size_t> numbers;
  for (const Junction& junction : made.result.junctions) numbers.push_back(junction.number);
  return numbers;
}

constexpr const char* kStrangers = "VANNES#1 PLUIE#1 , MATIN#2 RENNES#1";
constexpr const char* kNeighbours =
    "BRETAGNE#1 MATIN#1 NUAGES#1 VANNES#1";  // the first three were recorded in this order

TEST(Junctions, NamingAllWithTheDefaultChoiceChangesNothing) {
  for (const TransitionMethod& method : transition_methods()) {
    const Synthesized expected = sign(kStrangers, {.method = &method});
    ASSERT_THAT(numbers_of(expected), ElementsAre(1, 2, 3));
    SynthesisOptions named{.method = find_transition_method(method.name == "sine" ? "gap" : "sine")};
    for (const std::size_t number : {1, 2, 3}) named.junctions[number] = {.method = &method};
    const Synthesized made = sign(kStrangers, named);
    EXPECT_TRUE(same_bits(made.result.motion, expected.result.motion)) << method.name;
    EXPECT_EQ(made.captured_transitions, expected.captured_transitions) << method.name;
  }
  SynthesisOptions named;
  for (const std::size_t number : {1, 2, 3}) named.junctions[number] = {.duration = 300ms};
  EXPECT_TRUE(
      same_bits(sign(kStrangers, named).result.motion, sign(kStrangers, {.duration = {.fixed = 300ms}}).result.motion));
}

TEST(Junctions, NamedOnesAreMadeEvenBetweenRecordedNeighbours) {
  const Synthesized kept = sign(kNeighbours, {});
  EXPECT_THAT(numbers_of(kept), ElementsAre(3));
  EXPECT_TRUE(kept.result.notices.empty());
  const Synthesized made = sign(kNeighbours, {.junctions = {{2, {.method = find_transition_method("hermite")}}}});
  ASSERT_THAT(numbers_of(made), ElementsAre(2, 3));
  EXPECT_EQ(made.result.junctions[0].from, "MATIN");
  EXPECT_EQ(made.result.junctions[0].to, "NUAGES");
  EXPECT_EQ(made.result.junctions[0].method, "hermite");
  EXPECT_EQ(made.result.junctions[1].method, "taught");
  EXPECT_EQ(made.result.clips.size(), 3u);
  ASSERT_EQ(made.result.notices.size(), 1u);
  EXPECT_EQ(made.result.notices[0].where, "meteo");
  EXPECT_THAT(made.result.notices[0].text, HasSubstr("'MATIN' and 'NUAGES' are neighbours in the recording"));
  EXPECT_THAT(made.result.notices[0].text, HasSubstr("junction 2 is named"));
}

TEST(Junctions, DoNotChangeWhichTokensAreChosen) {
  const char* const utterance = "BRETAGNE MATIN NUAGES VANNES PLUIE";
  const Synthesized plain = sign(utterance, {});
  for (std::size_t number = 1; number <= 4; ++number) {
    const Synthesized made = sign(utterance, {.junctions = {{number, {find_transition_method("sine"), 1'200ms, 0.5}}}});
    EXPECT_EQ(made.selection.chosen, plain.selection.chosen) << number;
  }
}

TEST(Junctions, CapturedSpansAreLoadedIfOneJunctionNeedsThem) {
  const TransitionMethod* const recorded = find_transition_method("recorded");
  EXPECT_FALSE(sign(kStrangers, {}).captured_transitions);
  EXPECT_TRUE(sign(kStrangers, {.junctions = {{2, {.method = recorded}}}}).captured_transitions);
  JunctionChoices none_asks;
  for (const std::size_t number : {1, 2, 3}) none_asks[number] = {.method = find_transition_method("gap")};
  EXPECT_FALSE(sign(kStrangers, {.method = recorded, .junctions = none_asks}).captured_transitions);
}

TEST(Junctions, UnknownNumbersAreRefused) {
  const JunctionChoice choice{.tempo = 2};
  EXPECT_EQ(fault_of(kStrangers, {{1, choice}, {4, choice}}), "no junction 4: there are 3, counted from 1");
  EXPECT_EQ(fault_of("VANNES PLUIE", {{2, choice}}), "no junction 2: there is only junction 1");
  EXPECT_EQ(fault_of("VANNES", {{1, choice}}), "no junction 1: there is none, because nothing is joined");
  EXPECT_THAT(fault_of("VANNES PLUIE", {{0, choice}}), HasSubstr("no junction 0"));
  EXPECT_THAT(fault_of("VANNES PLUIE", {{1, {.tempo = 5}}}), HasSubstr("tempo 5 is outside 0.25 to 4"));
  EXPECT_THAT(fault_of("VANNES PLUIE", {{1, {.duration = 60'001ms}}}), HasSubstr("60001 ms is outside"));
}

TEST(Junctions, OfAnEditAreCountedBetweenItsParts) {
  Edit edit;
  edit.replacements.push_back(parse_replacement("BRETAGNE=VANNES"));
  const SynthesisOptions options{.junctions = {{2, {.method = find_transition_method("gap"), .duration = 400ms}}}};
  const Synthesized made = synthesize(two_minutes_corpus(), "meteo", edit, options);
  ASSERT_THAT(numbers_of(made), ElementsAre(1, 2));
  EXPECT_EQ(made.result.junctions[1].from, "VANNES");
  EXPECT_EQ(made.result.junctions[1].method, "gap");
  EXPECT_EQ(made.result.junctions[1].frames.size(), 40);
  const Synthesized plain = synthesize(two_minutes_corpus(), "meteo", edit);
  EXPECT_EQ(made.result.junctions[0].frames, plain.result.junctions[0].frames);
}

}  // namespace
}  // namespace signweave
