#include "signweave/drawing/body_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "signweave/drawing/body_mesh.h"
#include "signweave/drawing/face_mesh.h"
#include "signweave/drawing/test_person.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Vector3f;
using testing::ElementsAre;
using testing::IsEmpty;

JointIndex named(const Skeleton& skeleton, std::string_view name) {
  return *skeleton.find(name);
}

/// The skeleton with other names that give no information.
std::shared_ptr<const Skeleton> nameless(const Skeleton& skeleton) {
  std::vector<Joint> joints(skeleton.joints().begin(), skeleton.joints().end());
  for (Joint& joint : joints) joint.name = "j";
  return std::make_shared<const Skeleton>(std::move(joints),
                                          std::vector<Tip>(skeleton.tips().begin(), skeleton.tips().end()));
}

TEST(BodyPlan, FindsTrunkHeadAndHandsWithoutNames) {
  const auto skeleton = person();
  const BodyPlan plan = plan_of(Motion(nameless(*skeleton), {100, 1}, 1));
  EXPECT_THAT(plan.trunk, ElementsAre(0, 1, 2));
  EXPECT_EQ(plan.neck, named(*skeleton, "Neck"));
  ASSERT_TRUE(plan.head);
  EXPECT_EQ(plan.head->joint, named(*skeleton, "Head"));
  ASSERT_EQ(plan.hands.size(), 2u);
  EXPECT_EQ(plan.hands[0].joint, named(*skeleton, "LeftHand"));
  EXPECT_EQ(plan.hands[0].knuckles.size(), 4u);
  EXPECT_THAT(plan.collars,
              testing::UnorderedElementsAre(named(*skeleton, "LeftShoulder"), named(*skeleton, "RightShoulder")));
  EXPECT_NEAR(plan.shoulder_width, 0.18f, 1e-4f);
  EXPECT_NEAR(plan.hip_width, 0.09f, 1e-4f);
  EXPECT_NEAR(plan.size, 1.7f, 0.2f);
}

TEST(BodyPlan, FindsTheLeftSideByTheToesWhereverTheBodyIs) {
  Motion motion(person(), {100, 1}, 1);
  for (const float degrees : {0.0f, 90.0f, 200.0f}) {
    const Eigen::Quaternionf turn(AngleAxisf(degrees * std::numbers::pi_v<float> / 180, Vector3f::UnitY()));
    motion.pose(0).rotations[0] = turn;
    const BodyPlan plan = plan_of(motion);
    EXPECT_LT((plan.left - turn * Vector3f::UnitX()).norm(), 0.05f) << degrees;
    EXPECT_LT((plan.forward - turn * Vector3f::UnitZ()).norm(), 0.05f) << degrees;
    EXPECT_LT((plan.head->forward - turn * Vector3f::UnitZ()).norm(), 0.05f) << degrees;
  }
}

TEST(BodyPlan, IsThatOfAPoseBecauseARestPoseMayBeUnnatural) {
  // Both arms point forward at rest; only the turned collar bones spread them.
  const auto straight = person();
  std::vector<Joint> joints(straight->joints().begin(), straight->joints().end());
  const JointIndex collars[] = {named(*straight, "LeftShoulder"), named(*straight, "RightShoulder")};
  Motion posed(straight, {100, 1}, 1);
  for (const JointIndex collar : collars) {
    const float side = joints[static_cast<std::size_t>(collar)].offset.x() > 0 ? 1.0f : -1.0f;
    const Eigen::Quaternionf turn(AngleAxisf(side * std::numbers::pi_v<float> / 2, Vector3f::UnitY()));
    posed.pose(0).rotations[static_cast<std::size_t>(collar)] = turn;
    for (Joint& joint : joints) {
      for (JointIndex above = joint.parent; above != kNoJoint; above = straight->joint(above).parent) {
        if (above == collar) joint.offset = turn.conjugate() * joint.offset;
      }
    }
  }
  Motion motion(std::make_shared<const Skeleton>(joints, std::vector<Tip>()), {100, 1}, 1);
  for (std::size_t i = 0; i < joints.size(); ++i) motion.pose(0).rotations[i] = posed.pose(0).rotations[i];
  EXPECT_NEAR(plan_of(motion).shoulder_width, 0.18f, 1e-3f);
}

