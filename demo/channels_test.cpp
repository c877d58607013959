// The recordings mains and visage: their motion and face agree with the times of their tiers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "demo/arms.h"
#include "demo/channels.h"
#include "demo/test_rate.h"
#include "signweave/annotation/sign.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

const SyntheticRecording& made_mains() {
  static const SyntheticRecording made = make_channels(mains(), kRate, 1);
  return made;
}
const SyntheticRecording& made_visage() {
  static const SyntheticRecording made = make_channels(visage(), kRate, 1);
  return made;
}

/// Both.
std::vector<const SyntheticRecording*> all_made() {
  return {&made_mains(), &made_visage()};
}

const Tier& tier(const SyntheticRecording& made, std::string_view id) {
  const Tier* found = made.document.find_tier(id);
  if (found == nullptr) throw std::runtime_error("no tier " + std::string(id));
  return *found;
}

FrameRange frames(const TimeSpan& span) {
  return {span.begin.count() / 10, span.end.count() / 10};
}

const std::vector<float>& track(const SyntheticRecording& made, std::string_view name) {
  for (const ScalarTrack& one : made.motion.tracks()) {
    if (one.name == name) return one.values;
  }
  throw std::runtime_error("no track " + std::string(name));
}
double at(const std::vector<float>& values, std::int64_t frame) {
  return static_cast<double>(values.at(static_cast<std::size_t>(frame)));
}

struct PosedSigner {
  Signer signer = make_signer();
  ModelPose pose;
  PosedSigner(const SyntheticRecording& made, std::int64_t frame)
      : pose(to_model_space(made.motion.skeleton(), made.motion.pose(frame))) {}
  Vector3f place(JointIndex joint) const { return pose.positions[static_cast<std::size_t>(joint)]; }
  Vector3f at(JointIndex joint, const Vector3f& offset) const {
    return place(joint) + pose.rotations[static_cast<std::size_t>(joint)] * offset;
  }
  /// The middle of the palm.
  Vector3f palm(Side side) const {
    const SideJoints& joints = signer.side(side);
    return 0.5f * (place(joints.hand) + place(joints.fingers[2][0]));
  }
  Vector3f tip(Side side, std::size_t finger) const {
    Vector3f end = signer.finger_tip(finger);
    end.x() *= sign_of(side);
    return at(signer.side(side).fingers[finger].back(), end);
  }
  Vector3f in_chest(const Vector3f& place) const {
    const auto chest = static_cast<std::size_t>(signer.spine2);
    return pose.rotations[chest].conjugate() * (place - pose.positions[chest]);
  }
};

/// The signs with their phases, as an import finds them.
std::vector<Sign> signs_of(const SyntheticRecording& made) {
  const SignsFound found = signs_in(made.document, guess_tier_names(made.document));
  EXPECT_TRUE(found.notices.empty()) << made.name << ": " << found.notices.front().text;
  return found.signs;
}

struct HeldSpan {
  std::string gloss;
  FrameRange frames;
};
std::vector<HeldSpan> holds(const SyntheticRecording& made) {
  std::vector<HeldSpan> result;
  for (const Sign& sign : signs_of(made)) {
    for (const Phase& phase : sign.phases) {
      if (phase.kind == PhaseKind::hold) result.push_back({sign.gloss, frames(phase.span)});
    }
  }
  return result;
}

/// How far a hand moves within a span, as the size of the box around its palm in the space of the chest, metres.
float extent(const SyntheticRecording& made, Side side, FrameRange span) {
  Eigen::AlignedBox3f box;
  for (std::int64_t frame = span.begin; frame < span.end; ++frame) {
    const PosedSigner posed(made, frame);
    box.extend(posed.in_chest(posed.palm(side)));
  }
  return box.diagonal().norm();
}

TEST(ChannelRecordings, LastAboutAMinuteAndSayThatTheyArePlaceholders) {
  for (const SyntheticRecording* made : all_made()) {
    EXPECT_NEAR(made->motion.duration().count(), 60, 15) << made->name;
    ASSERT_FALSE(made->document.properties.empty());
    EXPECT_THAT(made->document.properties[0].second, testing::HasSubstr("not LSF"));
  }
}

