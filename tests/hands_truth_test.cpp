// The hands of the synthetic signer, measured from its motion through a rig map derived from the names of its joints,
// against the known plan of the motion.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "demo/corpus.h"
#include "demo/keep_out.h"
#include "signweave/features/hand_motion.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// One row of a recording's truth, with the values measured there.
struct Row {
  std::string gloss, phase, handshape;
  Side side = Side::left;
  FrameRange frames;
  Vector3f wrist;      ///< planned, metres, model space
  Vector3f palm;       ///< measured at the end, metres, model space
  HandFrame measured;  ///< at the end
};

/// The rows of the paper's two recordings.
const std::vector<Row>& rows() {
  static const std::vector<Row> all = [] {
    std::vector<Row> rows;
    for (const demo::Script& script : demo::corpus_scripts(2)) {
      const demo::SyntheticRecording made = demo::make_recording(script, {100, 1}, 1);
      const std::int64_t frames = made.motion.frame_count();
      SignerModel model{.rig = map_rig(made.motion), .body = {}};
      model.body = signer_body(made.motion, model.rig);
      const HandMotion hands = measure_hands(made.motion, model, {0, frames});
      std::istringstream truth(made.truth);
      std::string line;
      std::getline(truth, line);
      while (std::getline(truth, line)) {
        std::istringstream words(line);
        std::vector<std::string> cells;
        for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
        Row row{.gloss = cells.at(0), .phase = cells.at(1), .handshape = cells.at(8)};
        row.side = cells[4] == "left" ? Side::left : Side::right;
        row.frames = {std::stoll(cells[2]) / 10, std::min<std::int64_t>(std::stoll(cells[3]) / 10, frames - 1)};
        row.wrist = {std::stof(cells[5]), std::stof(cells[6]), std::stof(cells[7])};
        const auto& hand = hands.hands[static_cast<std::size_t>(row.side)].frames;
        row.measured = hand.at(static_cast<std::size_t>(row.frames.end));
        const ModelPose pose = to_model_space(made.motion.skeleton(), made.motion.pose(row.frames.end));
        row.palm = signer_space(*model.body, model.rig, pose).to_model(row.measured.position);
        rows.push_back(std::move(row));
      }
    }
    return rows;
  }();
  return all;
}

std::vector<float> openness_of(const std::string& handshape) {
  std::vector<float> values;
  for (const Row& row : rows()) {
    if (row.phase == "Stroke" && row.handshape == handshape) values.push_back(row.measured.openness);
  }
  return values;
}

TEST(HandsOfTheSyntheticSigner, AreWherePlanned) {
  ASSERT_GT(rows().size(), 150U);
  for (const Row& row : rows()) {
    // The palm's centre is 4.5 cm from the wrist, which is within 2 cm of the plan.
    const float apart = (row.palm - row.wrist).norm();
    EXPECT_GT(apart, 0.025f) << row.gloss << ' ' << row.phase;
    EXPECT_LT(apart, 0.065f) << row.gloss << ' ' << row.phase;
  }
}

TEST(HandsOfTheSyntheticSigner, AreOpenIfFlatAndClosedIfAFist) {
  using testing::AllOf, testing::Each, testing::Gt, testing::Lt, testing::SizeIs;
  EXPECT_THAT(openness_of("flat"), AllOf(SizeIs(Gt(5U)), Each(Gt(0.9f))));
  EXPECT_THAT(openness_of("spread"), AllOf(SizeIs(Gt(5U)), Each(Gt(0.9f))));
  EXPECT_THAT(openness_of("fist"), AllOf(SizeIs(Gt(5U)), Each(Lt(0.15f))));
  EXPECT_THAT(openness_of("index"), AllOf(SizeIs(Gt(3U)), Each(AllOf(Gt(0.2f), Lt(0.4f)))));   // one of four fingers
  EXPECT_THAT(openness_of("two"), AllOf(SizeIs(Gt(3U)), Each(AllOf(Gt(0.45f), Lt(0.65f)))));   // two of four fingers
  EXPECT_THAT(openness_of("claw"), AllOf(SizeIs(Gt(5U)), Each(AllOf(Gt(0.45f), Lt(0.75f)))));  // all half bent
}