TEST(BodyPlan, JointsAboveTheHipsInTheTreeAreNotPartOfTheBody) {
  const auto skeleton = person();
  std::vector<Joint> joints = {{"Scene", kNoJoint, {0, 0, 0}, true}};
  for (Joint joint : skeleton->joints()) {
    ++joint.parent;
    joints.push_back(std::move(joint));
  }
  const Motion motion(std::make_shared<const Skeleton>(joints, std::vector<Tip>()), {100, 1}, 1);
  EXPECT_THAT(plan_of(motion).trunk, ElementsAre(1, 2, 3));
  const BodyPlan plan = plan_of(motion);
  for (const JointIndex joint : body_mesh(motion.skeleton(), plan).joints) EXPECT_NE(joint, 0);
}

TEST(BodyPlan, ASnakeIsNotABody) {
  std::vector<Joint> joints = {{"Tail", kNoJoint, {0, 0, 0}, true}};
  for (int i = 0; i < 6; ++i) joints.push_back({"Bone", i, {0.2f, 0, 0}, false});
  const Motion motion(std::make_shared<const Skeleton>(joints, std::vector<Tip>()), {100, 1}, 1);
  const BodyPlan plan = plan_of(motion);
  EXPECT_THAT(plan.trunk, IsEmpty());
  EXPECT_FALSE(plan.head);
  EXPECT_THAT(plan.hands, IsEmpty());
  EXPECT_FALSE(body_mesh(motion.skeleton(), plan).positions.empty());
}

/// For each vertex the number of the solid that it belongs to.
std::vector<std::size_t> solids_of(const BodyMesh& mesh) {
  std::vector<std::size_t> solid(mesh.positions.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
      std::size_t& one = solid[mesh.indices[i]];
      const std::size_t other = solid[mesh.indices[i - i % 3]];
      if (one == other) continue;
      solid[mesh.indices[i - i % 3]] = one = std::min(one, other);
      changed = true;
    }
  }
  return solid;
}

TEST(BodyMesh, TrianglesFaceOutwards) {
  const Motion motion = moving_person(3);
  const BodyMesh mesh = body_mesh(motion.skeleton(), plan_of(motion));
  const std::vector<std::size_t> solid = solids_of(mesh);
  std::map<std::size_t, double> volumes;  // positive for a solid whose triangles face outwards; 0 for a lid
  double whole = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::size_t first = solid[mesh.indices[i]];
    const Vector3f& from = mesh.positions[first];
    const Vector3f a = mesh.positions[mesh.indices[i]] - from;
    const Vector3f b = mesh.positions[mesh.indices[i + 1]] - from;
    const Vector3f c = mesh.positions[mesh.indices[i + 2]] - from;
    volumes[first] += a.cross(b).dot(c) / 6;
    whole += a.cross(b).dot(c) / 6;
    EXPECT_GT((b - a).cross(c - a).dot(mesh.normals[mesh.indices[i]]), 0) << "triangle " << i / 3;
  }
  EXPECT_GT(volumes.size(), 30u);
  for (const auto& [first, volume] : volumes) EXPECT_GT(volume, -1e-9) << "the solid of joint " << mesh.joints[first];
  EXPECT_GT(whole, 0.02) << "cubic metres";
  EXPECT_LT(whole, 0.2);
  for (const Vector3f& normal : mesh.normals) EXPECT_NEAR(normal.norm(), 1, 1e-5f);
}

