// The frames shown by a player are those that its score renders, whatever requests it received meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/compared_player.h"

namespace signweave {
namespace {

TEST(PlayerScore, RendersWhatIsShownWhateverIsRequested) {
  const std::vector<std::string> glosses = corpus().contents()->segments.glosses();
  std::size_t compared = 0;
  std::array<std::size_t, 3> seen{};
  for (unsigned seed = 0; seed < 24; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t count) { return random() % count; };
    const auto utterance = [&] {
      std::string text;
      for (std::size_t i = 1 + below(4); i > 0; --i) {
        text += below(8) == 0 ? "\"meteo\"@1200..2900 " : to_string(GlossRef{glosses[below(glosses.size())], 0}) + " ";
        if (below(6) == 0) text += ", ";
      }
      return parse_utterance(text);
    };
    PlayerOptions options{.idle = seed % 3 == 0 ? Idle::end : Idle::living_rest, .look_ahead = 1 + below(4)};
    options.synthesis.method = &transition_methods()[seed % transition_methods().size()];
    if (below(3) == 0) options.synthesis.rate = FrameRate{30, 1};
    if (below(4) == 0) options.synthesis.tempo = 1.3;
    options.synthesis.alignment = below(3) == 0 ? Alignment::ground : Alignment::automatic;
    options.loop = below(6) == 0;
    if (below(4) == 0) options.recording = "villes";
    ComparedPlayer stream(options);
    request_at_random(stream, below, utterance);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "seed " << seed;
    compared += stream.compared();
    for (std::size_t kind = 0; kind < seen.size(); ++kind) {
      seen[kind] += stream.kinds_seen(static_cast<SourceRef::Kind>(kind));
    }
  }
  EXPECT_GT(compared, 15'000u);
  for (const std::size_t count : seen) EXPECT_GT(count, 20u);
}

TEST(PlayerScore, AnotherUtteranceTwiceInOneSign) {
  // Signs that were recorded one after another form one clip; the second change comes before the first is shown.
  for (std::size_t until = 1; until < 140; until += 5) {
    ComparedPlayer stream({.idle = Idle::end});
    Player& player = stream.player();
    player.sign(parse_utterance("VENT FORT"));
    for (std::size_t taken = 0; taken < until; ++taken) stream.take(1);
    player.sign(parse_utterance("VANNES"));
    stream.take(1);
    player.prepare(64);
    player.sign(parse_utterance("RENNES"));
    for (int i = 0; i < 30 && !player.idle(); ++i) stream.take(32);
    EXPECT_TRUE(player.idle());
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << until;
  }
}

TEST(PlayerScore, HasTheLastClipsOfALongStream) {
  ComparedPlayer stream({.idle = Idle::end});
  std::string text;
  for (int i = 0; i < 40; ++i) text += "VANNES , MATIN#1 , ";
  stream.player().sign(parse_utterance(text));
  std::size_t first_clip = 0;
  for (int i = 0; !stream.player().idle() && i < 1000 && !testing::Test::HasFatalFailure(); ++i) {
    stream.take(64);
    if (const auto live = stream.player().score()) {
      first_clip = live->first_clip;
      EXPECT_LE(live->score.clips.size(), 64u);
      EXPECT_EQ(live->score.clips.front().at.begin == 0, first_clip > 0) << "then it begins with a core";
    }
  }
  EXPECT_TRUE(stream.player().idle());
  EXPECT_EQ(first_clip, 16u);
}

}  // namespace
}  // namespace signweave
