// The frames shown by a player are those that its score renders, whatever requests it received meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "signweave/choose/open_score.h"
#include "signweave/notation/score_json.h"
#include "tests/player_showing.h"

namespace signweave {
namespace {

/// A player at tempo 1, whose frames are all stored and compared with what its score renders.
class ComparedPlayer {
 public:
  explicit ComparedPlayer(const PlayerOptions& options) : player_(shared_cache(), options) {}

  Player& player() noexcept { return player_; }
  std::size_t compared() const noexcept { return compared_; }
  std::size_t kinds_seen(SourceRef::Kind kind) const noexcept { return seen_[static_cast<std::size_t>(kind)]; }

  void take(std::size_t most) {
    const std::size_t ready = player_.prepare(most);
    const StreamHeader* const header = player_.header();
    if (header == nullptr) return;
    if (shown_.frame_count() == 0) begin(*header);
    const std::optional<ShownScore> live = player_.score();
    const std::int64_t before = shown_.frame_count();
    std::vector<float> tracks(header->tracks.size());
    Motion room(header->skeleton, header->rate, 1);
    for (std::size_t k = 0; k < std::min(ready, most) && player_.next({room.pose(0), tracks}); ++k) {
      shown_.append(room.pose(0));
      for (std::size_t i = 0; i < tracks.size(); ++i) tracks_[i].push_back(tracks[i]);
    }
    while (const std::optional<PlayerEvent> event = player_.take_event()) {
      if (event->kind != PlayerEvent::Kind::place) continue;
      ASSERT_GE(event->clip, live->first_clip);
      const Clip& clip = live->score.clips.at(event->clip - live->first_clip);
      EXPECT_EQ(clip.source.recording, event->recording);
      if (!event->gloss.empty()) {
        EXPECT_TRUE(std::ranges::any_of(clip.signs, [&](const Sign& sign) { return sign.gloss == event->gloss; }));
      }
    }
    if (shown_.frame_count() > before) compare(*live, before);
  }

 private:
  void begin(const StreamHeader& header) {
    shown_ = Motion(header.skeleton, header.rate, 0);
    tracks_.resize(header.tracks.size());
  }

  /// The frames shown before a score began.
  ScoreSource frames_before(const ShownScore& live, std::int64_t taken) const {
    const std::int64_t count = live.score.clips.front().core.size();
    const std::int64_t end = taken - (live.next - count);
    Motion motion(shown_.shared_skeleton(), shown_.rate(), 0);
    for (std::int64_t frame = end - count; frame < end; ++frame) motion.append(shown_.pose(frame));
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      motion.add_track({player_.header()->tracks[i], {tracks_[i].begin() + (end - count), tracks_[i].begin() + end}});
    }
    return {std::make_shared<MemorySource>(std::move(motion)), nullptr};
  }

  void compare(const ShownScore& live, std::int64_t before) {
    for (const Clip& clip : live.score.clips) ++seen_[static_cast<std::size_t>(clip.source.kind)];
    const Score read = score_from_json(json_of(live.score), "stream");
    EXPECT_EQ(read, live.score);
    OpenScore open(corpus(), read, [&](const SourceRef& source) {
      if (source.kind == SourceRef::Kind::rest) return ScoreSource{player_.rest(), nullptr};
      return frames_before(live, before);
    });
    Motion made;
    open.render({live.next, live.next + shown_.frame_count() - before}, made);
    ASSERT_EQ(made.skeleton().joint_count(), shown_.skeleton().joint_count());
    for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
      const PoseView is = shown_.pose(before + frame);
      const PoseView expected = std::as_const(made).pose(frame);
      for (std::size_t joint = 0; joint < is.rotations.size(); ++joint) {
        const auto& a = is.rotations[joint].coeffs();
        const auto& b = expected.rotations[joint].coeffs();
        ASSERT_TRUE(a == b || a == -b) << "frame " << before + frame << ", joint " << joint << "\n" << to_string(read);
      }
      ASSERT_TRUE(std::ranges::equal(is.translations, expected.translations)) << "frame " << before + frame;
      for (std::size_t i = 0; i < tracks_.size(); ++i) {
        const auto at = std::ranges::find(made.tracks(), player_.header()->tracks[i], &ScalarTrack::name);
        const float value = at == made.tracks().end() ? 0.0f : at->values[static_cast<std::size_t>(frame)];
        ASSERT_EQ(tracks_[i][static_cast<std::size_t>(before + frame)], value)
            << "frame " << before + frame << ", track " << player_.header()->tracks[i];
      }
      ++compared_;
    }
  }

  Player player_;
  Motion shown_;
  std::vector<std::vector<float>> tracks_;
  std::size_t compared_ = 0;
  std::array<std::size_t, 3> seen_{};
};

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
    Player& player = stream.player();
    player.sign(utterance());
    for (int step = 0; step < 16 && !testing::Test::HasFatalFailure(); ++step) {
      for (std::size_t i = below(5); i > 0; --i) stream.take(10 + below(54));
      switch (below(6)) {
        case 0:
          player.sign(utterance());
          break;
        case 1:
        case 2:
          player.append(utterance());
          break;
        case 3:
          player.seek(Milliseconds(below(6000)));
          break;
        case 4:
          player.set_loop(below(2) == 0);
          break;
        default:
          if (below(3) == 0) player.stop();
      }
    }
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
