// Each defect is added to a clean motion, at a known joint and frame, and nothing else may be found.

#include "signweave/features/defects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <numbers>

#include "demo/corpus.h"
#include "signweave/features/test_defect_rig.h"

namespace signweave {
namespace {

using testing::HasSubstr;

constexpr FrameRate kRate{100, 1};

const Motion& clean() {
  static const Motion motion = [] {
    demo::Script script = demo::meteo();
    script.units.resize(3);
    return demo::make_recording(script, kRate, 1).motion;
  }();
  return motion;
}

std::size_t joint(const char* name) {
  return static_cast<std::size_t>(clean().skeleton().find(name).value());
}

std::vector<Defect> defects_of(const Motion& motion) {
  return find_defects(motion, rig_by_hand(motion.skeleton()));
}

/// The only defect, which must exist.
Defect only(const Motion& motion) {
  const std::vector<Defect> found = defects_of(motion);
  std::string texts;
  for (const Defect& defect : found) texts += defect.text + '\n';
  EXPECT_EQ(found.size(), 1u) << texts;
  return found.empty() ? Defect{} : found.front();
}

Eigen::Quaternionf turn(float degrees, const Eigen::Vector3f& axis) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis.normalized()));
}

TEST(Defects, TheDemoCorpusHasNone) {
  for (const demo::Script& script : demo::corpus_scripts(44)) {
    const Motion motion = demo::make_recording(script, kRate, 1).motion;
    for (const Defect& defect : defects_of(motion)) ADD_FAILURE() << script.name << ": " << defect.text;
  }
}

TEST(Defects, ATPoseAtTheStart) {
  Motion motion = clean();
  for (std::int64_t frame = 0; frame < 12; ++frame) {
    for (Eigen::Quaternionf& rotation : motion.pose(frame).rotations) rotation.setIdentity();
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::t_pose);
  EXPECT_EQ(defect.joint, kNoJoint);
  EXPECT_EQ(defect.frames, (FrameRange{0, 12}));
}

TEST(Defects, ATPoseInTheMiddleMustBeHeld) {
  Motion motion = clean();
  for (std::int64_t frame = 800; frame < 860; ++frame) {
    for (Eigen::Quaternionf& rotation : motion.pose(frame).rotations) rotation.setIdentity();
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::t_pose);
  EXPECT_EQ(defect.frames, (FrameRange{800, 860}));
}

TEST(Defects, AJointThatFreezes) {
  Motion motion = clean();
  const std::size_t elbow = joint("RightForeArm");
  for (std::int64_t frame = 701; frame < 850; ++frame) {
    motion.pose(frame).rotations[elbow] = motion.pose(700).rotations[elbow];
  }
  for (std::int64_t frame = 850; frame < 880; ++frame) {  // back without a jump
    const Eigen::Quaternionf held = motion.pose(700).rotations[elbow];
    motion.pose(frame).rotations[elbow] =
        held.slerp(static_cast<float>(frame - 849) / 31.0f, motion.pose(frame).rotations[elbow]);
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::frozen_joint);
  EXPECT_EQ(defect.joint, static_cast<JointIndex>(elbow));
  EXPECT_EQ(defect.frames, (FrameRange{700, 850}));
}

TEST(Defects, PartsThatNeverMoveAreOneLine) {
  Motion motion = clean();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (const char* name : {"LeftHand", "Head"}) motion.pose(frame).rotations[joint(name)].setIdentity();
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::frozen_joint);
  EXPECT_EQ(defect.joint, kNoJoint);
  EXPECT_THAT(defect.text, HasSubstr("Head and LeftHand never move"));
}

TEST(Defects, AHandThatJumpsAndStays) {
  Motion motion = clean();
  const std::size_t wrist = joint("LeftHand");
  for (std::int64_t frame = 500; frame < motion.frame_count(); ++frame) {
    motion.pose(frame).rotations[wrist] = motion.pose(frame).rotations[wrist] * turn(60, {0, 1, 1});
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::jump);
  EXPECT_EQ(defect.joint, static_cast<JointIndex>(wrist));
  EXPECT_EQ(defect.frames, (FrameRange{500, 501}));
  EXPECT_NEAR(defect.value, 104.7, 15);
}

TEST(Defects, AnArmDisplacedForOneFrame) {
  Motion motion = clean();
  const std::size_t shoulder = joint("RightArm");
  // 15°: not a fast rotation of a joint, but the hand moves there and back at 15 m/s.
  motion.pose(600).rotations[shoulder] = motion.pose(600).rotations[shoulder] * turn(16, {0, 1, 0});
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::jump);
  EXPECT_EQ(defect.joint, static_cast<JointIndex>(shoulder));
  EXPECT_EQ(defect.frames, (FrameRange{600, 601}));
}

TEST(Defects, ADisplacedRoot) {
  Motion motion = clean();
  for (std::int64_t frame = 400; frame < motion.frame_count(); ++frame) {
    motion.pose(frame).translations[0] += Eigen::Vector3f(0.1f, 0, 0.1f);
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::jump);
  EXPECT_EQ(defect.joint, 0);
  EXPECT_EQ(defect.frames, (FrameRange{400, 401}));
  EXPECT_NEAR(defect.value, 14.1, 0.5);
}

