#include "signweave/inflection/aim.h"

#include <gtest/gtest.h>

#include <random>

#include "signweave/core/error.h"
#include "signweave/inflection/test_stroke.h"

namespace signweave {
namespace {

using Eigen::Vector3f;
using testing_inflection::kRight;
using testing_inflection::outward;
using testing_inflection::right_alone;
using testing_inflection::Stroke;

float azimuth_of(const Vector3f& point) {
  return angles_of(point).azimuth;
}

TEST(Aim, AVerbEndsAtTheAzimuthOfItsObject) {
  Stroke stroke(right_alone(outward));
  for (const char* to : {"front", "left", "right", "-20", "25/15"}) {
    const Aimed aimed = aim_stroke(stroke.changer, stroke.captured, SpaceRole::forward, {.to = stroke.locus(to)}, {});
    EXPECT_EQ(aimed.fitted.share, 1) << to << ": " << aimed.fitted.why;
    EXPECT_LT(aimed.end_missed, 0.002f) << to;
    const auto changed = stroke.changed(aimed.fitted.change);
    const Vector3f end = stroke.hand(*changed, Stroke::kCore.end - 1, Side::right).palm;
    EXPECT_NEAR(azimuth_of(end), azimuth_of(stroke.locus(to).at), 3) << to;
    const Vector3f begin = stroke.hand(*changed, Stroke::kCore.begin, Side::right).palm;
    EXPECT_LT((begin - stroke.captured.first(Side::right).palm).norm(), 0.002f) << to;
  }
}

TEST(Aim, ABackwardVerbGoesInTheOtherDirection) {
  Stroke stroke(right_alone([](float t) { return outward(1 - t); }));
  EXPECT_EQ(guessed_role(stroke.captured, stroke.changer), SpaceRole::backward);
  const Aimed aimed = aim_stroke(stroke.changer, stroke.captured, SpaceRole::backward,
                                 {.from = stroke.locus("self"), .to = stroke.locus("left")}, {});
  const auto changed = stroke.changed(aimed.fitted.change);
  EXPECT_NEAR(azimuth_of(stroke.hand(*changed, Stroke::kCore.begin, Side::right).palm), 45, 3) << aimed.fitted.why;
  EXPECT_LT(
      (stroke.hand(*changed, Stroke::kCore.end - 1, Side::right).palm - stroke.captured.last(Side::right).palm).norm(),
      0.002f);
}

TEST(Aim, TheIndexFingerPointsAtItsLocus) {
  Stroke stroke(right_alone(outward));
  for (const char* at : {"front", "right", "left", "addressee", "-60/10", "20/-20", "30/20/3"}) {
    const Aimed aimed = aim_stroke(stroke.changer, stroke.captured, SpaceRole::aim, {.at = stroke.locus(at)}, {});
    if (aimed.fitted.share == 1 && true) {
      EXPECT_LT(aimed.aim_error, 0.5f) << at;
    } else {
      ADD_FAILURE() << at << " " << aimed.aim_error << " " << aimed.fitted.share << " " << aimed.fitted.relief << " "
                    << aimed.fitted.why;
    }
  }
}

TEST(Aim, AnEndOnTheBodyStaysThere) {
  Stroke stroke(right_alone(
      [](float t) -> Vector3f { return testing_person::at_chin(Side::right, 0) + Vector3f(0, -0.15f * t, 0.2f * t); }));
  const CapturedStroke::Sample& first = stroke.captured.samples.front();
  ASSERT_TRUE(has(first.touched[kRight], Contact::head));
  const Aimed aimed = aim_stroke(stroke.changer, stroke.captured, SpaceRole::forward,
                                 {.from = stroke.locus("left"), .to = stroke.locus("right")}, {});
  const auto changed = stroke.changed(aimed.fitted.change);
  EXPECT_LT((stroke.hand(*changed, Stroke::kCore.begin, Side::right).palm - first.hands[kRight].palm).norm(), 1e-3f);
  EXPECT_NEAR(azimuth_of(stroke.hand(*changed, Stroke::kCore.end - 1, Side::right).palm), -45, 4) << aimed.fitted.why;
}

TEST(Aim, NothingIsBeyondLimitsOrInTheBodyWhereverItIsAimed) {
  Stroke stroke(right_alone(outward));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> azimuth(-110, 110), elevation(-60, 60), distance(0.3f, 4);
  HandMeter meter(*stroke.person.skeleton, stroke.rig->signer);
  const Motion before = stroke.all(*stroke.source);
  const PosesView core = view_of(before, Stroke::kCore);
  const HandDepths captured = meter.deepest(core, Side::right);
  int reached = 0;
  for (int i = 0; i < 300; ++i) {
    const Locus locus{.at = point_of({azimuth(random), elevation(random), distance(random)})};
    const Aimed aimed = i % 2 == 0 ? aim_stroke(stroke.changer, stroke.captured, SpaceRole::aim, {.at = locus}, {})
                                   : aim_stroke(stroke.changer, stroke.captured, SpaceRole::forward, {.to = locus}, {});
    if (aimed.fitted.share == 1) ++reached;
    const Motion after = stroke.all(*stroke.changed(aimed.fitted.change));
    const HandDepths deep = meter.deepest(view_of(after, Stroke::kCore), Side::right);
    for (std::size_t k = 0; k < deep.size(); ++k) {
      EXPECT_LE(deep[k], std::max(captured[k], 0.0f) + 0.003f) << i;
    }
    for (std::int64_t frame = Stroke::kCore.begin; frame < Stroke::kCore.end; ++frame) {
      stroke.hand(*stroke.source, frame, Side::right);
      const WristLimits limits = widened(human_wrist(), stroke.changer.bend(Side::right));
      stroke.changer.look(after.pose(frame), stroke.captured.space, Side::right);
      const WristBend bend = stroke.changer.bend(Side::right);
      EXPECT_LE(bend.flexion, limits.flexion.most + 0.01f) << i;
      EXPECT_LE(-bend.flexion, limits.extension.most + 0.01f) << i;
      EXPECT_LE(bend.deviation, limits.radial.most + 0.01f) << i;
      EXPECT_LE(-bend.deviation, limits.ulnar.most + 0.01f) << i;
    }
  }
  EXPECT_GT(reached, 150);
}

TEST(Aim, FaultsSayHowToMendThem) {
  Stroke stroke(right_alone(outward));
  const auto why = [&](SpaceRole role, const LociOfSign& wanted) -> std::string {
    try {
      aim_stroke(stroke.changer, stroke.captured, role, wanted, {});
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(why(SpaceRole::forward, {.to = stroke.locus("150")}),
            "a locus at 150° is behind the signer; give one within 110° to either side");
  EXPECT_NE(why(SpaceRole::none, {.to = stroke.locus("left")}).find("without a role"), std::string::npos);
}

}  // namespace
}  // namespace signweave
