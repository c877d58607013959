#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/motion_db/motion_db.h"
#include "signweave/motion_db/packet.h"
#include "signweave/motion_db/test_motion.h"

/// Tests that stored bytes are never trusted.
namespace signweave::motion_db {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr FrameRange kFrames{0, 100};

Record packet(std::uint16_t part, std::uint32_t block, FrameRange frames) {
  return {.kind = RecordKind::packet, .part = part, .block = block, .frames = frames};
}

Bytes value_of(const kv::KvStore& store, const StoredMotion& stored, const Record& record) {
  const auto snapshot = store.read();
  const std::optional<ByteSpan> value = snapshot->get(key_of(stored.generation, record));
  if (!value) return {};
  return Bytes(value->begin(), value->end());
}

void replace(kv::KvStore& store, const StoredMotion& stored, const Record& record, ByteSpan value) {
  const auto change = store.write();
  change->put(key_of(stored.generation, record), value);
  change->commit();
}

void remove(kv::KvStore& store, const StoredMotion& stored, const Record& record) {
  const auto change = store.write();
  EXPECT_TRUE(change->erase(key_of(stored.generation, record)));
  change->commit();
}

/// A record with deliberately changed bytes and a matching checksum.
Bytes sealed(Bytes value) {
  const std::uint64_t sum = checksum(ByteSpan(value).subspan(8));
  std::memcpy(value.data(), &sum, sizeof sum);
  return value;
}

/// The text of the Error{corrupt} that reading throws; "" if nothing was thrown.
std::string fault_in(const kv::KvStore& store, const StoredMotion& stored, FrameRange frames,
                     const JointSet& joints = {}) {
  const auto snapshot = store.read();
  try {
    read(*snapshot, stored, read_skeleton(*snapshot, stored), frames, joints);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::corrupt) << error.what();
    return error.what();
  }
  return "";
}

class DamageTest : public testing::TestWithParam<std::string> {
 protected:
  StoredMotion put_as(AccessMode mode) {
    StoredMotion stored = describe(motion_, mode, ++generation_);
    put(*store_, stored, motion_);
    return stored;
  }

  TestStore store_{GetParam()};
  Motion motion_ = test_motion(100, 6, 1, 1);
  std::uint64_t generation_ = 70;
};