TEST(HandsOfTheSyntheticSigner, HaveTheHandshapeOfTheNearestOtherToken) {
  std::vector<const Row*> strokes;
  for (const Row& row : rows()) {
    if (row.phase == "Stroke") strokes.push_back(&row);
  }
  int tokens = 0;
  for (const Row* row : strokes) {
    const Row* nearest = nullptr;
    bool unique = true;
    for (const Row* other : strokes) {
      if (other == row) continue;
      unique &= other->handshape != row->handshape;
      if (nearest == nullptr || distance(row->measured.handshape, other->measured.handshape) <
                                    distance(row->measured.handshape, nearest->measured.handshape)) {
        nearest = other;
      }
    }
    if (unique) continue;
    ++tokens;
    EXPECT_EQ(nearest->handshape, row->handshape) << row->gloss;
  }
  EXPECT_GT(tokens, 80);
}

/// The joints of a hand and its fingertips, from the demo's own skeleton rather than through a rig map.
std::vector<Vector3f> points_of(const demo::Signer& signer, demo::Side side, const ModelPose& pose) {
  std::vector<Vector3f> points = {pose.positions[static_cast<std::size_t>(signer.side(side).hand)]};
  for (const auto& finger : signer.side(side).fingers) {
    for (const JointIndex joint : finger) points.push_back(pose.positions[static_cast<std::size_t>(joint)]);
    for (const Tip& tip : signer.skeleton->tips()) {
      if (tip.joint == finger.back()) points.push_back(position_of(tip, pose));
    }
  }
  return points;
}

TEST(HandsOfTheSyntheticSigner, TouchIfTheirPointsAreNearAndNotIfTheyAreFar) {
  const demo::Signer signer = demo::make_signer();
  int near = 0;
  int far = 0;
  float nearest_to_body = 1;
  for (const demo::Script& script : demo::corpus_scripts(2)) {
    const Motion motion = demo::make_recording(script, {100, 1}, 1).motion;
    SignerModel model{.rig = map_rig(motion), .body = {}};
    model.body = signer_body(motion, model.rig);
    const HandMotion hands = measure_hands(motion, model, {0, motion.frame_count()});
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const ModelPose pose = to_model_space(*signer.skeleton, motion.pose(frame));
      const auto left = points_of(signer, demo::Side::left, pose);
      const auto right = points_of(signer, demo::Side::right, pose);
      float apart = 1;
      for (const Vector3f& a : left) {
        for (const Vector3f& b : right) apart = std::min(apart, (a - b).norm());
      }
      const Contact contact = hands.hands[1].frames[static_cast<std::size_t>(frame)].contact;
      const bool touch = has(contact, Contact::hands);
      EXPECT_EQ(touch, has(hands.hands[0].frames[static_cast<std::size_t>(frame)].contact, Contact::hands));
      if (apart < 0.028f) {  // the thickness of two fingers and the distance that counts as touching
        ++near;
        EXPECT_TRUE(touch) << script.name << ' ' << frame << ": " << apart;
      }
      if (apart > 0.09f) {
        ++far;
        EXPECT_FALSE(touch) << script.name << ' ' << frame << ": " << apart;
      }
      // The demo keeps the hands outside its own model of head and trunk, so no contact with them may be reported.
      for (const demo::Capsule& capsule : demo::keep_out_of(signer, pose)) {
        for (const Vector3f& point : right) {
          nearest_to_body = std::min(nearest_to_body, demo::clearance(capsule, point));
        }
      }
      EXPECT_FALSE(has(contact, Contact::head) || has(contact, Contact::torso)) << script.name << ' ' << frame;
    }
  }
  EXPECT_GT(nearest_to_body, 0.02f);
  EXPECT_GT(near, 10);
  EXPECT_GT(far, 5000);
}

}  // namespace
}  // namespace signweave
