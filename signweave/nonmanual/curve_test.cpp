#include "signweave/nonmanual/curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "signweave/core/error.h"
#include "signweave/core/test_allocations.h"
#include "signweave/motion/degree.h"
#include "signweave/nonmanual/channel.h"
#include "signweave/nonmanual/expressions.h"
#include "signweave/nonmanual/gaze.h"
#include "signweave/nonmanual/mouthing/mouthing.h"

namespace signweave {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;

constexpr FrameRate kRate{50, 1};

/// The values of some tracks over a window of frames, each constant before a curve is applied.
class Face {
 public:
  Face(FrameRange window, std::vector<std::pair<std::string, float>> captured) : window_(window) {
    for (auto& [name, value] : captured) {
      names_.push_back(name);
      values_.emplace_back(static_cast<std::size_t>(window.size()), value);
    }
  }
  Face& with(const Curve& curve, FrameRange at, FrameRate rate = kRate) {
    std::vector<TrackSpan> spans;
    for (std::size_t i = 0; i < names_.size(); ++i) spans.push_back({names_[i], values_[i]});
    apply(curve, at, rate, window_, spans);
    return *this;
  }
  const std::vector<float>& operator[](std::string_view name) const {
    return values_[static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin())];
  }
  const std::vector<std::vector<float>>& values() const { return values_; }

 private:
  FrameRange window_;
  std::vector<std::string> names_;
  std::vector<std::vector<float>> values_;
};

Curve brow(float weight) {
  return {.name = "brow", .onset = 80ms, .offset = 40ms, .weights = {{"browInnerUp", weight}}};
}

/// A curve of every kind.
std::vector<Curve> all_kinds() {
  std::vector<Curve> all;
  for (const NamedExpression& one : built_in_expressions()) all.push_back(one.curve);
  all.push_back(gaze_at({.yaw = 30, .pitch = -10}, "gaze"));
  all.push_back(mouthing_over("papa", phones_of_ipa("papaʃysi"), {100ms, 700ms}).curve);
  return all;
}

std::vector<std::pair<std::string, float>> captured_face() {
  std::vector<std::pair<std::string, float>> tracks;
  for (const char* name :
       {"browInnerUp",    "browDownLeft",   "browDownRight",   "browOuterUpLeft", "eyeWideLeft", "eyeSquintLeft",
        "eyeBlinkLeft",   "eyeBlinkRight",  "cheekPuff",       "jawOpen",         "mouthPucker", "mouthFunnel",
        "mouthPressLeft", "mouthRollUpper", "mouthShrugUpper", "mouthSmileLeft",  "tongueOut",   "eyeLookInLeft",
        "eyeLookOutLeft", "leftEyeYaw",     "headYaw",         "somethingElse"}) {
    tracks.emplace_back(name, 0.25f);
  }
  return tracks;
}

TEST(Curve, RisesStaysAndFallsSmoothly) {
  const Face face = Face({0, 14}, {{"browInnerUp", 0}}).with(brow(0.8f), {2, 12});
  const std::vector<float>& w = face["browInnerUp"];
  EXPECT_THAT(std::vector(w.begin(), w.begin() + 3), Each(0.0f));
  EXPECT_FLOAT_EQ(w[4], 0.4f);  // the middle of four frames of onset
  EXPECT_THAT(std::vector(w.begin() + 6, w.begin() + 11), Each(0.8f));
  EXPECT_FLOAT_EQ(w[11], 0.4f);
  EXPECT_THAT(std::vector(w.begin() + 12, w.end()), Each(0.0f));
}

TEST(Curve, ReachesItsPeakInTheShortestSpan) {
  for (std::int64_t frames = 1; frames < 8; ++frames) {
    const Face face = Face({0, 10}, {{"browInnerUp", 0}}).with(brow(0.8f), {1, 1 + frames});
    EXPECT_FLOAT_EQ(std::ranges::max(face["browInnerUp"]), 0.8f) << frames;
  }
  EXPECT_THAT(Face({0, 4}, {{"browInnerUp", 0}}).with(brow(0.8f), {2, 2})["browInnerUp"], Each(0.0f));
}

TEST(Curve, BrowsTakeTheLargerValue) {
  EXPECT_FLOAT_EQ(Face({0, 9}, {{"browInnerUp", 0.9f}}).with(brow(0.8f), {0, 9})["browInnerUp"][5], 0.9f);
  EXPECT_FLOAT_EQ(Face({0, 9}, {{"browInnerUp", 0.3f}}).with(brow(0.8f), {0, 9})["browInnerUp"][5], 0.8f);
}

TEST(Curve, TheMouthAddsUpToOne) {
  const Curve puff = find_expression(built_in_expressions(), "puff").curve;
  EXPECT_FLOAT_EQ(Face({0, 40}, {{"cheekPuff", 0.1f}}).with(puff, {0, 40})["cheekPuff"][20], 0.9f);
  EXPECT_FLOAT_EQ(Face({0, 40}, {{"cheekPuff", 0.7f}}).with(puff, {0, 40})["cheekPuff"][20], 1.0f);
}

