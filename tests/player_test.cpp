// The player on whole databases: it shows what `synthesize` produces, whenever places are added.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/player_showing.h"

namespace signweave {
namespace {

struct Case {
  std::string method = "taught";
  double tempo = 1;
  std::optional<FrameRate> rate;
  Alignment alignment = Alignment::automatic;
};

class PlayerMakes : public testing::TestWithParam<Case> {};

TEST_P(PlayerMakes, WhatSynthesizeMakesOfItsTokens) {
  const Case& given = GetParam();
  SynthesisOptions synthesis;
  synthesis.method = find_transition_method(given.method);
  synthesis.tempo = given.tempo;
  synthesis.rate = given.rate;
  synthesis.alignment = given.alignment;
  const std::vector<std::string> glosses = corpus().contents()->segments.glosses();
  std::mt19937 random(7);
  for (int round = 0; round < 12; ++round) {
    std::string text;
    std::vector<std::string> pauses;
    for (int place = 0; place < 9; ++place) {
      pauses.push_back(place > 0 && random() % 6 == 0 ? ", " : "");
      text += pauses.back() + to_string(GlossRef{glosses[random() % glosses.size()], 0}) + " ";
    }
    const Shown shown = shown_whole(text, {.synthesis = synthesis});
    ASSERT_EQ(shown.count(Kind::place), 9u);
    ASSERT_EQ(shown.count(Kind::end), 1u);
    EXPECT_EQ(shown.events.back().frame, static_cast<std::uint64_t>(shown.motion.frame_count()));
    const std::string tokens = shown.tokens(pauses);
    expect_same(shown, synthesize(corpus(), parse_utterance(tokens), synthesis), tokens);
  }
}

INSTANTIATE_TEST_SUITE_P(Player, PlayerMakes,
                         testing::Values(Case{}, Case{.method = "overlap"}, Case{.method = "gap"},
                                         Case{.method = "recorded"}, Case{.tempo = 0.6}, Case{.rate = FrameRate{60, 1}},
                                         Case{.rate = FrameRate{25, 1}},
                                         Case{.method = "overlap", .tempo = 1.7, .rate = FrameRate{30, 1}},
                                         Case{.alignment = Alignment::ground}, Case{.alignment = Alignment::none}));

TEST(Player, SignsRecordedNeighboursAsCaptured) {
  // A run of neighbours, whose recorded transitions `synthesize` keeps.
  const std::string text = "BRETAGNE MATIN NUAGES VANNES";
  const Shown shown = shown_whole(text, {});
  expect_same(shown, synthesize(corpus(), parse_utterance(shown.tokens())), shown.tokens());
  EXPECT_EQ(synthesize(corpus(), parse_utterance(shown.tokens())).result.junctions.size(), 1u);
}

TEST(Player, SignsPiecesOfRecordings) {
  const std::string text = "\"meteo\"@1200..3400 VANNES#1 \"villes\"@5000..5600 \"meteo\"@20000..32000";
  const Shown shown = shown_whole(text, {});
  ASSERT_EQ(shown.count(Kind::place), 4u);
  expect_same(shown, synthesize(corpus(), parse_utterance(text)), text);
}

TEST(Player, TheSameWhenGlossesComeOneByOne) {
  const std::string tokens = "DEMAIN#1 MATIN#1 VANNES#1 PLUIE#2 RENNES#1 NUAGES#1";
  for (const std::size_t step : {1u, 7u, 30u}) {
    Player player(shared_cache(), {.idle = Idle::end});
    Shown shown;
    for (const Place& place : parse_utterance(tokens).places) {
      player.append({{place}});
      show(player, shown, step, step);
    }
    show(player, shown);
    expect_same(shown, synthesize(corpus(), parse_utterance(tokens)), tokens);
  }
}

TEST(Player, ASignAppendedBeforeTheEndIsJoined) {
  // The rest, or the retraction, was already prepared, but no frame of it was taken.
  for (const Idle idle : {Idle::end, Idle::living_rest}) {
    Player player(shared_cache(), {.idle = idle});
    player.sign(parse_utterance("DEMAIN#1"));
    Shown shown;
    show(player, shown, 1);
    player.prepare(Player::kMostReady);
    player.append(parse_utterance("MATIN#1"));
    show(player, shown, 500);
    const Synthesized made = synthesize(corpus(), parse_utterance("DEMAIN#1 MATIN#1"));
    const auto of = [&](std::size_t place) {
      return std::ranges::find(shown.events, place, &PlayerEvent::place)->frame;
    };
    EXPECT_EQ(of(1) - of(0),
              static_cast<std::uint64_t>(made.result.clips[1].core.begin - made.result.clips[0].core.begin));
  }
}

TEST(Player, TheFirstFrameComesBeforeTheLastGloss) {
  Player player(shared_cache(), {});
  EXPECT_EQ(player.header(), nullptr);
  EXPECT_EQ(player.prepare(10), 0u);
  player.append(parse_utterance("DEMAIN"));
  EXPECT_GE(player.prepare(10), 10u);
  ASSERT_NE(player.header(), nullptr);
  EXPECT_FALSE(player.header()->declarations.empty());
  Shown shown;
  show(player, shown, 10);
  player.append(parse_utterance("MATIN PLUIE"));
  show(player, shown, 1500);
  EXPECT_EQ(shown.count(Kind::place), 3u);
  EXPECT_EQ(shown.count(Kind::rest), 1u);
  EXPECT_TRUE(player.idle());
}

}  // namespace
}  // namespace signweave
