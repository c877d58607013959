// The recordings of signs that are aimed at places: their motion follows the law, as far as features measure it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "demo/arms.h"
#include "demo/space.h"
#include "demo/test_rate.h"
#include "signweave/features/defects.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/hand_points.h"
#include "signweave/rig/rig_map.h"

namespace signweave::demo {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr double kDegrees = 180 / std::numbers::pi;

SpaceScript script_of(const std::string& name) {
  return name == "espace_index" ? espace_index() : espace_verbes(name == "espace_verbes_1" ? 1 : 2);
}
const SyntheticRecording& made(const std::string& name) {
  static std::map<std::string, SyntheticRecording> recordings;
  const auto [at, fresh] = recordings.try_emplace(name);
  if (fresh) at->second = make_space(script_of(name), kRate, 1);
  return at->second;
}
constexpr const char* kNames[] = {"espace_index", "espace_verbes_1", "espace_verbes_2"};

/// What features see of a recording.
struct Measured {
  SignerModel model;
  HandMotion motion;
  explicit Measured(const Motion& recorded) {
    model.rig = map_rig(recorded);
    model.body = signer_body(recorded, model.rig);
    motion = measure_hands(recorded, model, {0, recorded.frame_count()});
  }
  const HandFrame& at(Side side, std::int64_t frame) const {
    return motion.hands[side == Side::left ? 0 : 1].frames.at(static_cast<std::size_t>(frame));
  }
  Vector3f palm(Side side, std::int64_t frame) const { return model.body->shoulder_width * at(side, frame).position; }
};

/// Rows of a table by the names of its columns.
using Row = std::map<std::string, std::string>;
std::vector<Row> rows_of(const std::string& table) {
  std::istringstream lines(table);
  const auto fields = [](const std::string& line) {
    std::vector<std::string> all;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) all.push_back(field);
    return all;
  };
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = fields(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> values = fields(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(values.size(), names.size()); ++i) row[names[i]] = values[i];
  }
  return rows;
}
float number(const Row& row, const std::string& name) {
  return std::stof(row.at(name));
}
Vector3f three(const Row& row, const std::string& x, const std::string& y, const std::string& z) {
  return {number(row, x), number(row, y), number(row, z)};
}

/// One end of the stroke of a row, as the law gives it and as it is measured.
struct Compared {
  std::string what;
  Vector3f off;        ///< of the palm: measured minus law, metres
  Quaternionf turned;  ///< measured relative to law
  Vector3f shift;      ///< the noise of the table
  Quaternionf turn;
};
std::vector<Compared> compare(const SyntheticRecording& recording) {
  const Measured measured(recording.motion);
  std::vector<Compared> all;
  for (const Row& row : rows_of(recording.space)) {
    const Side side = row.at("hand") == "left" ? Side::left : Side::right;
    for (const std::string end : {"begin", "end"}) {
      if (row.at("gloss") == "DIRE" && end == "begin") continue;  // at the mouth, wherever the head is
      const auto frame = std::stoll(row.at("stroke_" + end + "_ms")) / 10;
      const HandFrame& hand = measured.at(side, frame);
      Eigen::Matrix3f axes;
      axes.col(2) = hand.fingers;
      axes.col(1) = -hand.palm;
      axes.col(0) = axes.col(1).cross(axes.col(2));
      const Quaternionf law(number(row, end + "_qw"), number(row, end + "_qx"), number(row, end + "_qy"),
                            number(row, end + "_qz"));
      const Vector3f vector = three(row, "noise_rx", "noise_ry", "noise_rz") * static_cast<float>(1 / kDegrees);
      const Quaternionf turn(Eigen::AngleAxisf(vector.norm(), vector.stableNormalized()));
      all.push_back({.what = row.at("gloss") + ' ' + row.at("hand") + ' ' + row.at("from") + '>' + row.at("to") +
                             row.at("at") + ' ' + end,
                     .off = measured.palm(side, frame) - three(row, end + "_x", end + "_y", end + "_z"),
                     .turned = Quaternionf(axes) * law.conjugate(),
                     .shift = three(row, "noise_x", "noise_y", "noise_z"),
                     .turn = vector.norm() > 0 ? turn : Quaternionf::Identity()});
    }
  }
  return all;
}

TEST(SpaceRecordings, FollowTheLawAndTheNoiseOfTheirTables) {
  for (const char* name : kNames) {
    for (const Compared& one : compare(made(name))) {
      const bool pair = one.what.starts_with("AIDER left");  // turns about the right palm
      EXPECT_LT((one.off - one.shift).norm(), pair ? 0.02f : 0.007f) << one.what;
      EXPECT_LT(kDegrees * one.turned.angularDistance(one.turn), 4.0) << one.what;  // a wrist at its limit
    }
  }
}