TEST(Curve, OppositeMovementsSubtract) {
  const Face face =
      Face({0, 9}, {{"browInnerUp", 0}, {"browDownLeft", 0.9f}, {"browDownRight", 0.5f}, {"jawOpen", 0.5f}})
          .with(brow(0.8f), {0, 9});
  EXPECT_NEAR(face["browDownLeft"][5], 0.1f, 1e-6f);
  EXPECT_FLOAT_EQ(face["browDownRight"][5], 0.0f);
  EXPECT_FLOAT_EQ(face["jawOpen"][5], 0.5f);
}

TEST(Curve, ReplacingLeavesNothingOfItsChannels) {
  Curve curve = brow(0.2f);
  curve.merge = Merge::replace;
  const Face face =
      Face({0, 9}, {{"browInnerUp", 0.9f}, {"eyeSquintLeft", 0.9f}, {"eyeBlinkLeft", 0.9f}}).with(curve, {0, 9});
  EXPECT_FLOAT_EQ(face["browInnerUp"][5], 0.2f);
  EXPECT_FLOAT_EQ(face["eyeSquintLeft"][5], 0.0f);
  EXPECT_FLOAT_EQ(face["eyeBlinkLeft"][5], 0.9f);
}

TEST(Curve, AMouthingReplacesTheMouthOnly) {
  const TimedCurve mouthing = mouthing_over("a", phones_of_ipa("a"), {200ms, 400ms});
  const Face face =
      Face({0, 60}, {{"mouthShrugUpper", 0.7f}, {"jawOpen", 0}, {"browInnerUp", 0.7f}}).with(mouthing.curve, {10, 30});
  EXPECT_FLOAT_EQ(face["mouthShrugUpper"][20], 0.0f);
  EXPECT_NEAR(face["jawOpen"][20], 0.6f, 0.01f);
  EXPECT_THAT(face["browInnerUp"], Each(0.7f));
}

RC_GTEST_PROP(Curve, GivesTheSameBitsInAnyWindow, ()) {
  const std::vector<Curve> curves = all_kinds();
  const Curve& curve = curves[*rc::gen::inRange<std::size_t>(0, curves.size())];
  const FrameRange at{*rc::gen::inRange<std::int64_t>(-20, 60), 0};
  const FrameRange covered{at.begin, at.begin + *rc::gen::inRange<std::int64_t>(0, 90)};
  const FrameRate rate{*rc::gen::element<std::int64_t>(24, 30, 50, 120), 1};
  const Face whole = Face({0, 120}, captured_face()).with(curve, covered, rate);
  const std::int64_t begin = *rc::gen::inRange<std::int64_t>(0, 119);
  const std::int64_t end = *rc::gen::inRange<std::int64_t>(begin + 1, 121);
  const Face part = Face({begin, end}, captured_face()).with(curve, covered, rate);
  for (std::size_t track = 0; track < whole.values().size(); ++track) {
    for (std::int64_t frame = begin; frame < end; ++frame) {
      RC_ASSERT(part.values()[track][static_cast<std::size_t>(frame - begin)] ==
                whole.values()[track][static_cast<std::size_t>(frame)]);
    }
  }
}

TEST(Curve, KeepsWhatItDoesNotConcern) {
  for (const Curve& curve : all_kinds()) {
    const Face face = Face({0, 60}, captured_face()).with(curve, {10, 50});
    EXPECT_THAT(face["somethingElse"], Each(0.25f)) << curve.name;
    EXPECT_THAT(face["headYaw"], Each(0.25f)) << curve.name;
    for (const std::vector<float>& values : face.values()) {
      EXPECT_EQ(values[9], 0.25f) << curve.name;
      EXPECT_EQ(values[50], 0.25f) << curve.name;
      EXPECT_THAT(values, Each(testing::AllOf(Ge(-1.0f), Le(1.0f)))) << curve.name;
    }
  }
}

TEST(Curve, NeedsTheTracksThatItChanges) {
  for (const Curve& curve : all_kinds()) {
    for (const std::string& track : tracks_of(curve)) {
      const std::vector<float> values = Face({0, 60}, {{track, 0.5f}}).with(curve, {0, 60})[track];
      EXPECT_TRUE(channel_of_track(track)) << track;
      const bool moved = std::ranges::any_of(values, [](float value) { return value != 0.5f; });
      const bool by_gaze = track.starts_with("eyeLook");
      EXPECT_TRUE(moved || by_gaze || curve.merge == Merge::usual) << curve.name << ' ' << track;
    }
  }
  EXPECT_THAT(tracks_of(brow(1)), ElementsAre("browInnerUp"));
}

TEST(Curve, DoesNotAllocate) {
  const std::vector<Curve> curves = all_kinds();
  std::vector<float> values(60, 0.2f);
  std::vector<TrackSpan> spans;
  for (const char* name : {"jawOpen", "browInnerUp", "eyeLookInLeft", "mouthPressLeft"})
    spans.push_back({name, values});
  EXPECT_EQ(allocations_in([&] {
              for (const Curve& curve : curves) {
                apply(curve, {5, 50}, kRate, {0, 60}, spans);
                for (std::int64_t frame = 0; frame < 60; ++frame) head_rotation(curve, {5, 50}, kRate, frame);
              }
            }),
            0U);
}