TEST(ChannelRecordings, HaveSignsOfEachHandAndOfBoth) {
  for (const SyntheticRecording* made : all_made()) {
    std::array<std::set<std::string>, 2> glosses;
    for (const Sign& sign : signs_of(*made)) {
      ASSERT_NE(sign.hand, Hand::both) << made->name;
      EXPECT_FALSE(sign.inferred);
      glosses[sign.hand == Hand::right ? 1 : 0].insert(sign.gloss);
    }
    EXPECT_TRUE(glosses[0].contains("REGION")) << made->name;
    EXPECT_FALSE(glosses[1].contains("REGION")) << made->name;
    EXPECT_TRUE(glosses[0].contains("NEIGE") && glosses[1].contains("NEIGE")) << made->name;
    EXPECT_TRUE(glosses[1].contains("BREST") && !glosses[0].contains("BREST")) << made->name;
  }
  std::set<std::string> left;
  for (const Annotation& sign : tier(made_mains(), "Glose MG").annotations) left.insert(sign.label);
  EXPECT_TRUE(left.contains("QUIMPER") && left.contains("LYON"));
}

TEST(ChannelRecordings, KeepAHeldHandStillRelativeToTheChestWhileTheOtherSigns) {
  const SyntheticRecording still = make_channels(mains(), kRate, 1, 0);
  ASSERT_EQ(holds(still).size(), 3U);
  for (const HeldSpan& held : holds(still)) {
    EXPECT_GT(held.frames.end - held.frames.begin, 200) << held.gloss;
    EXPECT_LT(extent(still, Side::left, held.frames), 1e-4f) << held.gloss;
    EXPECT_GT(extent(still, Side::right, held.frames), 0.15f) << held.gloss;
  }
  for (const SyntheticRecording* made : all_made()) {
    ASSERT_FALSE(holds(*made).empty());
    for (const HeldSpan& held : holds(*made)) {
      EXPECT_GT(extent(*made, Side::left, held.frames), 1e-4f) << held.gloss;  // the signer's own unrest
      EXPECT_LT(extent(*made, Side::left, held.frames), 4e-3f) << held.gloss;
      // It moves before and after.
      EXPECT_GT(extent(*made, Side::left, {held.frames.begin - 30, held.frames.begin}), 0.02f) << held.gloss;
      EXPECT_GT(extent(*made, Side::left, {held.frames.end, held.frames.end + 30}), 0.02f) << held.gloss;
    }
  }
}

/// The distance between the two that a label of the tier Contact names, metres.
float distance(const PosedSigner& posed, const std::string& label) {
  static const std::vector<std::string> kFingerNames = {"thumb", "index", "middle finger"};
  const auto tip_of = [&](const std::string& name) {
    const Side side = name.starts_with("left") ? Side::left : Side::right;
    const auto finger =
        std::find(kFingerNames.begin(), kFingerNames.end(), name.substr(name.find(' ') + 1)) - kFingerNames.begin();
    return posed.tip(side, static_cast<std::size_t>(finger));
  };
  const std::size_t dash = label.find(" - ");
  const Vector3f from = tip_of(label.substr(0, dash));
  const std::string what = label.substr(dash + 3);
  if (what == "chin") return (posed.at(posed.signer.jaw, kChinFromJaw) - from).norm();
  if (what == "chest") return (posed.at(posed.signer.spine2, kChestFromSpine2) - from).norm();
  return (tip_of(what) - from).norm();
}

