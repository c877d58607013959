// Properties of every recording of the synthetic signer: body, motion, and ground truth.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "demo/channels.h"
#include "demo/corpus.h"
#include "demo/test_rate.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// The paper's two, two others, which use the rest of the sign table, and those in channels.
const SyntheticRecording& recording(const std::string& name) {
  static const std::map<std::string, SyntheticRecording> made = [] {
    std::map<std::string, SyntheticRecording> recordings;
    std::vector<Script> scripts = corpus_scripts(12);
    for (Script& script : scripts) {
      if (script.name == "semaine-03" || script.name == "saisons-04") {
        script.units.resize(7);  // about a minute
      } else if (script.name != "meteo" && script.name != "villes") {
        continue;
      }
      recordings.emplace(script.name, make_recording(script, kRate, 1));
    }
    recordings.emplace("mains", make_channels(mains(), kRate, 1));
    recordings.emplace("visage", make_channels(visage(), kRate, 1));
    return recordings;
  }();
  return made.at(name);
}

HandAngles hand_angles(const Motion& motion, const Signer& signer, Side side, std::int64_t frame) {
  FingerRotations rotations;
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    for (std::size_t i = 0; i < kPhalanges; ++i) {
      rotations[finger][i] =
          motion.pose(frame).rotations[static_cast<std::size_t>(signer.side(side).fingers[finger][i])];
    }
  }
  return angles_in(rotations, side);
}

class EveryRecording : public testing::TestWithParam<const char*> {
 protected:
  const SyntheticRecording& made() const { return recording(GetParam()); }
  /// Whether both hands are in one lane.
  bool in_one_lane() const { return made().name != "mains" && made().name != "visage"; }
};
INSTANTIATE_TEST_SUITE_P(Demo, EveryRecording,
                         testing::Values("meteo", "villes", "semaine-03", "saisons-04", "mains", "visage"),
                         [](const auto& row) { return std::string(row.param).substr(0, 7); });

bool same(const Motion& a, const Motion& b) {
  const auto rotations =
      std::equal(a.rotations().begin(), a.rotations().end(), b.rotations().begin(), b.rotations().end(),
                 [](const Quaternionf& p, const Quaternionf& q) { return p.coeffs() == q.coeffs(); });
  return rotations && a.tracks() == b.tracks() &&
         std::equal(a.translations().begin(), a.translations().end(), b.translations().begin(), b.translations().end());
}

TEST(SyntheticSigner, HasAFullBodyWithHandsOfFifteenJoints) {
  const Signer signer = make_signer();
  EXPECT_GE(signer.skeleton->joint_count(), 55U);
  std::set<std::string> names;
  for (const Joint& joint : signer.skeleton->joints()) names.insert(joint.name);
  EXPECT_EQ(names.size(), signer.skeleton->joint_count());
  for (const char* side : {"Left", "Right"}) {
    for (const char* finger : {"Thumb", "Index", "Middle", "Ring", "Pinky"}) {
      for (const char* phalanx : {"1", "2", "3"}) {
        EXPECT_TRUE(names.contains(std::string(side) + "Hand" + finger + phalanx)) << side << finger << phalanx;
      }
    }
    for (const char* part : {"Shoulder", "Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot", "ToeBase"}) {
      EXPECT_TRUE(names.contains(std::string(side) + part)) << side << part;
    }
  }
}

TEST(SyntheticSigner, EveryChainEndsInATip) {
  const Signer signer = make_signer();
  std::set<JointIndex> parents;
  for (const Joint& joint : signer.skeleton->joints()) parents.insert(joint.parent);
  std::set<JointIndex> tipped;
  for (const Tip& tip : signer.skeleton->tips()) tipped.insert(tip.joint);
  for (JointIndex joint = 0; joint < static_cast<JointIndex>(signer.skeleton->joint_count()); ++joint) {
    EXPECT_TRUE(parents.contains(joint) || tipped.contains(joint)) << signer.skeleton->joint(joint).name;
  }
}