TEST(HeadRotation, TurnsAboutTheSignersAxes) {
  const auto turned = [](HeadAngles turn, const Eigen::Vector3f& what) {
    const Curve curve{.name = "h", .weights = {}, .head = {.turn = turn, .swing = {}}};
    return Eigen::Vector3f(head_rotation(curve, {0, 100}, kRate, 50) * what);
  };
  const Eigen::Vector3f left(1, 0, 0);
  const Eigen::Vector3f up(0, 1, 0);
  const Eigen::Vector3f forward(0, 0, 1);
  EXPECT_GT(turned({.pitch = 10}, forward).y(), 0.1f);  // the face looks up
  EXPECT_GT(turned({.yaw = 10}, forward).x(), 0.1f);    // to the left
  EXPECT_GT(turned({.roll = 10}, up).x(), 0.1f);        // the crown goes to the left
  EXPECT_LT(turned({.roll = 10}, left).y(), -0.1f);
  EXPECT_NEAR(turned({.yaw = 10}, forward).x(), std::sin(10 * kDegree), 1e-5f);
}

TEST(HeadRotation, IsTheIdentityOutsideAndWithoutAMovement) {
  const Curve neg = find_expression(built_in_expressions(), "neg").curve;
  for (const std::int64_t frame : {-1, 9, 10, 60, 61}) {
    EXPECT_EQ(head_rotation(neg, {10, 60}, kRate, frame).coeffs(), Eigen::Quaternionf::Identity().coeffs()) << frame;
  }
  EXPECT_EQ(head_rotation(brow(1), {10, 60}, kRate, 30).coeffs(), Eigen::Quaternionf::Identity().coeffs());
}

TEST(HeadRotation, AShakeSwingsAtItsFrequency) {
  const Curve neg = find_expression(built_in_expressions(), "neg").curve;
  int crossings = 0;
  float most = 0;
  float last = 0;
  for (std::int64_t frame = 1; frame < 200; ++frame) {
    const Eigen::Vector3f ahead = head_rotation(neg, {0, 200}, kRate, frame) * Eigen::Vector3f::UnitZ();
    const float yaw = std::asin(ahead.x()) / kDegree;
    if (std::abs(yaw) > 0.1f) {
      if (last != 0 && yaw * last < 0) ++crossings;
      last = yaw;
    }
    most = std::max(most, std::abs(yaw));
  }
  EXPECT_NEAR(most, 8, 0.2);
  EXPECT_NEAR(crossings, 19, 1);  // 2.5 Hz over 4 s, two a period
}

TEST(Check, NamesWhatIsWrong) {
  const auto fault = [](auto change) {
    Curve curve = brow(0.5f);
    curve.mouth = {{.viseme = Viseme::aa, .at = 10ms}, {.viseme = Viseme::pp, .at = 20ms}};
    check(curve, "score.json");
    change(curve);
    try {
      check(curve, "score.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(fault([](Curve& c) { c.amount = NAN; }),
            "score.json: non-manual 'brow': the amount is nan; give one from 0 to 1");
  EXPECT_THAT(fault([](Curve& c) { c.onset = -1ms; }), HasSubstr("the onset is -1 ms"));
  EXPECT_THAT(fault([](Curve& c) {
                c.weights[0].track = "brow";
                c.weights[0].weight = 2;
              }),
              HasSubstr("brow is 2"));
  EXPECT_THAT(fault([](Curve& c) { c.weights[0].track = "tail\nWag"; }), HasSubstr("'tail\\x0aWag' is not a weight"));
  EXPECT_THAT(fault([](Curve& c) { c.weights[0].track = "headYaw"; }), HasSubstr("not a weight of the face"));
  EXPECT_THAT(fault([](Curve& c) { c.weights.push_back(c.weights[0]); }), HasSubstr("occurs twice"));
  EXPECT_THAT(fault([](Curve& c) { c.weights.resize(100); }), HasSubstr("100 weights, and 64 is the most"));
  EXPECT_THAT(fault([](Curve& c) { c.head.turn.yaw = 99; }), HasSubstr("head's yaw in degrees is 99"));
  EXPECT_THAT(fault([](Curve& c) { c.head.hertz = -1; }), HasSubstr("swings per second"));
  EXPECT_THAT(fault([](Curve& c) { c.mouth[1].at = 5ms; }), HasSubstr("out of order"));
  EXPECT_THAT(fault([](Curve& c) { c.mouth[1].viseme = static_cast<Viseme>(40); }), HasSubstr("does not exist"));
  EXPECT_THAT(fault([](Curve& c) { c.gaze = {.yaw = 900}; }), HasSubstr("gaze's yaw"));
  EXPECT_THAT(fault([](Curve& c) { c.merge = static_cast<Merge>(9); }), HasSubstr("merge"));
  for (const Curve& curve : all_kinds()) EXPECT_NO_THROW(check(curve, "x")) << curve.name;
}

}  // namespace
}  // namespace signweave