TEST(SpaceRecordings, DifferFromTheLawByFiveMillimetresAndThreeDegrees) {
  double shifts = 0, turns = 0, count = 0;
  for (const char* name : {"espace_verbes_1", "espace_verbes_2"}) {
    for (const Compared& one : compare(made(name))) {
      if (one.what.starts_with("AIDER left")) continue;
      shifts += static_cast<double>(one.off.squaredNorm());
      turns += std::pow(kDegrees * one.turned.angularDistance(Quaternionf::Identity()), 2);
      ++count;
    }
  }
  EXPECT_GT(count, 500);
  EXPECT_NEAR(1000 * std::sqrt(shifts / count), 5, 0.5);
  EXPECT_NEAR(std::sqrt(turns / count), 3, 0.3);
}

TEST(SpaceRecordings, PointTheIndexFingerAtItsLocusWithinADegree) {
  const SyntheticRecording still = make_space(espace_index(), kRate, 1, 0);
  const Measured measured(still.motion);
  const HandPlaces places(measured.model.rig, signweave::Side::right);
  std::set<std::string> loci;
  for (const Row& row : rows_of(still.space)) {
    const Vector3f locus = point_of(locus_of(row.at("at"))) / kShoulderWidth;
    loci.insert(row.at("at"));
    for (const char* end : {"stroke_begin_ms", "stroke_end_ms"}) {
      const ModelPose pose = to_model_space(still.motion.skeleton(), still.motion.pose(std::stoll(row.at(end)) / 10));
      HandPoints points;
      places.read(pose, points);
      const auto& index = points.finger(Finger::index);
      const SignerSpace space = signer_space(*measured.model.body, measured.model.rig, pose);
      const Vector3f knuckle = space.to_signer(index.points[0]);
      const Vector3f along = space.to_signer(index.points[index.count - 1]) - knuckle;
      const double angle = kDegrees * std::acos(std::min(1.0f, along.normalized().dot((locus - knuckle).normalized())));
      EXPECT_LT(angle, 1.0) << row.at("at") << ' ' << end;
      EXPECT_LT(along.norm(), (locus - knuckle).norm()) << row.at("at") << ": the finger ends before the locus";
    }
  }
  EXPECT_EQ(loci.size(), 24U);
}

TEST(SpaceRecordings, NameThePlannedLociInTheirTiers) {
  for (const char* name : kNames) {
    const AnnotationDocument& document = made(name).document;
    EXPECT_THAT(document.properties.at(0).second, testing::HasSubstr("not LSF"));
    std::vector<Aimed> tokens;
    const SpaceScript script = script_of(name);
    for (const auto& unit : script.units) tokens.insert(tokens.end(), unit.begin(), unit.end());
    const std::vector<Annotation>& glosses = document.find_tier("Gloss")->annotations;
    ASSERT_EQ(glosses.size(), tokens.size());
    for (const auto& [id, kind] :
         {std::pair("From", &Aimed::from), std::pair("To", &Aimed::to), std::pair("At", &Aimed::at)}) {
      const Tier* tier = document.find_tier(id);
      std::size_t next = 0;
      for (std::size_t i = 0; i < tokens.size(); ++i) {
        EXPECT_EQ(glosses[i].label, tokens[i].gloss);
        if (!(tokens[i].*kind)) continue;
        ASSERT_NE(tier, nullptr) << id;
        ASSERT_LT(next, tier->annotations.size());
        const Annotation& one = tier->annotations[next++];
        EXPECT_EQ(one.label, (tokens[i].*kind)->text);
        EXPECT_EQ(one.span, glosses[i].span);
      }
      EXPECT_EQ(next, tier == nullptr ? 0 : tier->annotations.size()) << id;
    }
  }
}

TEST(SpaceRecordings, HaveTwentyTokensOfEachVerbAtSevenLociAndSomeTwice) {
  std::map<std::string_view, std::vector<std::string>> tokens;
  std::map<std::string_view, std::set<std::string>> loci;
  for (const char* name : kNames) {
    for (const auto& unit : script_of(name).units) {
      for (const Aimed& token : unit) {
        std::string both;
        for (const auto* locus : {&token.from, &token.to, &token.at}) {
          if (!*locus) continue;
          loci[token.gloss].insert((*locus)->text);
          both += (*locus)->text + ' ';
        }
        tokens[token.gloss].push_back(both);
      }
    }
  }
  ASSERT_EQ(tokens.size(), 13U);
  for (auto& [gloss, all] : tokens) {
    EXPECT_GE(all.size(), 20U) << gloss;
    EXPECT_GE(loci[gloss].size(), 8U) << gloss;
    std::sort(all.begin(), all.end());
    EXPECT_NE(std::adjacent_find(all.begin(), all.end()), all.end()) << gloss;
  }
}

TEST(SpaceRecordings, BeginTheSignOfTheMouthAtTheMouth) {
  const Signer signer = make_signer();
  const SyntheticRecording& recording = made("espace_verbes_2");
  int count = 0;
  for (const PlacedSign& sign : recording.timeline.signs) {
    if (sign.shape->gloss != "DIRE") continue;
    const auto gap = [&](std::int64_t frame) {
      const ModelPose pose = to_model_space(recording.motion.skeleton(), recording.motion.pose(frame));
      const auto at = [&](JointIndex joint, const Vector3f& offset) {
        const auto i = static_cast<std::size_t>(joint);
        return Vector3f(pose.positions[i] + pose.rotations[i] * offset);
      };
      Vector3f tip = signer.finger_tip(1);
      tip.x() = -tip.x();
      return (at(signer.right.fingers[1].back(), tip) - at(signer.head, kMouthFromHead)).norm();
    };
    EXPECT_NEAR(gap(sign.stroke_begin), 0.009f, 0.001f);
    EXPECT_GT(gap(sign.stroke_end), 0.15f);
    ++count;
  }
  EXPECT_EQ(count, 24);
}