TEST(SyntheticSigner, IsOneMetreSeventyAndMirroredWithTheLeftAtPlusX) {
  const Signer signer = make_signer();
  const ModelPose rest = to_model_space(*signer.skeleton, Motion(signer.skeleton, kRate, 1).pose(0));
  float top = 0;
  for (const Tip& tip : signer.skeleton->tips()) top = std::max(top, position_of(tip, rest).y());
  EXPECT_NEAR(top, 1.70f, 0.005f);
  for (const Joint& joint : signer.skeleton->joints()) {
    if (!joint.name.starts_with("Left")) continue;
    const auto at = [&](const std::string& name) {
      return rest.positions[static_cast<std::size_t>(signer.skeleton->find(name).value())];
    };
    const Vector3f left = at(joint.name);
    const Vector3f right = at("Right" + joint.name.substr(4));
    EXPECT_GT(left.x(), 0) << joint.name;
    EXPECT_TRUE(right.isApprox(Vector3f(-left.x(), left.y(), left.z()), 1e-5f)) << joint.name;
  }
}

TEST_P(EveryRecording, IsTheSameForTheSameSeedAndNotForAnother) {
  if (made().name != "meteo" && made().name != "villes") return;  // generated from a part of its script
  const Script script = made().name == "meteo" ? meteo() : villes();
  const SyntheticRecording again = make_recording(script, kRate, 1);
  EXPECT_TRUE(same(made().motion, again.motion));
  EXPECT_EQ(made().document, again.document);
  EXPECT_EQ(made().truth, again.truth);
  const SyntheticRecording other = make_recording(script, kRate, 2);
  EXPECT_FALSE(same(made().motion, other.motion));
  EXPECT_NE(made().truth, other.truth);
}

TEST(OtherRates, GiveTheSameSigningAtOtherRates) {
  const Script script{.name = "short",
                      .units = {{"BONJOUR", "METEO", "NORD"}, {"MARSEILLE", "NEIGE"}},
                      .transition_mean = 735ms,
                      .transition_deviation = 224ms};
  const Signer signer = make_signer();
  for (const FrameRate rate : {FrameRate{25, 1}, FrameRate{50, 1}, FrameRate{120, 1}, FrameRate{250, 1}}) {
    const SyntheticRecording made = make_recording(script, rate, 1);
    ASSERT_EQ(made.motion.rate(), rate);
    for (const ScalarTrack& track : made.motion.tracks()) {
      ASSERT_EQ(track.values.size(), static_cast<std::size_t>(made.motion.frame_count())) << track.name;
    }
    for (const Quaternionf& rotation : made.motion.rotations()) ASSERT_NEAR(rotation.norm(), 1.0f, 1e-5f);
    for (const PlacedSign& sign : made.timeline.signs) {
      const ModelPose pose = to_model_space(made.motion.skeleton(), made.motion.pose(sign.stroke_end));
      const Vector3f wrist = pose.positions[static_cast<std::size_t>(signer.right.hand)];
      const Vector3f place = to_model(stroke_place(*sign.shape, Side::right, 1, sign.token), Side::right);
      EXPECT_LT((wrist - place).norm(), 0.02f) << to_string(rate) << ' ' << sign.shape->gloss;
    }
  }
}

TEST_P(EveryRecording, HasUnitQuaternionsThatNeverLeaveTheirHemisphere) {
  const Motion& motion = made().motion;
  for (const Quaternionf& rotation : motion.rotations()) ASSERT_NEAR(rotation.norm(), 1.0f, 1e-5f);
  for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
    const PoseView before = motion.pose(frame - 1);
    const PoseView now = motion.pose(frame);
    for (std::size_t i = 0; i < now.rotations.size(); ++i) {
      ASSERT_GE(now.rotations[i].dot(before.rotations[i]), 0) << frame << motion.skeleton().joints()[i].name;
    }
  }
}

TEST_P(EveryRecording, KeepsItsBoneLengths) {
  const Motion& motion = made().motion;
  const Skeleton& skeleton = motion.skeleton();
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += 11) {
    const ModelPose pose = to_model_space(skeleton, motion.pose(frame));
    for (std::size_t i = 1; i < skeleton.joint_count(); ++i) {
      const auto parent = static_cast<std::size_t>(skeleton.joints()[i].parent);
      ASSERT_NEAR((pose.positions[i] - pose.positions[parent]).norm(), skeleton.joints()[i].offset.norm(), 1e-5f)
          << skeleton.joints()[i].name;
    }
  }
}