TEST(Defects, ACutIsReportedOnce) {
  Motion motion = clean().slice({0, 600});
  for (std::int64_t frame = 0; frame < 300; ++frame) {
    for (Eigen::Quaternionf& rotation : motion.pose(frame).rotations) rotation = rotation * turn(50, {1, 2, 3});
  }
  std::size_t jumps = 0;
  for (const Defect& defect : defects_of(motion)) {
    if (defect.kind != DefectKind::jump) continue;
    ++jumps;
    EXPECT_EQ(defect.joint, kNoJoint);
    EXPECT_EQ(defect.frames, (FrameRange{300, 301}));
    EXPECT_THAT(defect.text, HasSubstr("joints jump at once"));
  }
  EXPECT_EQ(jumps, 1u);
}

TEST(Defects, AQuaternionThatFlips) {
  Motion motion = clean();
  const std::size_t elbow = joint("LeftForeArm");
  for (std::int64_t frame = 250; frame < motion.frame_count(); ++frame) {
    motion.pose(frame).rotations[elbow].coeffs() *= -1.0f;
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::quaternion_flip);
  EXPECT_EQ(defect.joint, static_cast<JointIndex>(elbow));
  EXPECT_EQ(defect.frames, (FrameRange{250, 251}));
}

TEST(Defects, ARootWhoseColumnsArePermuted) {
  // The result of reading columns that hold a rotation where a position is declared, and the OFFSET where a rotation
  // is.
  Motion motion = clean();
  const Eigen::Vector3f offset = motion.skeleton().joint(0).offset;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    motion.pose(frame).rotations[0] = turn(offset.norm() * 100, offset);
    motion.pose(frame).translations[0] = 0.01f * Eigen::Vector3f(static_cast<float>(frame % 7), 15, 1);
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::permuted_root);
  EXPECT_EQ(defect.joint, 0);
}

TEST(Defects, ABodyInAnotherUnit) {
  std::vector<Joint> joints(clean().skeleton().joints().begin(), clean().skeleton().joints().end());
  std::vector<Tip> tips(clean().skeleton().tips().begin(), clean().skeleton().tips().end());
  for (Joint& one : joints) one.offset *= 2.54f;
  for (Tip& tip : tips) tip.offset *= 2.54f;
  Motion motion(std::make_shared<const Skeleton>(joints, tips), kRate);
  for (std::int64_t frame = 0; frame < clean().frame_count(); ++frame) motion.append(clean().pose(frame));
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::scale);
  EXPECT_NEAR(defect.value, 2.54 * 1.68, 0.2);
  EXPECT_TRUE(find_defects(motion, RigMap()).empty());  // without a rig its height is unknown
}

TEST(Defects, NonFiniteNumbers) {
  Motion motion = clean();
  const std::size_t elbow = joint("LeftForeArm");
  for (std::int64_t frame = 333; frame < 337; ++frame) {
    motion.pose(frame).rotations[elbow].x() = std::numeric_limits<float>::quiet_NaN();
  }
  const Defect defect = only(motion);
  EXPECT_EQ(defect.kind, DefectKind::not_finite);
  EXPECT_EQ(defect.joint, static_cast<JointIndex>(elbow));
  EXPECT_EQ(defect.frames, (FrameRange{333, 337}));
}

TEST(Defects, ManyOfOneKindAreCounted) {
  Motion motion = clean();
  const std::size_t elbow = joint("LeftForeArm");
  for (std::int64_t frame = 100; frame < 200; frame += 2) motion.pose(frame).rotations[elbow].coeffs() *= -1.0f;
  const std::vector<Defect> found = defects_of(motion);
  ASSERT_EQ(found.size(), kMostDefects);
  EXPECT_THAT(found.back().text, HasSubstr("50 more of this kind"));
}

TEST(Defects, AMotionOfOneFrameOrNoneHasNone) {
  EXPECT_TRUE(defects_of(clean().slice({0, 1})).empty());
  EXPECT_TRUE(defects_of(clean().slice({0, 0})).empty());
  EXPECT_TRUE(defects_of(clean().slice({0, 2})).empty());
}

TEST(Defects, AreFoundFarFasterThanTheMotionRuns) {
  Seconds taken(1e9);
  for (int run = 0; run < 5; ++run) {  // the best of several runs: other processes use the machine as well
    const auto start = std::chrono::steady_clock::now();
    defects_of(clean());
    taken = std::min<Seconds>(taken, std::chrono::steady_clock::now() - start);
  }
  RecordProperty("times_real_time", static_cast<int>(clean().duration() / taken));
#ifdef NDEBUG
  EXPECT_GT(clean().duration() / taken, 500.0);
#else  // unoptimised, or with sanitizers
  EXPECT_GT(clean().duration() / taken, 20.0);
#endif
}

}  // namespace
}  // namespace signweave
