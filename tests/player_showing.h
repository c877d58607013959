#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "signweave/database/test_signing.h"
#include "signweave/live/player.h"
#include "tests/demo_database.h"

/// For tests: players of the demo corpus, and what they show.
namespace signweave {

using testing_database::TestFolder;
using Kind = PlayerEvent::Kind;

/// The demo corpus in a database, generated once.
inline const Database& corpus() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = demo_database(folder / "db", 6);
  return *database;
}

inline SharedSigningCache& shared_cache() {
  static SharedSigningCache shared(corpus());
  return shared;
}

/// What a player showed.
struct Shown {
  Motion motion;
  std::vector<PlayerEvent> events;
  std::vector<std::vector<float>> tracks;  ///< [frame][track]

  std::size_t count(Kind kind) const {
    return static_cast<std::size_t>(std::ranges::count(events, kind, &PlayerEvent::kind));
  }
  /// The signed tokens, as an utterance that leaves nothing to choose.
  std::string tokens(const std::vector<std::string>& pauses = {}) const {
    std::string text;
    for (const PlayerEvent& event : events) {
      if (event.kind != Kind::place) continue;
      if (event.place < pauses.size()) text += pauses[event.place];
      text += to_string(GlossRef{event.gloss, event.token}) + " ";
    }
    return text;
  }
};

/// Takes frames until none is ready, at most `most`.
inline void show(Player& player, Shown& shown, std::size_t most = 100'000, std::size_t at_once = 32) {
  for (std::size_t taken = 0; taken < most;) {
    const std::size_t ready = player.prepare(std::min(at_once, most - taken));
    if (player.header() == nullptr) return;
    if (shown.motion.frame_count() == 0) shown.motion = Motion(player.header()->skeleton, player.header()->rate);
    std::size_t here = 0;
    for (; here < ready && taken < most; ++here, ++taken) {
      while (auto event = player.take_event()) shown.events.push_back(std::move(*event));
      shown.tracks.emplace_back(player.header()->tracks.size());
      if (!player.next({shown.motion.append(), shown.tracks.back()})) {
        ADD_FAILURE() << "a frame was promised";
        return;
      }
    }
    if (here == 0) break;
  }
  while (auto event = player.take_event()) shown.events.push_back(std::move(*event));
}

inline Shown shown_whole(const std::string& utterance, PlayerOptions options) {
  options.idle = Idle::end;
  Player player(shared_cache(), std::move(options));
  player.sign(parse_utterance(utterance));
  Shown shown;
  show(player, shown);
  return shown;
}

/// Expects the same frames, up to the signs of quaternions.
inline void expect_same(const Shown& shown, const Synthesized& made, const std::string& what) {
  const Motion& a = shown.motion;
  const Motion& b = made.result.motion;
  ASSERT_EQ(a.frame_count(), b.frame_count()) << what;
  for (std::int64_t frame = 0; frame < a.frame_count(); ++frame) {
    const PoseView one = a.pose(frame);
    const PoseView other = b.pose(frame);
    for (std::size_t joint = 0; joint < one.rotations.size(); ++joint) {
      const Eigen::Vector4f q = one.rotations[joint].coeffs();
      const Eigen::Vector4f r = other.rotations[joint].coeffs();
      ASSERT_TRUE(q == r || q == -r) << what << ": frame " << frame << " of " << a.frame_count() << ", joint "
                                     << a.skeleton().joint(static_cast<JointIndex>(joint)).name << ": "
                                     << (q - r).norm();
    }
    for (std::size_t t = 0; t < one.translations.size(); ++t) {
      ASSERT_EQ(one.translations[t], other.translations[t]) << what << ": frame " << frame;
    }
    for (std::size_t t = 0; t < b.tracks().size(); ++t) {
      ASSERT_EQ(shown.tracks[static_cast<std::size_t>(frame)][t], b.tracks()[t].values[static_cast<std::size_t>(frame)])
          << what << ": frame " << frame << ", " << b.tracks()[t].name;
    }
  }
}

/// The greatest rotation of any joint, and displacement of the root, from one frame to the next.
inline std::pair<float, float> greatest_step(const Motion& motion, std::int64_t from = 1) {
  float turn = 0;
  float displacement = 0;
  for (std::int64_t frame = std::max<std::int64_t>(from, 1); frame < motion.frame_count(); ++frame) {
    const PoseView a = motion.pose(frame - 1);
    const PoseView b = motion.pose(frame);
    for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
      EXPECT_GE(a.rotations[joint].dot(b.rotations[joint]), 0.0f) << frame;  // one hemisphere
      turn = std::max(turn, a.rotations[joint].angularDistance(b.rotations[joint]));
    }
    displacement = std::max(displacement, (a.translations[0] - b.translations[0]).norm());
  }
  return {turn, displacement};
}

}  // namespace signweave