TEST_P(EveryRecording, IsReadBackFromItsFiles) {
  const Motion& motion = made().motion;
  const std::string text = bvh::write_text(motion, bvh::default_layout(motion.skeleton()));
  const bvh::File read = bvh::read_text("made.bvh", text);
  EXPECT_EQ(read.layout.unit, 0.01);
  EXPECT_EQ(read.layout.up, bvh::UpAxis::y);
  EXPECT_EQ(read.motion.rate(), kRate);
  EXPECT_EQ(difference(read.motion.skeleton(), motion.skeleton()), std::nullopt);
  ASSERT_EQ(read.motion.frame_count(), motion.frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += 13) {
    const ModelPose wanted = to_model_space(motion.skeleton(), motion.pose(frame));
    const ModelPose is = to_model_space(read.motion.skeleton(), read.motion.pose(frame));
    for (std::size_t i = 0; i < wanted.positions.size(); ++i) {
      ASSERT_LT((wanted.positions[i] - is.positions[i]).norm(), 1e-4f) << frame;
    }
  }
  const AnnotationDocument document = eaf::read_text("made.eaf", eaf::write_text(made().document)).document;
  ASSERT_EQ(document.tiers.size(), made().document.tiers.size());
  for (std::size_t i = 0; i < document.tiers.size(); ++i) EXPECT_EQ(document.tiers[i], made().document.tiers[i]);
}

TEST_P(EveryRecording, MovesItsHandsUnderFourMetresPerSecondAndWithoutJerks) {
  const Motion& motion = made().motion;
  const Skeleton& skeleton = motion.skeleton();
  const Signer signer = make_signer();
  ModelPose before = to_model_space(skeleton, motion.pose(0));
  ModelPose now = to_model_space(skeleton, motion.pose(1));
  double fastest_hand = 0;  // m/s
  double fastest = 0;
  double hardest = 0;  // m/s²
  std::string where;
  for (std::int64_t frame = 2; frame < motion.frame_count(); ++frame) {
    ModelPose next = to_model_space(skeleton, motion.pose(frame));
    for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
      const Vector3f step = next.positions[i] - now.positions[i];
      const Vector3f change = step - (now.positions[i] - before.positions[i]);
      const double speed = static_cast<double>(step.norm()) * 100;
      const auto joint = static_cast<JointIndex>(i);
      if (joint == signer.left.hand || joint == signer.right.hand) fastest_hand = std::max(fastest_hand, speed);
      fastest = std::max(fastest, speed);
      const double hard = static_cast<double>(change.norm()) * 100 * 100;
      if (hard > hardest) {
        hardest = hard;
        where = skeleton.joints()[i].name + " in frame " + std::to_string(frame);
      }
    }
    before = std::move(now);
    now = std::move(next);
  }
  EXPECT_LT(fastest_hand, 4.0);
  EXPECT_GT(fastest_hand, 0.8);        // it does sign
  EXPECT_LT(fastest, 8.0);             // fingertips turn with the wrist; a jump of 25 cm would be 25 m/s
  EXPECT_LT(hardest, 120.0) << where;  // reveals a step in velocity of 1.2 m/s between frames
}

TEST_P(EveryRecording, KeepsTheFeetOnTheGroundAndTheHeadUp) {
  const Motion& motion = made().motion;
  const Skeleton& skeleton = motion.skeleton();
  const Signer signer = make_signer();
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += 7) {
    const ModelPose pose = to_model_space(skeleton, motion.pose(frame));
    for (const Side side : kSides) {
      const JointIndex foot = signer.side(side).foot;
      ASSERT_LT((pose.positions[static_cast<std::size_t>(foot)] - signer.rest_position(foot)).norm(), 0.005f) << frame;
      const JointIndex toe = signer.side(side).toe;
      ASSERT_LT((pose.positions[static_cast<std::size_t>(toe)] - signer.rest_position(toe)).norm(), 0.005f) << frame;
    }
    const Vector3f head = pose.positions[static_cast<std::size_t>(signer.head)];
    ASSERT_LT((head - signer.rest_position(signer.head)).norm(), 0.06f) << frame;
    const Vector3f facing = pose.rotations[static_cast<std::size_t>(signer.head)] * Vector3f::UnitZ();
    ASSERT_GT(facing.z(), 0.88f) << frame;
  }
}

