#pragma once

#include <random>

#include "signweave/kv/kv_store.h"
#include "signweave/kv/test_folder.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/motion_db.h"

namespace signweave::motion_db {

/// For tests: a motion whose numbers all differ, with values that a careless copy would change.
inline Motion test_motion(std::int64_t frames, int joints = 5, unsigned seed = 1, int tracks = 0) {
  std::vector<Joint> list;
  for (int i = 0; i < joints; ++i) {
    list.push_back({.name = "Joint " + std::to_string(i),
                    .parent = i == 0 ? kNoJoint : (i - 1) / 2,
                    .offset = Eigen::Vector3f(0.1f, 0.2f, static_cast<float>(i)),
                    .translated = i % 3 == 0});
  }
  auto skeleton = std::make_shared<const Skeleton>(
      std::move(list), std::vector<Tip>{{.joint = joints - 1, .offset = Eigen::Vector3f(0, 1, 0)}});
  Motion motion(std::move(skeleton), FrameRate{30'000, 1'001}, frames);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-2.0f, 2.0f);
  constexpr float kOdd[] = {-0.0f, 1e-40f, 3.4e38f};
  const auto next = [&] { return random() % 16 == 0 ? kOdd[random() % 3] : number(random); };
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    for (Eigen::Quaternionf& rotation : motion.pose(frame).rotations) {
      for (float& value : rotation.coeffs()) value = next();
    }
    for (Eigen::Vector3f& translation : motion.pose(frame).translations) {
      for (float& value : translation) value = next();
    }
  }
  for (int i = 0; i < tracks; ++i) {
    ScalarTrack track{.name = "face " + std::to_string(i), .values = {}};
    for (std::int64_t frame = 0; frame < frames; ++frame) track.values.push_back(next());
    motion.add_track(std::move(track));
  }
  return motion;
}

/// The expected result of `read`, taken from the motion in memory.
inline Motion expected(const Motion& motion, FrameRange frames, const JointSet& joints) {
  if (joints.empty()) return motion.slice(frames);
  Motion part(motion.shared_skeleton(), motion.rate(), frames.size());
  for (std::int64_t frame = 0; frame < frames.size(); ++frame) {
    for (const JointIndex joint : joints) {
      const auto at = static_cast<std::size_t>(joint);
      part.pose(frame).rotations[at] = motion.pose(frames.begin + frame).rotations[at];
      if (const auto moved = motion.skeleton().translation_of(joint)) {
        part.pose(frame).translations[*moved] = motion.pose(frames.begin + frame).translations[*moved];
      }
    }
  }
  return part;
}

inline constexpr AccessMode::Kind kAllKinds[] = {AccessMode::Kind::full, AccessMode::Kind::by_frame,
                                                 AccessMode::Kind::by_joint, AccessMode::Kind::by_joint_and_frame};

/// A store in its own temporary folder.
struct TestStore {
  explicit TestStore(const std::string& engine = kv::engines().front()) {
    kv::create(folder.path() / "db", engine);
    store = kv::open(folder.path() / "db", kv::Access::read_write);
  }
  kv::KvStore& operator*() const { return *store; }
  kv::KvStore* operator->() const { return store.get(); }

  kv::TestFolder folder;
  std::unique_ptr<kv::KvStore> store;
};

inline StoredMotion put_motion(kv::KvStore& store, const Motion& motion, AccessMode mode,
                               std::uint64_t generation = 1) {
  StoredMotion stored = describe(motion, mode, generation);
  put(store, stored, motion);
  return stored;
}

/// Reads some frames in a transaction of its own.
inline Motion read_back(const kv::KvStore& store, const StoredMotion& stored, FrameRange frames,
                        const JointSet& joints = {}, ReadCost* cost = nullptr) {
  const auto snapshot = store.read();
  return read(*snapshot, stored, read_skeleton(*snapshot, stored), frames, joints, cost);
}

}  // namespace signweave::motion_db