TEST(ChannelRecordings, TouchDuringTheirContactsAndNotElsewhere) {
  std::set<std::string> kinds;
  for (const Annotation& contact : tier(made_mains(), "Contact").annotations) {
    const bool skin = contact.label.ends_with("chin") || contact.label.ends_with("chest");
    const FrameRange span = frames(contact.span);
    for (std::int64_t frame = span.begin; frame <= span.end; ++frame) {
      EXPECT_NEAR(distance(PosedSigner(made_mains(), frame), contact.label), skin ? 0.009f : 0.017f, 1e-3f)
          << contact.label << ' ' << frame;
    }
    const float before = distance(PosedSigner(made_mains(), span.begin - 35), contact.label);
    const float after = distance(PosedSigner(made_mains(), span.end + 35), contact.label);
    EXPECT_GT(std::max(before, after), 0.05f) << contact.label << ' ' << span.begin;
    kinds.insert(contact.label);
  }
  EXPECT_EQ(kinds.size(), 5U);
}

/// Correlation of the velocities of the right palm and of the mirrored left one during the strokes of a gloss.
double correlation(const SyntheticRecording& made, std::string_view gloss) {
  double both = 0, right = 0, left = 0;
  for (const Sign& sign : signs_of(made)) {
    if (sign.gloss != gloss || sign.hand != Hand::right) continue;
    const FrameRange span = frames(sign.stroke_span().value());
    for (std::int64_t frame = span.begin; frame < span.end; ++frame) {
      const PosedSigner now(made, frame);
      const PosedSigner next(made, frame + 1);
      const Vector3f r = next.palm(Side::right) - now.palm(Side::right);
      Vector3f l = next.palm(Side::left) - now.palm(Side::left);
      l.x() = -l.x();
      both += static_cast<double>(r.dot(l));
      right += static_cast<double>(r.squaredNorm());
      left += static_cast<double>(l.squaredNorm());
    }
  }
  EXPECT_GT(right, 0) << gloss;
  return both / std::sqrt(right * left);
}
/// The path of the left palm in strokes of a gloss as a fraction of that of the right palm.
double share_of_left(const SyntheticRecording& made, std::string_view gloss) {
  double paths[2] = {0, 0};
  for (const Sign& sign : signs_of(made)) {
    if (sign.gloss != gloss || sign.hand != Hand::right) continue;
    const FrameRange span = frames(sign.stroke_span().value());
    for (std::int64_t frame = span.begin; frame < span.end; ++frame) {
      for (const Side side : kSides) {
        const Vector3f step = PosedSigner(made, frame + 1).palm(side) - PosedSigner(made, frame).palm(side);
        paths[static_cast<std::size_t>(side)] += static_cast<double>(step.norm());
      }
    }
  }
  return paths[0] / paths[1];
}

TEST(ChannelRecordings, MoveBothHandsAsTheClassOfTheSignSays) {
  for (const char* gloss : {"METEO", "NEIGE", "FORT", "CARTE"})
    EXPECT_GT(correlation(made_mains(), gloss), 0.85) << gloss;
  for (const char* gloss : {"ORAGE", "BROUILLARD", "TRAVAILLER"}) {
    EXPECT_LT(correlation(made_mains(), gloss), -0.6) << gloss;
    EXPECT_GT(share_of_left(made_mains(), gloss), 0.7) << gloss;
  }
  for (const char* gloss : {"SOMMET", "ARRIVER"}) EXPECT_LT(share_of_left(made_mains(), gloss), 0.25) << gloss;
}

