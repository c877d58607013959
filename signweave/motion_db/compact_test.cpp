#include "signweave/motion_db/compact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/motion_db/quantise.h"
#include "signweave/motion_db/test_compact.h"

namespace signweave::motion_db {
namespace {

/// Reads some frames through a StoredSource.
Motion read_source(const kv::KvStore& store, const StoredMotion& stored, FrameRange frames) {
  const std::shared_ptr<const kv::ReadTransaction> snapshot = store.read();
  const StoredSource source(snapshot, std::make_shared<KnownMotion>(*snapshot, stored));
  Motion motion;
  motion.reset(source.skeleton(), source.rate(), frames.size());
  source.read(frames, motion.poses({0, frames.size()}));
  return motion;
}

AccessMode any_mode(std::int64_t frames) {
  const auto n = static_cast<std::uint32_t>(frames);
  return {*rc::gen::elementOf(std::vector(std::begin(kAllKinds), std::end(kAllKinds))),
          *rc::gen::elementOf(std::vector<std::uint32_t>{0, 1, 7, 16, 33, n, n + 5})};
}

StoredMotion put_compact(kv::KvStore& store, const Motion& motion, AccessMode mode) {
  static std::uint64_t generation = 0;
  StoredMotion stored = describe(motion, mode, ++generation, 1e-4f);
  put(store, stored, motion);
  return stored;
}

RC_GTEST_PROP(Compact, EveryModeIsLossless, ()) {
  static const TestStore store;
  const Motion motion = any_motion();
  const Motion quantised = *rc::gen::arbitrary<bool>() ? quantise(motion, 1e-4f) : motion;
  const FrameRange all{0, motion.frame_count()};
  const StoredMotion first = put_compact(*store, quantised, any_mode(all.end));
  const Motion once = read_back(*store, first, all);
  RC_ASSERT(same_bits(once, quantised));
  const StoredMotion second = put_compact(*store, once, any_mode(all.end));
  RC_ASSERT(same_bits(read_back(*store, second, all), quantised));
  RC_ASSERT(check(*store->read(), second).empty());
  erase(*store, first);
  erase(*store, second);
  RC_ASSERT(store->info().entries == 0u);
}

RC_GTEST_PROP(Compact, AnyRangeOfAnyJointsIsTheSliceInMemory, ()) {
  static const TestStore store;
  const Motion motion = quantise(any_motion(), 1e-3f);
  const std::int64_t frames = motion.frame_count();
  const StoredMotion stored = put_compact(*store, motion, any_mode(frames));
  const auto begin = *rc::gen::inRange<std::int64_t>(0, frames + 1);
  const auto end = *rc::gen::inRange<std::int64_t>(begin, frames + 1);
  JointSet set;
  for (int joint = 0; joint < static_cast<int>(stored.joints); ++joint) {
    if (*rc::gen::arbitrary<bool>()) set.push_back(joint);
  }
  RC_ASSERT(same_bits(read_back(*store, stored, {begin, end}, set), expected(motion, {begin, end}, set)));
  RC_ASSERT(same_bits(read_source(*store, stored, {begin, end}), motion.slice({begin, end})));
  erase(*store, stored);
}

TEST(Compact, UnusualNumbersAreLossless) {
  const TestStore store;
  const Motion motion = test_motion(100, 7, 1, 3);
  for (const AccessMode::Kind kind : kAllKinds) {
    const StoredMotion stored = put_compact(*store, motion, {kind, 40});
    EXPECT_TRUE(same_bits(read_back(*store, stored, {0, 100}), motion)) << to_string(stored.mode);
  }
}

TEST(Compact, QuantisedMotionIsSmallInEveryMode) {
  const TestStore store;
  std::mt19937 random(5);
  const Motion motion = quantise(random_motion(random, 20, 600, Manner::smooth), 1e-4f);
  for (const AccessMode::Kind kind : kAllKinds) {
    const AccessMode mode{kind, 300};
    ReadCost plain, compact;
    const StoredMotion in_full = put_motion(*store, motion, mode, 1'000);
    read_back(*store, in_full, {0, 600}, {}, &plain);
    read_back(*store, put_compact(*store, motion, mode), {0, 600}, {}, &compact);
    EXPECT_LT(compact.bytes * 3, plain.bytes) << to_string(in_full.mode);
    erase(*store, in_full);
  }
}

TEST(Compact, TheDescriptorContainsTheTolerance) {
  const Motion motion = test_motion(5);
  const StoredMotion stored = describe(motion, {AccessMode::Kind::by_frame, 0}, 3, 1e-4f);
  EXPECT_EQ(stored.mode.frames_per_packet % 16, 0u);
  ByteWriter out;
  encode(stored, out);
  ByteReader in(out.bytes(), "record");
  EXPECT_EQ(decode(in), stored);
  EXPECT_EQ(in.left(), 0u);
  for (const float tolerance : {0.0f, -1.0f, std::nanf("")}) {
    Bytes bytes = out.bytes();
    std::memcpy(bytes.data() + bytes.size() - sizeof tolerance, &tolerance, sizeof tolerance);
    ByteReader damaged(bytes, "record");
    EXPECT_THROW(decode(damaged), Error) << tolerance;
  }
  EXPECT_THROW(describe(motion, {}, 3, -1e-4f), Error);
}

TEST(Compact, APacketWithTheOtherLayoutIsAFault) {
  const Motion motion = test_motion(5);
  const Record record{.kind = RecordKind::packet, .part = kAllJoints, .block = 0, .frames = {0, 5}};
  const Width width = width_of(motion.skeleton(), record);
  const Bytes plain = encode_packet(1, motion, record);
  const Bytes compact = encode_packet(1, motion, record, Packing::compact);
  EXPECT_EQ(fault_of(plain, 1, record, {width, Packing::plain}), nullptr);
  EXPECT_EQ(fault_of(compact, 1, record, {width, Packing::compact}), nullptr);
  EXPECT_NE(fault_of(plain, 1, record, {width, Packing::compact}), nullptr);
  EXPECT_NE(fault_of(compact, 1, record, {width, Packing::plain}), nullptr);
}

/// A payload of exact size on the heap, so that a sanitizer detects reads beyond it.
void try_payload(const Bytes& payload, const Record& record, const Skeleton& skeleton) {
  const Bytes exact(payload.begin(), payload.end());
  if (compact_fault(exact, record, width_of(skeleton, record)) != nullptr) return;
  Motion motion(std::make_shared<const Skeleton>(skeleton), FrameRate{60, 1}, record.frames.size());
  unpack(exact, record, skeleton, record.frames, {}, motion.poses({0, record.frames.size()}));
  unpack(exact, record, skeleton, record.frames, {0}, motion.poses({0, record.frames.size()}));
  const FrameRange last{record.frames.end - 1, record.frames.end};
  unpack(exact, record, skeleton, last, {}, motion.poses({0, 1}));
}

TEST(Compact, DamagedBytesCauseNoReadOutOfBounds) {
  std::mt19937 random(7);
  for (const Manner manner : {Manner::smooth, Manner::no_rotations, Manner::far_away}) {
    const Motion motion = quantise(random_motion(random, 6, 35, manner), 1e-4f);
    for (const std::uint16_t part : {kAllJoints, std::uint16_t{0}, std::uint16_t{3}}) {
      const Record record{.kind = RecordKind::packet, .part = part, .block = 0, .frames = {0, 35}};
      const Bytes sound = pack(motion, record);
      ASSERT_EQ(compact_fault(sound, record, width_of(motion.skeleton(), record)), nullptr);
      for (std::size_t at = 0; at < sound.size(); ++at) {
        for (const unsigned change : {0x01u, 0x10u, 0x80u, 0xFFu}) {
          Bytes payload = sound;
          payload[at] ^= static_cast<std::byte>(change);
          try_payload(payload, record, motion.skeleton());
        }
        try_payload(Bytes(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(at)), record, motion.skeleton());
      }
      Bytes longer = sound;
      longer.push_back(std::byte{0});
      EXPECT_NE(compact_fault(longer, record, width_of(motion.skeleton(), record)), nullptr);
    }
  }
}

TEST(Compact, AWidthBeyondTheMasksIsAFault) {
  std::mt19937 random(9);
  Motion motion = random_motion(random, 1, 5, Manner::still);
  while (motion.skeleton().translation_count() == 0) motion = random_motion(random, 1, 5, Manner::still);
  const Record record{.kind = RecordKind::packet, .part = 0, .block = 0, .frames = {0, 5}};
  Bytes payload = pack(quantise(motion, 1e-3f), record);
  // One run: its offset, ten bytes of header, ten of the rotation, then base, level and width of the translation's x.
  constexpr std::size_t kRowBits = 4;
  constexpr std::size_t kWidth = 4 + 10 + 10 + 5;
  ASSERT_EQ(payload[kWidth], std::byte{0});
  payload[kWidth] = std::byte{40};
  payload[kRowBits] = static_cast<std::byte>(std::to_integer<unsigned>(payload[kRowBits]) + 40);
  EXPECT_STREQ(compact_fault(payload, record, {1, 1}), "a number has too many bits");
}

TEST(Compact, EveryCutOrFlippedBitOfARecordIsDetected) {
  const TestStore store;
  const Motion motion = quantise(test_motion(20, 3, 5, 1), 1e-3f);
  for (const AccessMode::Kind kind : kAllKinds) {
    const StoredMotion stored = put_compact(*store, motion, {kind, 18});
    for_each_packet(stored, {0, 20}, {}, [&](const Record& record) {
      const Key key = key_of(stored.generation, record);
      const auto change = store->write();
      const ByteSpan value = *change->get(key);
      const Bytes sound(value.begin(), value.end());
      for (std::size_t bit = 0; bit < sound.size() * 8; bit += 37) {
        Bytes damaged = sound;
        damaged[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
        change->put(key, damaged);
        EXPECT_EQ(check(*change, stored).size(), 1u) << to_string(stored.mode) << " bit " << bit;
        EXPECT_THROW(read(*change, stored, read_skeleton(*change, stored), {0, 20}), Error);
        change->put(key, Bytes(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(bit / 8)));
        EXPECT_EQ(check(*change, stored).size(), 1u) << to_string(stored.mode) << " cut at " << bit / 8;
        EXPECT_THROW(read(*change, stored, read_skeleton(*change, stored), {0, 20}), Error);
      }
    });
  }
}

}  // namespace
}  // namespace signweave::motion_db