TEST(BodyMesh, HandsArePalmsWithFingers) {
  const Motion motion(person(), {100, 1}, 1);
  const BodyPlan plan = plan_of(motion);
  const BodyMesh mesh = body_mesh(motion.skeleton(), plan);
  const JointIndex hand = plan.hands[0].joint;
  Vector3f low = plan.place(hand);
  Vector3f high = low;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.joints[i] != hand) continue;
    low = low.cwiseMin(mesh.positions[i]);
    high = high.cwiseMax(mesh.positions[i]);
  }
  const Vector3f extent = high - low;
  EXPECT_NEAR(extent.x(), 0.12f, 0.03f) << "from the wrist to the knuckles";
  EXPECT_NEAR(extent.z(), 0.08f, 0.03f) << "across";
  EXPECT_LT(extent.y(), 0.035f) << "flat";
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.joints[i] != hand) continue;
    EXPECT_GT(mesh.normals[i].dot(mesh.positions[i] - (low + high) / 2), 0) << "looks out of the palm";
  }
}

TEST(BodyMesh, TheSkullIsDeeperThanWideAndHigherThanDeep) {
  const Motion motion(person(), {100, 1}, 1);
  const BodyPlan plan = plan_of(motion);
  const BodyMesh mesh = body_mesh(motion.skeleton(), plan);
  Vector3f extent(0, 0, 0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.joints[i] != plan.head->joint) continue;
    const Vector3f from = mesh.positions[i] - plan.head->centre;
    if (from.z() < 0) extent = extent.cwiseMax(from.cwiseAbs());  // the back, where there is no nose
  }
  EXPECT_NEAR(extent.x(), plan.head->half.x(), 0.15f * plan.head->half.x());
  EXPECT_NEAR(extent.z(), plan.head->half.z(), 0.15f * plan.head->half.z());
  EXPECT_NEAR(extent.y(), plan.head->half.y(), 0.15f * plan.head->half.y());
  EXPECT_LT(extent.x(), extent.z());
}

TEST(BodyMesh, TheNoseIsAttachedToTheHead) {
  const Motion motion(person(), {100, 1}, 1);
  const BodyPlan plan = plan_of(motion);
  const HeadShape& head = *plan.head;
  const BodyMesh mesh = body_mesh(motion.skeleton(), plan);
  // The nose comes last: four rings of ten between two ends.
  ASSERT_GT(mesh.positions.size(), 42u);
  const std::size_t nose = mesh.positions.size() - 42;
  const auto depth = [&](std::size_t vertex) {  // 1 at the skull's surface
    const Vector3f from = mesh.positions[vertex] - head.centre;
    const float height = from.dot(head.up) / head.half.y();
    const float round = std::sqrt(1 - height * height) * (0.88f + 0.12f * height);
    return from.dot(head.forward) / (round * head.half.z());
  };
  for (std::size_t ring = 0; ring < 4; ++ring) {
    float deepest = 2;
    for (std::size_t i = 0; i < 10; ++i) deepest = std::min(deepest, depth(nose + 1 + 10 * ring + i));
    EXPECT_LT(deepest, 0.97f) << ring;
  }
  float tip = 0;
  for (std::size_t i = nose; i < mesh.positions.size(); ++i) tip = std::max(tip, depth(i));
  EXPECT_GT(tip, 1.1f);
  EXPECT_LT(tip, 1.35f);
}

TEST(BodyPlan, AHeadIsUprightIfItsEndPointsSideways) {
  const auto straight = person();
  for (const Vector3f& aside : {Vector3f(0.2f, 0.03f, 0), Vector3f(0, 0.18f, 0.08f)}) {
    std::vector<Tip> tips(straight->tips().begin(), straight->tips().end());
    tips[0].offset = aside;
    std::vector<Joint> joints(straight->joints().begin(), straight->joints().end());
    const Motion motion(std::make_shared<const Skeleton>(joints, tips), {100, 1}, 1);
    const Vector3f up = plan_of(motion).head->up;
    // A nodding head keeps its direction.
    EXPECT_LT((up - (aside.x() > 0 ? Vector3f(Vector3f::UnitY()) : Vector3f(aside.normalized()))).norm(), 0.1f);
  }
}