TEST(ChannelRecordings, HaveBrowsAboveHalfWithinTheirSpansOnly) {
  const SyntheticRecording& made = made_visage();
  const std::vector<Annotation>& brows = tier(made, "Brows").annotations;
  ASSERT_EQ(brows.size(), 4U);
  std::vector<double> wanted[2] = {std::vector<double>(static_cast<std::size_t>(made.motion.frame_count())),
                                   std::vector<double>(static_cast<std::size_t>(made.motion.frame_count()))};
  for (const Annotation& one : brows) {
    const FrameRange span = frames(one.span);
    std::vector<double>& level = wanted[one.label == "raised" ? 0 : 1];
    for (std::int64_t frame = span.begin - 10; frame <= span.end + 10; ++frame) {
      const bool edge = std::abs(frame - span.begin) <= 1 || std::abs(frame - span.end) <= 1;
      const bool inside = frame > span.begin && frame < span.end;
      level[static_cast<std::size_t>(frame)] = edge ? 0.5 : inside ? 1 : 0.25;
    }
  }
  const char* names[2][2] = {{"browInnerUp", "browOuterUpLeft"}, {"browDownLeft", "browDownRight"}};
  for (std::size_t kind = 0; kind < 2; ++kind) {
    for (const char* name : names[kind]) {
      for (std::int64_t frame = 0; frame < made.motion.frame_count(); ++frame) {
        const double weight = at(track(made, name), frame);
        const double level = wanted[kind][static_cast<std::size_t>(frame)];
        if (level == 0.5) ASSERT_NEAR(weight, 0.5, 0.13) << name << ' ' << frame;
        if (level == 1) ASSERT_GT(weight, 0.5) << name << ' ' << frame;
        if (level == 0.25) ASSERT_LT(weight, 0.5) << name << ' ' << frame;
        if (level == 0) ASSERT_LT(weight, 0.12) << name << ' ' << frame;
      }
    }
  }
  // 80 ms before the first sign until 20 ms after the last one.
  std::set<std::int64_t> begins, ends;
  for (const Annotation& sign : tier(made, "GlossR").annotations) {
    begins.insert(sign.span.begin.count());
    ends.insert(sign.span.end.count());
  }
  for (const Annotation& one : brows) {
    EXPECT_TRUE(begins.contains(one.span.begin.count() + 80)) << one.span.begin.count();
    EXPECT_TRUE(ends.contains(one.span.end.count() - 20)) << one.span.end.count();
  }
}

TEST(ChannelRecordings, MouthWordsWithinTheirSpansOnly) {
  const SyntheticRecording& made = made_visage();
  std::vector<bool> mouthed(static_cast<std::size_t>(made.motion.frame_count()));
  std::set<std::string> words;
  for (const Annotation& one : tier(made, "Mouthing").annotations) {
    const FrameRange span = frames(one.span);
    words.insert(one.label);
    std::map<std::string, double> most;
    double least_jaw_when_pressed = 1;
    for (std::int64_t frame = span.begin; frame < span.end; ++frame) {
      mouthed[static_cast<std::size_t>(frame)] = true;
      for (const char* name : {"jawOpen", "mouthPucker", "mouthPressLeft", "mouthFunnel"}) {
        most[name] = std::max(most[name], at(track(made, name), frame));
      }
      if (at(track(made, "mouthPressLeft"), frame) > 0.8) {
        least_jaw_when_pressed = std::min(least_jaw_when_pressed, at(track(made, "jawOpen"), frame));
      }
    }
    const bool labial = one.label.find_first_of("bBpPmM") != std::string::npos;
    EXPECT_EQ(most["mouthPressLeft"] > 0.8, labial) << one.label;
    if (labial) EXPECT_LT(least_jaw_when_pressed, 0.1) << one.label;
    const bool pursed = one.label.find("ou") != std::string::npos || one.label == "où";
    if (pursed) EXPECT_GT(most["mouthPucker"], 0.6) << one.label;
    EXPECT_GT(std::max(most["jawOpen"], most["mouthPucker"]), 0.25) << one.label;
  }
  EXPECT_GE(words.size(), 18U);
  EXPECT_TRUE(words.contains("Marseille") && words.contains("météo"));
  for (std::int64_t frame = 0; frame < made.motion.frame_count(); ++frame) {
    if (mouthed[static_cast<std::size_t>(frame)]) continue;
    for (const char* name : {"jawOpen", "mouthPucker", "mouthPressLeft", "mouthFunnel", "mouthStretchLeft"}) {
      ASSERT_LT(at(track(made, name), frame), 0.05) << name << ' ' << frame;
    }
  }
}

double head_yaw(const SyntheticRecording& made, std::int64_t frame) {
  const PosedSigner posed(made, frame);
  const Vector3f facing = posed.pose.rotations[static_cast<std::size_t>(posed.signer.head)] * Vector3f::UnitZ();
  return std::atan2(static_cast<double>(facing.x()), static_cast<double>(facing.z()));
}