INSTANTIATE_TEST_SUITE_P(Engines, DamageTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(DamageTest, AFlippedBitNamesItsFramesAndLeavesOtherRangesReadable) {
  const StoredMotion stored = put_as({AccessMode::Kind::by_frame, 10});
  const Record damaged = packet(kAllJoints, 4, {40, 50});
  Bytes value = value_of(*store_, stored, damaged);
  value[500] ^= std::byte{0x10};
  replace(*store_, stored, damaged, value);
  EXPECT_EQ(fault_in(*store_, stored, kFrames),
            "stored motion 71, all joints, frames [40, 50): its checksum is wrong; import the recording again "
            "or restore the database from a copy");
  EXPECT_NE(fault_in(*store_, stored, {49, 51}), "");
  EXPECT_EQ(fault_in(*store_, stored, {0, 40}), "");
  EXPECT_EQ(fault_in(*store_, stored, {50, 100}), "");
}

TEST_P(DamageTest, AFlippedBitNamesItsJointAndLeavesOtherJointsReadable) {
  const StoredMotion stored = put_as({AccessMode::Kind::by_joint_and_frame, 10});
  const Record damaged = packet(3, 9, {90, 100});
  Bytes value = value_of(*store_, stored, damaged);
  value[40] ^= std::byte{0x01};
  replace(*store_, stored, damaged, value);
  EXPECT_THAT(fault_in(*store_, stored, kFrames),
              HasSubstr("stored motion 71, joint 3 (Joint 3), frames [90, 100): its checksum is wrong"));
  EXPECT_EQ(fault_in(*store_, stored, {90, 100}, {0, 1, 2, 4, 5}), "");
  EXPECT_EQ(fault_in(*store_, stored, {0, 90}), "");
}

TEST_P(DamageTest, EveryFlippedBitOfEveryRecordIsDetected) {
  const Motion small = test_motion(2, 2, 5, 1);
  for (const AccessMode::Kind kind : kAllKinds) {
    const StoredMotion stored = describe(small, {kind, 1}, ++generation_);
    put(*store_, stored, small);
    std::vector<Record> records{Record{}};
    for_each_packet(stored, {0, 2}, {}, [&](const Record& record) { records.push_back(record); });
    for_each_track_record(stored, {0, 2}, [&](const Record& record) { records.push_back(record); });
    for (const Record& record : records) {
      const Bytes sound = value_of(*store_, stored, record);
      ASSERT_FALSE(sound.empty());
      for (std::size_t bit = 0; bit < sound.size() * 8; bit += 3) {
        Bytes value = sound;
        value[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
        const auto change = store_->write();  // never committed: a transaction sees its own puts
        change->put(key_of(stored.generation, record), value);
        EXPECT_EQ(check(*change, stored).size(), 1u) << to_string(stored.mode) << " bit " << bit;
        EXPECT_THROW(read(*change, stored, read_skeleton(*change, stored), {0, 2}), Error);
      }
    }
  }
}

TEST_P(DamageTest, ValuesOfEveryWrongSizeAreFaultsNotOverflows) {
  for (const AccessMode::Kind kind : kAllKinds) {
    const StoredMotion stored = put_as({kind, 50});
    const std::uint16_t part = cut_by_joint(stored.mode) ? 0 : kAllJoints;
    const Record record = packet(part, 0, {0, std::min<std::int64_t>(packet_frames(stored), 100)});
    const Bytes sound = value_of(*store_, stored, record);
    ASSERT_FALSE(sound.empty());
    for (std::size_t size = 0; size < sound.size() + 64; size = size < 64 ? size + 1 : size + 97) {
      if (size == sound.size()) continue;
      Bytes value = sound;
      value.resize(size);
      const auto change = store_->write();
      change->put(key_of(stored.generation, record), size < 8 ? value : sealed(value));
      EXPECT_EQ(check(*change, stored).size(), 1u) << size;
      EXPECT_THROW(read(*change, stored, read_skeleton(*change, stored), kFrames), Error) << size;
    }
  }
}

TEST_P(DamageTest, AWrongHeaderIsAFaultEvenWithAMatchingChecksum) {
  const StoredMotion stored = put_as({AccessMode::Kind::by_joint_and_frame, 10});
  const Record record = packet(1, 2, {20, 30});
  const Bytes sound = value_of(*store_, stored, record);
  for (std::size_t at = 8; at < kHeaderSize; ++at) {
    Bytes value = sound;
    value[at] ^= std::byte{0x01};
    const auto change = store_->write();
    change->put(key_of(stored.generation, record), sealed(value));
    EXPECT_EQ(check(*change, stored).size(), 1u) << "byte " << at;
    EXPECT_THROW(read(*change, stored, read_skeleton(*change, stored), kFrames), Error) << "byte " << at;
  }
}

TEST_P(DamageTest, APacketUnderAnothersKeyIsAFault) {
  const StoredMotion stored = put_as({AccessMode::Kind::by_frame, 10});
  replace(*store_, stored, packet(kAllJoints, 3, {30, 40}), value_of(*store_, stored, packet(kAllJoints, 5, {50, 60})));
  EXPECT_THAT(fault_in(*store_, stored, {35, 36}), HasSubstr("frames [30, 40): another record is in its place"));
}

TEST_P(DamageTest, CheckListsEveryFaultWithJointsAndFrames) {
  const StoredMotion stored = put_as({AccessMode::Kind::by_joint_and_frame, 30});
  EXPECT_THAT(check(*store_->read(), stored), ElementsAre());
  remove(*store_, stored, packet(2, 0, {0, 30}));
  Bytes value = value_of(*store_, stored, packet(4, 3, {90, 100}));
  value.back() ^= std::byte{0xFF};
  replace(*store_, stored, packet(4, 3, {90, 100}), value);
  replace(*store_, stored, {.kind = RecordKind::tracks, .part = 0, .block = 0, .frames = {0, 100}}, {});
  EXPECT_THAT(check(*store_->read(), stored),
              ElementsAre("stored motion 71, joint 2 (Joint 2), frames [0, 30): it is missing",
                          "stored motion 71, joint 4 (Joint 4), frames [90, 100): its checksum is wrong",
                          "stored motion 71, scalar tracks, frames [0, 100): it is cut short"));
}

TEST_P(DamageTest, ADamagedSkeletonIsOneFaultAndPacketsAreStillChecked) {
  for (const AccessMode::Kind kind : kAllKinds) {
    const StoredMotion stored = put_as({kind, 30});
    Bytes value = value_of(*store_, stored, Record{});
    value[50] ^= std::byte{0x40};
    replace(*store_, stored, Record{}, value);
    const std::vector<std::string> faults = check(*store_->read(), stored);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_THAT(faults[0], AllOf(HasSubstr("skeleton: its checksum is wrong"), HasSubstr("import")));
    EXPECT_THROW(read_skeleton(*store_->read(), stored), Error);
  }
}

TEST_P(DamageTest, AWrongSkeletonRecordIsAnErrorNotAHugeAllocation) {
  const StoredMotion stored = put_as({});
  const Bytes sound = value_of(*store_, stored, Record{});
  for (std::size_t at = kHeaderSize; at < sound.size(); ++at) {
    Bytes value = sound;
    value[at] = std::byte{0xFF};
    const auto change = store_->write();
    change->put(key_of(stored.generation, Record{}), sealed(value));
    try {
      read_skeleton(*change, stored);  // a name or an offset may differ and still be valid
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::corrupt) << error.what();
    }
    change->put(key_of(stored.generation, Record{}),
                sealed(Bytes(sound.begin(), sound.begin() + static_cast<int>(at))));
    EXPECT_THROW(read_skeleton(*change, stored), Error) << at;
  }
}

TEST_P(DamageTest, ADescriptorThatClaimsMoreThanIsStoredAllocatesNothing) {
  for (const AccessMode::Kind kind : kAllKinds) {
    StoredMotion stored = put_as({kind, 10});
    stored.frames = 4'000'000'000;
    stored.tracks.clear();
    EXPECT_NE(fault_in(*store_, stored, {0, stored.frames}), "");
    EXPECT_NE(fault_in(*store_, stored, {3'999'999'999, stored.frames}), "");
  }
}

StoredMotion some_descriptor() {
  return describe(test_motion(100, 6, 1, 3), {AccessMode::Kind::by_joint_and_frame, 12}, 0x1122334455667788);
}

TEST(StoredMotion, RoundTrips) {
  ByteWriter out;
  encode(some_descriptor(), out);
  out.number(std::uint8_t{9});
  ByteReader in(out.bytes(), "record");
  EXPECT_EQ(decode(in), some_descriptor());
  EXPECT_EQ(in.left(), 1u) << "the following bytes belong to the caller";
}

TEST(StoredMotion, CutOrChangedBytesAreAnErrorOrAnotherValidDescriptor) {
  ByteWriter out;
  encode(some_descriptor(), out);
  for (std::size_t size = 0; size < out.size(); ++size) {
    ByteReader in(ByteSpan(out.bytes()).first(size), "record");
    EXPECT_THROW(decode(in), Error) << size;
  }
  for (std::size_t at = 0; at < out.size(); ++at) {
    for (const std::byte value : {std::byte{0}, std::byte{0x7F}, std::byte{0xFF}}) {
      Bytes bytes = out.bytes();
      bytes[at] = value;
      ByteReader in(bytes, "record");
      try {
        const StoredMotion stored = decode(in);
        EXPECT_GT(packet_count(stored), 0u);
        EXPECT_GT(stored.rate.hertz(), 0.0);
        EXPECT_LE(stored.translations, stored.joints);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), at == 0 ? ErrorCode::unsupported : ErrorCode::corrupt);
      }
    }
  }
}

TEST(StoredMotion, ANewerLayoutIsAnErrorThatSuggestsAFix) {
  ByteWriter out;
  encode(some_descriptor(), out);
  Bytes bytes = out.take();
  bytes[0] = std::byte{3};
  ByteReader in(bytes, "record");
  try {
    decode(in);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_THAT(error.what(), HasSubstr("use a newer signweave"));
  }
}

TEST_P(DamageTest, ListsNoMoreThanAThousandFaults) {
  const Motion motion = test_motion(1'500, 3);
  const StoredMotion stored = put_motion(*store_, motion, {AccessMode::Kind::by_frame, 1});
  erase(*store_, stored);
  const std::vector<std::string> faults = check(*store_->read(), stored);
  ASSERT_EQ(faults.size(), 1'001u);
  EXPECT_THAT(faults.back(), testing::HasSubstr("more faults than listed"));
}

}  // namespace
}  // namespace signweave::motion_db
