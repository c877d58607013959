// Tests reading frames of a stored motion directly into the caller's memory.

#include <gtest/gtest.h>

#include "signweave/core/error.h"
#include "signweave/motion_db/packet.h"
#include "signweave/motion_db/test_motion.h"

namespace signweave::motion_db {
namespace {

Motion read_all(const MotionSource& source, FrameRange frames) {
  Motion motion;
  motion.reset(source.skeleton(), source.rate(), frames.size());
  source.read(frames, motion.poses({0, frames.size()}));
  std::vector<ScalarTrack> tracks;
  std::vector<std::span<float>> spans;
  tracks.reserve(source.tracks().size());
  for (const std::string& name : source.tracks()) {
    tracks.push_back({name, std::vector<float>(static_cast<std::size_t>(frames.size()))});
    spans.emplace_back(tracks.back().values);
  }
  source.read_tracks(frames, spans);
  for (ScalarTrack& track : tracks) motion.add_track(std::move(track));
  return motion;
}

struct Stored {
  TestStore store;
  StoredMotion stored;

  Stored(const std::string& engine, const Motion& motion, AccessMode mode)
      : store(engine), stored(put_motion(*store, motion, mode)) {}
  std::shared_ptr<const KnownMotion> known() const { return std::make_shared<KnownMotion>(*store->read(), stored); }
  StoredSource source(std::shared_ptr<const KnownMotion> known) const { return {store->read(), std::move(known)}; }
  /// Flips one bit of a record's payload.
  void damage(const Record& record) {
    const auto change = store->write();
    const ByteSpan value = *change->get(key_of(stored.generation, record));
    Bytes damaged(value.begin(), value.end());
    damaged.back() ^= std::byte{1};
    change->put(key_of(stored.generation, record), damaged);
    change->commit();
  }
};

class StoredSourceTest : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Engines, StoredSourceTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(StoredSourceTest, ReadsTheFramesOfEveryModeLosslessly) {
  const Motion motion = test_motion(700, 5, 1, 3);
  for (const AccessMode::Kind kind : kAllKinds) {
    for (const std::uint32_t p : {1u, 7u, 64u}) {
      const Stored stored(GetParam(), motion, {kind, p});
      const StoredSource source = stored.source(stored.known());
      ASSERT_EQ(source.frame_count(), 700);
      for (const FrameRange frames : {FrameRange{0, 700}, FrameRange{0, 1}, FrameRange{63, 65}, FrameRange{130, 611}}) {
        EXPECT_TRUE(same_bits(read_all(source, frames), motion.slice(frames))) << to_string(stored.stored.mode);
      }
      EXPECT_TRUE(same_bits(read_all(source, {3, 60}), motion.slice({3, 60}))) << "read again, nothing is verified";
    }
  }
}

TEST_P(StoredSourceTest, RefusesFramesThatTheMotionDoesNotHave) {
  const Stored stored(GetParam(), test_motion(20), {AccessMode::Kind::by_frame, 8});
  EXPECT_THROW(read_all(stored.source(stored.known()), {10, 21}), Error);
}

TEST_P(StoredSourceTest, FindsDamageWhenARecordIsFirstRead) {
  for (const AccessMode::Kind kind : kAllKinds) {
    Stored stored(GetParam(), test_motion(100, 5, 1, 2), {kind, 50});
    const auto known = stored.known();
    read_all(stored.source(known), {0, 10});  // the first block is read, the second is not
    std::vector<Record> second;
    for_each_packet(stored.stored, {60, 61}, {}, [&](const Record& record) { second.push_back(record); });
    stored.damage(second.back());
    const bool seen = second.back().block == 0;  // one block holds everything and was verified before
    const auto read = [&](std::shared_ptr<const KnownMotion> by) { read_all(stored.source(std::move(by)), {60, 70}); };
    if (seen) {
      EXPECT_NO_THROW(read(known));
    } else {
      EXPECT_THROW(read(known), Error);
    }
    EXPECT_THROW(read(stored.known()), Error);
  }
}

TEST_P(StoredSourceTest, FindsDamageInTracks) {
  Stored stored(GetParam(), test_motion(100, 5, 1, 2), {AccessMode::Kind::by_frame, 50});
  stored.damage({.kind = RecordKind::tracks, .part = 0, .block = 0, .frames = {0, 100}});
  try {
    read_all(stored.source(stored.known()), {0, 10});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("scalar tracks, frames [0, 100): its checksum is wrong"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace signweave::motion_db