float depth_in(const Vector3f& from, const Vector3f& to, float radius, const Vector3f& point) {
  const Vector3f line = to - from;
  const float along = std::clamp((point - from).dot(line) / line.squaredNorm(), 0.0f, 1.0f);
  return radius - (point - from - along * line).norm();
}

TEST(SpaceRecordings, KeepTheHandsOutOfBodyAndEachOther) {
  const Signer signer = make_signer();
  for (const char* name : kNames) {
    const Motion& motion = made(name).motion;
    for (std::int64_t frame = 0; frame < motion.frame_count(); frame += 3) {
      const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
      const auto at = [&](JointIndex joint) { return pose.positions[static_cast<std::size_t>(joint)]; };
      const Vector3f up = pose.rotations[static_cast<std::size_t>(signer.head)] * Vector3f::UnitY();
      std::vector<Vector3f> points[2];
      for (const Side side : kSides) {
        std::vector<Vector3f>& hand = points[static_cast<std::size_t>(side)];
        for (const auto& finger : signer.side(side).fingers) {
          Vector3f before = at(signer.side(side).hand);
          for (const JointIndex joint : finger) {
            hand.push_back(at(joint));
            hand.push_back(0.5f * (before + at(joint)));
            before = at(joint);
          }
        }
        for (const Vector3f& point : hand) {
          const Vector3f neck = at(signer.neck) - Vector3f(0, 0.08f, 0);
          ASSERT_LT(depth_in(at(signer.hips), neck, 0.11f, point), 0.01f) << name << ' ' << frame;
          ASSERT_LT(depth_in(at(signer.head) + 0.04f * up, at(signer.head) + 0.11f * up, 0.085f, point), 0.01f)
              << name << ' ' << frame;
        }
      }
      for (const Vector3f& left : points[0]) {
        for (const Vector3f& right : points[1]) ASSERT_GT((left - right).norm(), 0.009f) << name << ' ' << frame;
      }
    }
  }
}

TEST(SpaceRecordings, KeepJointsWithinTheirLimitsAndHandsUnderFourMetresPerSecond) {
  const Signer signer = make_signer();
  for (const char* name : kNames) {
    const Motion& motion = made(name).motion;
    std::array<Vector3f, 2> before;
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
      const auto local = [&](JointIndex joint) {
        return motion.pose(frame).rotations[static_cast<std::size_t>(joint)];
      };
      for (const Side side : kSides) {
        const SideJoints& joints = signer.side(side);
        const Vector3f fore_arm = local(joints.fore_arm) * Vector3f(sign_of(side), 0, 0);
        ASSERT_GT(fore_arm.z(), 0) << name << ' ' << frame;  // bends in one direction
        ASSERT_NEAR(fore_arm.y(), 0, 1e-3f) << name << ' ' << frame;
        ASSERT_GT(fore_arm.x() * sign_of(side), -0.88f) << name << ' ' << frame;  // at most about 150°
        ASSERT_LT(local(joints.hand).angularDistance(Quaternionf::Identity()), 1.34f) << name << ' ' << frame;
        const Vector3f wrist = pose.positions[static_cast<std::size_t>(joints.hand)];
        Vector3f& last = before[static_cast<std::size_t>(side)];
        if (frame > 0) ASSERT_LT((wrist - last).norm(), 0.04f) << name << ' ' << frame;
        last = wrist;
      }
    }
  }
}

TEST(SpaceRecordings, HaveNoDefects) {
  for (const char* name : kNames) {
    for (const Defect& defect : find_defects(made(name).motion, map_rig(made(name).motion))) {
      ADD_FAILURE() << name << ": " << defect.text;
    }
  }
}

TEST(SpaceRecordings, AreTheSameForTheSameSeed) {
  const SyntheticRecording again = make_space(espace_index(), kRate, 1);
  const SyntheticRecording& first = made("espace_index");
  EXPECT_EQ(again.document, first.document);
  EXPECT_EQ(again.truth, first.truth);
  EXPECT_EQ(again.space, first.space);
  EXPECT_EQ(again.motion.tracks(), first.motion.tracks());
  EXPECT_TRUE(std::equal(again.motion.rotations().begin(), again.motion.rotations().end(),
                         first.motion.rotations().begin(), first.motion.rotations().end(),
                         [](const Quaternionf& a, const Quaternionf& b) { return a.coeffs() == b.coeffs(); }));
  EXPECT_NE(make_space(espace_index(), kRate, 2).space, first.space);
}

}  // namespace
}  // namespace signweave::demo
