#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "signweave/choose/open_score.h"
#include "signweave/core/error.h"
#include "signweave/notation/score_json.h"
#include "signweave/score/lane_chain.h"
#include "tests/player_showing.h"

namespace signweave {

/// A player at tempo 1, whose frames are all stored and compared with what its score renders.
class ComparedPlayer {
 public:
  explicit ComparedPlayer(const PlayerOptions& options) : player_(shared_cache(), options) {}

  Player& player() noexcept { return player_; }
  std::size_t compared() const noexcept { return compared_; }
  const std::vector<std::string>& notices() const noexcept { return notices_; }
  /// How many compared frames were of a score in which lanes differ.
  std::size_t lanes_seen() const noexcept { return lanes_seen_; }
  std::size_t kinds_seen(SourceRef::Kind kind) const noexcept { return seen_[static_cast<std::size_t>(kind)]; }

  /// Shows up to `most` frames. `refused` gets the message if a place cannot be signed; null: it is thrown.
  void take(std::size_t most, std::vector<std::string>* refused = nullptr) {
    std::size_t ready = 0;
    try {
      ready = player_.prepare(most);
    } catch (const Error& error) {
      if (refused == nullptr) throw;
      refused->push_back(error.what());
      return;
    }
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
      if (event->kind == PlayerEvent::Kind::notice) notices_.push_back(event->text);
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
    const Clip& first = live.score.clips.front();
    // A sign that is finished before another utterance: its frames are not all shown yet.
    const bool is_finished =
        first.source.kind == SourceRef::Kind::shown && before + first.core.size() - live.next > shown_.frame_count();
    if (is_finished) return;
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
        ASSERT_TRUE(a == b || a == -b) << "frame " << before + frame << ", of the score " << live.next + frame
                                       << ", joint " << joint << ": " << a.transpose() << " against " << b.transpose()
                                       << "\n"
                                       << to_string(read);
      }
      ASSERT_TRUE(std::ranges::equal(is.translations, expected.translations)) << "frame " << before + frame;
      for (std::size_t i = 0; i < tracks_.size(); ++i) {
        const auto at = std::ranges::find(made.tracks(), player_.header()->tracks[i], &ScalarTrack::name);
        const float value = at == made.tracks().end() ? 0.0f : at->values[static_cast<std::size_t>(frame)];
        ASSERT_EQ(tracks_[i][static_cast<std::size_t>(before + frame)], value)
            << "frame " << before + frame << ", track " << player_.header()->tracks[i];
      }
      ++compared_;
      if (!lanes_that_differ(live.score).empty()) ++lanes_seen_;
    }
  }

  Player player_;
  Motion shown_;
  std::vector<std::vector<float>> tracks_;
  std::size_t compared_ = 0;
  std::size_t lanes_seen_ = 0;
  std::vector<std::string> notices_;
  std::array<std::size_t, 3> seen_{};
};

/// Shows some frames and then requests something, so often. `below` returns a random number below another, `utterance`
/// a random utterance.
template <typename Below, typename MakeUtterance>
void request_at_random(ComparedPlayer& stream, Below below, MakeUtterance utterance,
                       std::vector<std::string>* refused = nullptr) {
  Player& player = stream.player();
  player.sign(utterance());
  for (int step = 0; step < 16 && !testing::Test::HasFatalFailure(); ++step) {
    for (std::size_t i = below(5); i > 0; --i) stream.take(10 + below(54), refused);
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
}

}  // namespace signweave