TEST(ChannelRecordings, ShakeTheHeadWithinTheirSpansOnly) {
  const SyntheticRecording& made = made_visage();
  // Turns of the head by 5 degrees or more.
  const auto turns = [&](FrameRange span) {
    int count = 0;
    double extreme = head_yaw(made, span.begin);
    int direction = 1;
    for (std::int64_t frame = span.begin; frame < span.end; ++frame) {
      const double yaw = head_yaw(made, frame);
      if (direction * (extreme - yaw) > 0.087) {
        direction = -direction;
        extreme = yaw;
        ++count;
      }
      extreme = direction > 0 ? std::max(extreme, yaw) : std::min(extreme, yaw);
    }
    return count;
  };
  std::int64_t past = 0;
  int shakes = 0;
  for (const Annotation& one : tier(made, "Head").annotations) {
    if (one.label != "shake") continue;
    const FrameRange span = frames(one.span);
    EXPECT_LE(turns({past, span.begin}), 5) << span.begin;  // glances
    EXPECT_GE(turns(span), 4) << span.begin;
    past = span.end;
    ++shakes;
  }
  EXPECT_EQ(shakes, 2);
}

TEST(ChannelRecordings, LookAsideWithinTheirSpansOnly) {
  const SyntheticRecording& made = made_visage();
  const auto yaw = [&](std::int64_t frame) {
    return 35 * (at(track(made, "eyeLookOutLeft"), frame) - at(track(made, "eyeLookInLeft"), frame));
  };
  std::vector<int> aside(static_cast<std::size_t>(made.motion.frame_count()));
  std::set<std::string> directions;
  for (const Annotation& one : tier(made, "Gaze").annotations) {
    const FrameRange span = frames(one.span);
    directions.insert(one.label);
    for (std::int64_t frame = span.begin - 30; frame < span.end + 30; ++frame) {
      const bool inside = frame >= span.begin + 12 && frame < span.end - 12;
      aside[static_cast<std::size_t>(frame)] = inside ? (one.label == "left" ? 1 : -1) : 2;
    }
  }
  EXPECT_EQ(directions, (std::set<std::string>{"left", "right"}));
  for (std::int64_t frame = 0; frame < made.motion.frame_count(); ++frame) {
    const int direction = aside[static_cast<std::size_t>(frame)];
    if (std::abs(direction) == 1) {
      ASSERT_GT(direction * yaw(frame), 10) << frame;
    } else if (direction == 0) {
      ASSERT_LT(std::abs(yaw(frame)), 18) << frame;  // a shaken head, and the eyes stay on the viewer
    }
  }
}

TEST(ChannelRecordings, BlinkAtBoundariesOnly) {
  for (const SyntheticRecording* made : all_made()) {
    const std::vector<float>& lids = track(*made, "eyeBlinkLeft");
    std::int64_t past = 0;
    for (const Annotation& one : tier(*made, "Blink").annotations) {
      const FrameRange span = frames(one.span);
      for (std::int64_t frame = past; frame < span.begin; ++frame) ASSERT_LT(at(lids, frame), 0.5) << frame;
      double most = 0;
      for (std::int64_t frame = span.begin; frame < span.end; ++frame) most = std::max(most, at(lids, frame));
      EXPECT_GT(most, 0.95) << made->name << ' ' << span.begin;
      past = span.end;
    }
    EXPECT_GE(tier(*made, "Blink").annotations.size(), made->name == "mains" ? 7U : 11U);
  }
}

TEST(ChannelRecordings, AreTheSameForTheSameSeed) {
  const SyntheticRecording again = make_channels(visage(), kRate, 1);
  EXPECT_EQ(again.document, made_visage().document);
  EXPECT_EQ(again.truth, made_visage().truth);
  EXPECT_EQ(again.motion.tracks(), made_visage().motion.tracks());
  EXPECT_NE(make_channels(visage(), kRate, 2).truth, made_visage().truth);
}

}  // namespace
}  // namespace signweave::demo
