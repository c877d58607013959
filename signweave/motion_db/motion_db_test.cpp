#include "signweave/motion_db/motion_db.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/motion_db/packet.h"
#include "signweave/motion_db/test_motion.h"

namespace signweave::motion_db {
namespace {

using testing::HasSubstr;

/// Tests that must pass on every engine of this build.
class MotionDbTest : public testing::TestWithParam<std::string> {
 protected:
  TestStore store_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Engines, MotionDbTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(MotionDbTest, EveryModeIsLossless) {
  const Motion motion = test_motion(2'100, 7, 1, 3);
  std::uint64_t generation = 0;
  for (const AccessMode::Kind kind : kAllKinds) {
    for (const std::uint32_t p : {0u, 1u, 7u, 2'100u, 5'000u}) {
      const StoredMotion stored = put_motion(*store_, motion, {kind, p}, ++generation);
      EXPECT_TRUE(same_bits(read_back(*store_, stored, {0, 2'100}), motion)) << to_string(stored.mode);
    }
  }
}

TEST_P(MotionDbTest, AfterEraseNothingIsLeft) {
  std::uint64_t generation = 0;
  const Motion motion = test_motion(2'100, 4, 1, 2);
  for (const AccessMode::Kind kind : kAllKinds) {
    const StoredMotion stored = put_motion(*store_, motion, {kind, 50}, ++generation);
    EXPECT_EQ(store_->info().entries, 1 + packet_count(stored) + 2) << "skeleton, packets, two records of tracks";
    erase(*store_, stored);
    EXPECT_EQ(store_->info().entries, 0u);
    erase(*store_, stored);
  }
}

TEST_P(MotionDbTest, APartlyWrittenMotionIsErasedCompletely) {
  const Motion motion = test_motion(3'000, 4, 1, 1);
  const StoredMotion stored = describe(motion, {AccessMode::Kind::by_frame, 1}, 9);
  struct Cancelled {};
  EXPECT_THROW(put(*store_, stored, motion,
                   [](double fraction) {
                     if (fraction > 0.5) throw Cancelled{};
                   }),
               Cancelled);
  EXPECT_GT(store_->info().entries, 1'000u);
  EXPECT_LT(store_->info().entries, 2'500u);
  erase(*store_, stored);
  EXPECT_EQ(store_->info().entries, 0u);
}

TEST_P(MotionDbTest, MotionsOfOtherGenerationsAreUnchanged) {
  const Motion first = test_motion(40, 5, 1);
  const Motion second = test_motion(60, 5, 2);
  const StoredMotion a = put_motion(*store_, first, {}, 256);
  const StoredMotion b = put_motion(*store_, second, {}, 1);
  erase(*store_, a);
  EXPECT_TRUE(same_bits(read_back(*store_, b, {0, 60}), second));
}

TEST_P(MotionDbTest, AnyRangeOfAnyJointsIsTheSliceInMemory) {
  std::uint64_t generation = 0;
  EXPECT_TRUE(rc::check("any range of any joints is the slice in memory", [&] {
    const auto frames = *rc::gen::inRange<std::int64_t>(1, 80);
    const int joints = *rc::gen::inRange(1, 9);
    const Motion motion = test_motion(frames, joints, *rc::gen::arbitrary<unsigned>(), *rc::gen::inRange(0, 3));
    const auto n = static_cast<std::uint32_t>(frames);
    const AccessMode mode{*rc::gen::elementOf(std::vector(std::begin(kAllKinds), std::end(kAllKinds))),
                          *rc::gen::elementOf(std::vector<std::uint32_t>{0, 1, 2, 7, 16, n, n + 5})};
    const StoredMotion stored = put_motion(*store_, motion, mode, ++generation);
    const auto begin = *rc::gen::inRange<std::int64_t>(0, frames + 1);
    const auto end = *rc::gen::inRange<std::int64_t>(begin, frames + 1);
    JointSet set;
    for (int joint = 0; joint < joints; ++joint) {
      if (*rc::gen::arbitrary<bool>()) set.push_back(joint);
    }
    ReadCost cost;
    RC_ASSERT(same_bits(read_back(*store_, stored, {begin, end}, set, &cost), expected(motion, {begin, end}, set)));

    const std::int64_t p = packet_frames(stored);
    const std::int64_t blocks = begin == end ? 0 : (end - 1) / p - begin / p + 1;
    const auto wanted = static_cast<std::int64_t>(set.empty() ? static_cast<std::size_t>(joints) : set.size());
    RC_ASSERT(cost.packets == static_cast<std::uint64_t>(blocks * (cut_by_joint(mode) ? wanted : 1)));
    RC_ASSERT(check(*store_->read(), stored).empty());
    erase(*store_, stored);
    RC_ASSERT(store_->info().entries == 0u);
  }));
}

TEST(MotionDb, PacketCountsMatchThePaper) {
  const Motion motion = test_motion(100, 6);
  const auto count = [&](AccessMode::Kind kind, std::uint32_t p) {
    return packet_count(describe(motion, {kind, p}, 1));
  };
  EXPECT_EQ(count(AccessMode::Kind::full, 0), 1u);
  EXPECT_EQ(count(AccessMode::Kind::by_frame, 30), 4u);
  EXPECT_EQ(count(AccessMode::Kind::by_frame, 25), 4u);
  EXPECT_EQ(count(AccessMode::Kind::by_frame, 101), 1u);
  EXPECT_EQ(count(AccessMode::Kind::by_joint, 0), 6u);
  EXPECT_EQ(count(AccessMode::Kind::by_joint_and_frame, 30), 24u);
  EXPECT_EQ(count(AccessMode::Kind::by_joint_and_frame, 1), 600u);
}

TEST_P(MotionDbTest, AReadFetchesOnlyTheRequestedPackets) {
  const Motion motion = test_motion(100, 6, 1, 1);
  struct Row {
    AccessMode mode;
    FrameRange frames;
    JointSet joints;
    std::uint64_t packets;
  };
  using Kind = AccessMode::Kind;
  const Row rows[] = {
      {{Kind::full, 0}, {40, 41}, {}, 1},
      {{Kind::full, 0}, {0, 100}, {2}, 1},
      {{Kind::by_frame, 10}, {40, 50}, {}, 1},
      {{Kind::by_frame, 10}, {39, 50}, {}, 2},
      {{Kind::by_frame, 10}, {39, 51}, {5}, 3},
      {{Kind::by_frame, 10}, {0, 100}, {}, 10},
      {{Kind::by_frame, 10}, {40, 40}, {}, 0},
      {{Kind::by_joint, 0}, {40, 41}, {}, 6},
      {{Kind::by_joint, 0}, {0, 100}, {0, 5}, 2},
      {{Kind::by_joint_and_frame, 10}, {40, 50}, {3}, 1},
      {{Kind::by_joint_and_frame, 10}, {39, 51}, {1, 2}, 6},
      {{Kind::by_joint_and_frame, 30}, {0, 100}, {}, 24},
  };
  std::uint64_t generation = 0;
  for (const Row& row : rows) {
    const StoredMotion stored = put_motion(*store_, motion, row.mode, ++generation);
    ReadCost cost;
    read_back(*store_, stored, row.frames, row.joints, &cost);
    EXPECT_EQ(cost.packets, row.packets) << to_string(row.mode) << " row " << generation;
  }
}

TEST_P(MotionDbTest, TheCostInBytesCoversTheFetchedRecords) {
  const Motion motion = test_motion(100, 6, 1, 1);  // two of the six joints are translated
  const StoredMotion stored = put_motion(*store_, motion, {AccessMode::Kind::by_frame, 10});
  ReadCost cost;
  read_back(*store_, stored, {15, 25}, {1}, &cost);
  EXPECT_EQ(cost.bytes, 2u * (32 + 10 * (6 * 16 + 2 * 12)));
  read_back(*store_, stored, {15, 25}, {}, &cost);
  EXPECT_EQ(cost.bytes, 2u * (32 + 10 * (6 * 16 + 2 * 12)) + (32 + 100 * 4)) << "plus the one record of tracks";
}

TEST_P(MotionDbTest, OtherJointsAreAtRestAndTracksAreOmitted) {
  const Motion motion = test_motion(20, 5, 1, 2);
  for (const AccessMode::Kind kind : kAllKinds) {
    const StoredMotion stored = put_motion(*store_, motion, {kind, 6}, static_cast<std::uint64_t>(kind));
    const Motion part = read_back(*store_, stored, {3, 9}, {1});
    EXPECT_TRUE(part.pose(0).rotations[1].coeffs() == motion.pose(3).rotations[1].coeffs());
    EXPECT_TRUE(part.pose(5).rotations[2].coeffs() == Eigen::Quaternionf::Identity().coeffs());
    EXPECT_EQ(part.pose(5).translations[0], motion.skeleton().joint(0).offset);
    EXPECT_EQ(part.skeleton().joint_count(), 5u);
    EXPECT_TRUE(part.tracks().empty());
  }
}

TEST_P(MotionDbTest, TheSkeletonIsCompleteAndShared) {
  const Motion motion = test_motion(3, 9);
  const StoredMotion stored = put_motion(*store_, motion, {});
  const auto snapshot = store_->read();
  const auto skeleton = read_skeleton(*snapshot, stored);
  EXPECT_EQ(*skeleton, motion.skeleton());
  EXPECT_EQ(read(*snapshot, stored, skeleton, {0, 1}).shared_skeleton(), skeleton);
}

TEST(MotionDb, DefaultPacketsFillPagesOfTheEngine) {
  for (const int joints : {1, 24, 53, 75, 200}) {
    const Motion motion = test_motion(1, joints);
    const StoredMotion by_frame = describe(motion, {AccessMode::Kind::by_frame, 0}, 1);
    const Width all =
        width_of(motion.skeleton(), Record{.kind = RecordKind::packet, .part = kAllJoints, .block = 0, .frames = {}});
    const std::size_t bytes = kHeaderSize + by_frame.mode.frames_per_packet * all.frame_bytes();
    EXPECT_LE(bytes, 8 * 4096u - 16) << joints;
    EXPECT_GT(bytes + all.frame_bytes(), 8 * 4096u - 16) << joints;
    const StoredMotion both = describe(motion, {AccessMode::Kind::by_joint_and_frame, 0}, 1);
    EXPECT_EQ(both.mode.frames_per_packet, joints == 1 ? 34u : 60u) << "a joint's packet has 984 or 992 bytes";
  }
  const Motion huge = test_motion(1, 3'000);
  EXPECT_EQ(describe(huge, {AccessMode::Kind::by_frame, 0}, 1).mode.frames_per_packet, 1u);
}

TEST(MotionDb, ReadingAHandInASignFetchesAtMostTwiceTheRequestedBytes) {
  const TestStore store;
  const Motion motion = test_motion(1'000, 20);
  const StoredMotion stored = put_motion(*store, motion, {AccessMode::Kind::by_joint_and_frame, 0});
  const JointSet turned = {1, 2, 4, 5, 7};
  for (const std::int64_t length : {65, 100, 150}) {
    double read = 0, requested = 0;
    for (std::int64_t begin = 0; begin + length <= 1'000; begin += 7) {
      ReadCost cost;
      read_back(*store, stored, {begin, begin + length}, turned, &cost);
      read += static_cast<double>(cost.bytes);
      requested += static_cast<double>(length) * static_cast<double>(turned.size()) * 16;
    }
    EXPECT_LE(read / requested, 2.0) << length << " frames";
  }
}

TEST(MotionDb, UnstorableMotionsAreRefusedWithAFix) {
  const auto refusal = [](const std::function<void()>& action) -> std::string {
    try {
      action();
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(refusal([] { describe(test_motion(0), {}, 1); }), HasSubstr("no frames"));
  EXPECT_THAT(refusal([] { describe(Motion(), {}, 1); }), HasSubstr("no frames"));
  const auto of_size = [](AccessMode mode, std::int64_t frames) {
    StoredMotion stored;
    stored.mode = mode;
    stored.frames = frames;
    stored.joints = 53;
    return stored;
  };
  EXPECT_THAT(refusal([&] {
                check_packet_size(of_size({AccessMode::Kind::full, 0}, 6'000'000));
              }),
              HasSubstr("a packet of full would have 4852 MiB, more than the limit of 4095; store it by_frame"));
  check_packet_size(of_size({AccessMode::Kind::by_joint, 0}, 6'000'000));
  check_packet_size(of_size({AccessMode::Kind::by_frame, 4'000'000'000u}, 1'000));
}

TEST_P(MotionDbTest, ARequestOutOfRangeNamesTheValidRange) {
  const Motion motion = test_motion(20, 5);
  const StoredMotion stored = put_motion(*store_, motion, {});
  for (const FrameRange frames : {FrameRange{-1, 3}, FrameRange{3, 21}, FrameRange{5, 3}}) {
    try {
      read_back(*store_, stored, frames);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_input);
      EXPECT_THAT(error.what(), HasSubstr("[0, 20)"));
    }
  }
  for (const JointSet& joints : {JointSet{-1}, JointSet{5}, JointSet{2, 2}, JointSet{3, 1}}) {
    EXPECT_THROW(read_back(*store_, stored, {0, 1}, joints), Error);
  }
  const auto other = std::make_shared<const Skeleton>(test_motion(1, 4).skeleton());
  EXPECT_THROW(read(*store_->read(), stored, other, {0, 1}), Error);
}

TEST_P(MotionDbTest, ProgressRisesToOne) {
  const Motion motion = test_motion(2'000, 3);
  std::vector<double> seen;
  put(*store_, describe(motion, {AccessMode::Kind::by_frame, 1}, 1), motion,
      [&](double fraction) { seen.push_back(fraction); });
  ASSERT_GE(seen.size(), 4u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GT(seen.front(), 0.0);
  EXPECT_EQ(seen.back(), 1.0);
}

/// Forwards everything and counts the size of each transaction.
class CountingStore final : public kv::KvStore {
 public:
  explicit CountingStore(kv::KvStore& store) : store_(store) {}
  std::unique_ptr<kv::ReadTransaction> read() const override { return store_.read(); }
  kv::EngineInfo info() const override { return store_.info(); }
  void visit(const std::function<void(ByteSpan, std::size_t)>& see) const override { store_.visit(see); }
  std::size_t longest_key() const noexcept override { return store_.longest_key(); }
  std::unique_ptr<kv::WriteTransaction> write() override;

  std::size_t most_changes = 0;
  std::size_t most_bytes = 0;
  bool writing = false;

 private:
  kv::KvStore& store_;
};

class CountingWrite final : public kv::WriteTransaction {
 public:
  CountingWrite(CountingStore& counts, std::unique_ptr<kv::WriteTransaction> inner)
      : counts_(counts), inner_(std::move(inner)) {
    counts_.writing = true;
  }
  ~CountingWrite() override { counts_.writing = false; }
  std::optional<ByteSpan> get(ByteSpan key) const override { return inner_->get(key); }
  std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const override { return inner_->get(key, buffer); }
  void put(ByteSpan key, ByteSpan value) override {
    inner_->put(key, value);
    count(value.size());
  }
  bool erase(ByteSpan key) override {
    count(0);
    return inner_->erase(key);
  }
  void commit() override { inner_->commit(); }

 private:
  void count(std::size_t bytes) {
    counts_.most_changes = std::max(counts_.most_changes, ++changes_);
    counts_.most_bytes = std::max(counts_.most_bytes, bytes_ += bytes);
  }
  CountingStore& counts_;
  std::unique_ptr<kv::WriteTransaction> inner_;
  std::size_t changes_ = 0;
  std::size_t bytes_ = 0;
};

std::unique_ptr<kv::WriteTransaction> CountingStore::write() {
  return std::make_unique<CountingWrite>(*this, store_.write());
}

TEST_P(MotionDbTest, TransactionsAreBoundedAndNoneIsOpenDuringProgress) {
  CountingStore counting(*store_);
  const Motion many = test_motion(1'200, 4, 1, 1);
  const StoredMotion stored = describe(many, {AccessMode::Kind::by_joint_and_frame, 1}, 1);
  put(counting, stored, many, [&](double) { EXPECT_FALSE(counting.writing); });
  EXPECT_EQ(counting.most_changes, 512u);
  counting.most_changes = 0;
  erase(counting, stored);
  EXPECT_EQ(counting.most_changes, 512u);

  const Motion large = test_motion(12'000, 100);  // 24 MB
  put(counting, describe(large, {AccessMode::Kind::by_frame, 1'000}, 2), large);
  EXPECT_LE(counting.most_bytes, std::size_t{16 + 2} << 20) << "16 MiB, plus the packet that exceeds it";
}

}  // namespace
}  // namespace signweave::motion_db