TEST(BodyPlan, ARootOnTheGroundIsNotPartOfTheTrunkEvenWithoutLegs) {
  std::vector<Joint> joints = {{"Scene", kNoJoint, {0, 0, 0}, true}};
  std::vector<Tip> tips;
  const auto skeleton = person();
  for (Joint joint : skeleton->joints()) {
    if (joint.name.find("Leg") != std::string::npos || joint.name.find("Foot") != std::string::npos) continue;
    ++joint.parent;
    joints.push_back(std::move(joint));
  }
  const Motion motion(std::make_shared<const Skeleton>(joints, tips), {100, 1}, 1);
  EXPECT_THAT(plan_of(motion).trunk, ElementsAre(1, 2, 3));
}

TEST(FaceMesh, LiesOnTheFrontOfTheHead) {
  const HeadShape head = *plan_of(Motion(person(), {100, 1}, 1)).head;
  const FaceMesh face = face_mesh(head, {});
  EXPECT_TRUE(face.targets.empty());
  for (const Vector3f& position : face.positions) {
    const Vector3f from = position - head.centre;
    EXPECT_GT(from.dot(head.forward), 0.2f * head.half.z());
    EXPECT_LT(std::abs(from.dot(head.left)), head.half.x());
    EXPECT_LT(std::abs(from.dot(head.up)), head.half.y());
  }
  for (std::size_t i = 0; i < face.indices.size(); i += 3) {
    const Vector3f& a = face.positions[face.indices[i]];
    const Vector3f normal = (face.positions[face.indices[i + 1]] - a).cross(face.positions[face.indices[i + 2]] - a);
    EXPECT_GT(normal.dot(head.forward), 0) << "triangle " << i / 3;
  }
}

TEST(FaceMesh, EveryTargetMovesSomethingAndTheSidedOnesTheirSideOnly) {
  const HeadShape head = *plan_of(Motion(person(), {100, 1}, 1)).head;
  const auto names = face_target_names();
  const FaceMesh face = face_mesh(head, {names.begin(), names.end()});
  ASSERT_EQ(face.targets.size(), names.size());
  for (const FaceTarget& target : face.targets) {
    ASSERT_EQ(target.deltas.size(), face.positions.size());
    float left = 0;
    float right = 0;
    for (std::size_t i = 0; i < face.positions.size(); ++i) {
      const bool is_left = (face.positions[i] - head.centre).dot(head.left) > 0;
      (is_left ? left : right) += target.deltas[i].norm();
    }
    const bool jaw = target.name.starts_with("jaw");  // moves sideways as a whole
    EXPECT_EQ(left > 1e-4f, jaw || !target.name.ends_with("Right")) << target.name;
    EXPECT_EQ(right > 1e-4f, jaw || !target.name.ends_with("Left")) << target.name;
  }
}

TEST(FaceMesh, ABlinkClosesTheEyeAndAnOpenJawLowersTheLip) {
  const HeadShape head = *plan_of(Motion(person(), {100, 1}, 1)).head;
  const FaceMesh face = face_mesh(head, {"eyeBlinkLeft", "jawOpen", "mouthPucker", "browInnerUp"});
  const auto extent = [&](const FaceTarget& target, const Vector3f& direction, float weight) {
    float low = 1e9f;
    float high = -1e9f;
    for (std::size_t i = 0; i < face.positions.size(); ++i) {
      if (target.deltas[i].norm() < 1e-5f) continue;  // the part that the target moves
      const float at = (face.positions[i] + weight * target.deltas[i]).dot(direction);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    return high - low;
  };
  EXPECT_LT(extent(face.targets[0], head.up, 1), 0.15f * extent(face.targets[0], head.up, 0));
  EXPECT_GT(extent(face.targets[1], head.up, 1), 2 * extent(face.targets[1], head.up, 0));
  EXPECT_LT(extent(face.targets[2], head.left, 1), 0.6f * extent(face.targets[2], head.left, 0));
  for (const Vector3f& delta : face.targets[3].deltas) EXPECT_GE(delta.dot(head.up), 0);
}

}  // namespace
}  // namespace signweave