TEST_P(EveryRecording, KeepsElbowsWristsAndForearmsWithinTheirLimits) {
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (const Side side : kSides) {
      const PoseView pose = motion.pose(frame);
      const auto local = [&](JointIndex joint) { return pose.rotations[static_cast<std::size_t>(joint)]; };
      const SideJoints& joints = signer.side(side);
      const Vector3f along(sign_of(side), 0, 0);
      // The elbow bends in one direction: forward in the T-pose.
      const Vector3f fore_arm = local(joints.fore_arm) * along;
      ASSERT_GT(fore_arm.z(), 0) << frame;
      ASSERT_NEAR(fore_arm.y(), 0, 1e-3f) << frame;
      ASSERT_GT(fore_arm.x() * sign_of(side), -0.88f) << frame;  // at most about 150° of flexion
      // The wrist's swing has no component about the forearm's axis.
      const Quaternionf wrist = local(joints.hand);
      ASSERT_NEAR(wrist.x(), 0, 2e-3f) << frame;
      ASSERT_LT(wrist.angularDistance(Quaternionf::Identity()), 1.34f) << frame;  // 70°, plus some idle motion
    }
  }
}

TEST_P(EveryRecording, ReachesTheWristTargetsOfItsTruth) {
  if (!in_one_lane()) return;  // see channels_test.cpp
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  std::istringstream lines(made().truth);
  std::string line;
  std::getline(lines, line);
  ASSERT_EQ(line, "gloss,phase,begin_ms,end_ms,hand,x,y,z,handshape,size");
  int rows = 0;
  int strokes = 0;
  const PlacedSign* placed = made().timeline.signs.data() - 1;
  while (std::getline(lines, line)) {
    std::vector<std::string> fields;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
    ASSERT_EQ(fields.size(), 10U) << line;
    const std::int64_t frame = std::stoll(fields[3]) / 10;
    ASSERT_EQ(frame * 10, std::stoll(fields[3]));
    const Side side = fields[4] == "right" ? Side::right : Side::left;
    if (fields[1] == "Preparation" && side == Side::right) ++placed;
    ASSERT_EQ(placed->shape->gloss, fields[0]);
    ASSERT_NEAR(std::stof(fields[9]), placed->token.size, 0.001f);
    const Vector3f target(std::stof(fields[5]), std::stof(fields[6]), std::stof(fields[7]));
    const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
    const Vector3f wrist = pose.positions[static_cast<std::size_t>(signer.side(side).hand)];
    EXPECT_LT((wrist - target).norm(), 0.02f) << line << " but the wrist is at " << wrist.transpose();
    ++rows;
    if (fields[1] == "Retraction") continue;
    ++strokes;
    // Taken from the table, not the plan: the stroke begins and ends where the description of this token specifies.
    const SignShape& sign = *placed->shape;
    const float done = fields[1] == "Stroke" ? 1 : 0;
    EXPECT_LT((wrist - to_model(stroke_place(sign, side, done, placed->token), side)).norm(), 0.02f) << line;
    Handshape shape = done > 0 ? sign.shape_end.value_or(sign.shape) : sign.shape;
    if (side == Side::left && sign.hands == Hands::on_base) shape = sign.base.shape;
    EXPECT_EQ(fields[8], name_of(shape)) << line;
    const HandAngles formed = hand_angles(motion, signer, side, frame);
    for (std::size_t finger = 0; finger < kFingers; ++finger) {
      for (std::size_t i = 0; i < kFingerAngles; ++i) {
        EXPECT_NEAR(formed[finger][i], angles_of(shape)[finger][i], 9.0f) << line << " finger " << finger << ' ' << i;
      }
    }
  }
  EXPECT_EQ(placed + 1, made().timeline.signs.data() + made().timeline.signs.size());
  EXPECT_EQ(strokes * 3, rows * 2);
  EXPECT_GE(strokes, 72);
}

