// Tests reading from engines that fill a buffer: no value may be used after its buffer was reused.

#include <gtest/gtest.h>

#include "signweave/motion_db/packet.h"
#include "signweave/motion_db/test_motion.h"

namespace signweave::motion_db {
namespace {

/// A snapshot like that of an engine without a map: a value lies in the buffer and is lost when that is reused. Lending
/// a value for the whole transaction, for which such an engine would need a copy, is refused.
class Filling final : public kv::ReadTransaction {
 public:
  explicit Filling(std::unique_ptr<kv::ReadTransaction> inner) : inner_(std::move(inner)) {}

  std::optional<ByteSpan> get(ByteSpan) const override { throw Error(ErrorCode::io, "a value was borrowed for good"); }
  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override {
    ++gets;
    std::fill(buffer.begin(), buffer.end(), std::byte{0xAA});
    buffer = Bytes();  // a different block of memory each time
    const std::optional<ByteSpan> value = inner_->get(key);
    if (!value) return std::nullopt;
    buffer.assign(value->begin(), value->end());
    largest = std::max(largest, buffer.size());
    return ByteSpan(buffer);
  }

  mutable int gets = 0;
  mutable std::size_t largest = 0;

 private:
  std::unique_ptr<kv::ReadTransaction> inner_;
};

/// A snapshot like that of an engine with a map; counts the lookups.
class Lending final : public kv::ReadTransaction {
 public:
  explicit Lending(std::unique_ptr<kv::ReadTransaction> inner) : inner_(std::move(inner)) {}
  std::optional<ByteSpan> get(ByteSpan key) const override {
    ++gets;
    return inner_->get(key);
  }
  std::optional<ByteSpan> get(ByteSpan key, Bytes&) const override { return get(key); }

  mutable int gets = 0;

 private:
  std::unique_ptr<kv::ReadTransaction> inner_;
};

Motion read_from(const MotionSource& source, FrameRange frames) {
  Motion motion;
  motion.reset(source.skeleton(), source.rate(), frames.size());
  source.read(frames, motion.poses({0, frames.size()}));
  return motion;
}

Motion without_tracks(Motion motion) {
  motion.take_tracks();
  return motion;
}

TEST(ReadBuffer, AValueIsNotUsedAfterItsBuffer) {
  const TestStore store;
  const Motion motion = test_motion(400, 19, 1, 3);
  std::uint64_t generation = 0;
  for (const AccessMode::Kind kind : kAllKinds) {
    for (const std::uint32_t p : {7u, 64u}) {
      const StoredMotion stored = put_motion(*store, motion, {kind, p}, ++generation);
      const auto snapshot = std::make_shared<const Filling>(store->read());
      const auto known = std::make_shared<const KnownMotion>(*snapshot, stored);
      const StoredSource source(snapshot, known);
      for (const FrameRange frames : {FrameRange{0, 400}, FrameRange{63, 65}, FrameRange{130, 311}}) {
        const Motion all = read(*snapshot, stored, known->skeleton(), frames);
        EXPECT_TRUE(same_bits(all, motion.slice(frames))) << to_string(stored.mode);
        const JointSet some = {0, 1, 3, 4, 5, 6, 7, 8, 9, 12, 18};
        EXPECT_TRUE(same_bits(read(*snapshot, stored, known->skeleton(), frames, some), expected(motion, frames, some)))
            << to_string(stored.mode);
        EXPECT_TRUE(same_bits(read_from(source, frames), without_tracks(motion.slice(frames))))
            << to_string(stored.mode);
        EXPECT_TRUE(same_bits(read_from(source, frames), without_tracks(motion.slice(frames)))) << "and again";
      }
      EXPECT_TRUE(check(*snapshot, stored).empty());
    }
  }
}

TEST(ReadBuffer, ValuesThatAnEngineLendsAreLookedUpOnce) {
  const TestStore store;
  const Motion motion = test_motion(400, 5);
  const StoredMotion stored = put_motion(*store, motion, {AccessMode::Kind::by_frame, 10});
  const auto snapshot = std::make_shared<const Lending>(store->read());
  const auto known = std::make_shared<const KnownMotion>(*snapshot, stored);
  const StoredSource source(snapshot, known);
  snapshot->gets = 0;
  read_from(source, {95, 115});
  EXPECT_EQ(snapshot->gets, 3);
  EXPECT_TRUE(same_bits(read_from(source, {91, 120}), motion.slice({91, 120})));
  EXPECT_EQ(snapshot->gets, 3);
  EXPECT_TRUE(same_bits(read_from(source, {85, 100}), motion.slice({85, 100})));
  EXPECT_EQ(snapshot->gets, 4);
}

TEST(ReadBuffer, RequestsForMissingRecordsAreRefusedAfterAFewLookups) {
  const TestStore store;
  const Motion motion = test_motion(400, 5, 1, 1);
  std::uint64_t generation = 0;
  for (const AccessMode::Kind kind : kAllKinds) {
    StoredMotion stored = put_motion(*store, motion, {kind, 10}, ++generation);
    stored.frames = 4'000'000'000;  // 300 GB
    const Filling snapshot(store->read());
    const auto skeleton = read_skeleton(snapshot, stored);
    snapshot.gets = 0;
    EXPECT_THROW(read(snapshot, stored, skeleton, {0, stored.frames}), Error) << to_string(stored.mode);
    EXPECT_LE(snapshot.gets, 15) << to_string(stored.mode);
  }
}

TEST(ReadBuffer, ALargeMotionWithMissingRecordsIsRefused) {
  const TestStore store;
  const Motion motion = test_motion(1'500, 3'000);  // 72 MB and more
  const StoredMotion stored = put_motion(*store, motion, {AccessMode::Kind::by_frame, 10});
  const auto whole = [&] {
    const auto snapshot = store->read();
    return read(*snapshot, stored, read_skeleton(*snapshot, stored), {0, 1'500});
  };
  EXPECT_TRUE(same_bits(whole(), motion));
  for (const std::uint32_t block : {149u, 144u, 17u}) {  // the last, one of the sample, one outside the sample
    const auto change = store->write();
    change->erase(key_of(stored.generation, {.kind = RecordKind::packet, .part = kAllJoints, .block = block}));
    change->commit();
    EXPECT_THROW(whole(), Error) << block;
    put(*store, stored, motion);
  }
}

}  // namespace
}  // namespace signweave::motion_db