/// How deep a point is inside a capsule, metres; negative outside.
float depth_in(const Vector3f& from, const Vector3f& to, float radius, const Vector3f& point) {
  const Vector3f line = to - from;
  const float along = std::clamp((point - from).dot(line) / line.squaredNorm(), 0.0f, 1.0f);
  return radius - (point - from - along * line).norm();
}

TEST_P(EveryRecording, KeepsTheHandsOutOfTrunkAndHeadAndOnTheirSides) {
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  float deepest = 0;
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += 2) {
    const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
    const auto at = [&](JointIndex joint) { return pose.positions[static_cast<std::size_t>(joint)]; };
    const Vector3f up = pose.rotations[static_cast<std::size_t>(signer.head)] * Vector3f::UnitY();
    std::vector<Vector3f> points;
    for (const Side side : kSides) {
      const SideJoints& joints = signer.side(side);
      points.push_back(at(joints.hand));
      ASSERT_GT(points.back().x() * sign_of(side), -0.02f) << frame << ": the wrists are crossed";
      for (const auto& finger : joints.fingers) {
        for (const JointIndex joint : finger) points.push_back(at(joint));
      }
    }
    for (const Tip& tip : motion.skeleton().tips()) {
      if (motion.skeleton().joint(tip.joint).name.find("Hand") != std::string::npos) {
        points.push_back(position_of(tip, pose));
      }
    }
    ASSERT_EQ(points.size(), 42U);
    for (const Vector3f& point : points) {
      // A trunk 22 cm deep, a head 17 cm deep and 24 cm high.
      const float trunk = depth_in(at(signer.hips), at(signer.neck) - Vector3f(0, 0.08f, 0), 0.11f, point);
      const float head = depth_in(at(signer.head) + 0.04f * up, at(signer.head) + 0.11f * up, 0.085f, point);
      deepest = std::max({deepest, trunk, head});
      ASSERT_LT(trunk, 0.01f) << frame << " at " << point.transpose();
      ASSERT_LT(head, 0.01f) << frame << " at " << point.transpose();
    }
  }
}

TEST_P(EveryRecording, KeepsTheHandsOutOfEachOther) {
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += 3) {
    const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
    std::vector<Vector3f> points[2];
    for (const Side side : kSides) {
      for (const auto& finger : signer.side(side).fingers) {
        Vector3f before = pose.positions[static_cast<std::size_t>(signer.side(side).hand)];
        for (const JointIndex joint : finger) {
          const Vector3f place = pose.positions[static_cast<std::size_t>(joint)];
          points[static_cast<std::size_t>(side)].push_back(place);
          points[static_cast<std::size_t>(side)].push_back(0.5f * (before + place));
          before = place;
        }
      }
    }
    // From bone to bone: fingers are about 1.5 cm thick and yield slightly.
    for (const Vector3f& left : points[0]) {
      for (const Vector3f& right : points[1]) ASSERT_GT((left - right).norm(), 0.009f) << frame;
    }
  }
}

TEST_P(EveryRecording, KeepsFingersWithinTheirLimits) {
  const Motion& motion = made().motion;
  const Signer signer = make_signer();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (const Side side : kSides) {
      const HandAngles angles = hand_angles(motion, signer, side, frame);
      for (std::size_t finger = 0; finger < kFingers; ++finger) {
        for (std::size_t i = 0; i < kFingerAngles; ++i) {
          const AngleLimits limits = limits_of(static_cast<int>(finger), static_cast<int>(i));
          ASSERT_GE(angles[finger][i], limits.least - 0.1f) << frame << " finger " << finger << ' ' << i;
          ASSERT_LE(angles[finger][i], limits.most + 0.1f) << frame << " finger " << finger << ' ' << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace signweave::demo
