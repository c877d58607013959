#include "signweave/retarget/body_surface.h"

#include <gtest/gtest.h>

#include "signweave/retarget/test_character.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Vector3f;

struct Body {
  Character character = character_of(whole_person());
  RigAxes axes{*character.skeleton, character.rig};
  BodySurface surface{character, axes};

  Body() { surface.place(to_model_space(*character.skeleton, Pose(*character.skeleton).view())); }
  Vector3f shoulders() const { return 0.5f * (axes.place(Part::left_upper_arm) + axes.place(Part::right_upper_arm)); }
};

TEST(BodySurface, PointsInTheChestMoveOutForwardAndStayOut) {
  const Body body;
  for (int k = -5; k <= 5; ++k) {
    const float x = 0.02f * static_cast<float>(k);
    const Vector3f inside = body.shoulders() + Vector3f(x, -0.15f, 0.10f);
    const Vector3f push = body.surface.push_out(inside, 0.01f);
    EXPECT_GT(push.z(), 0.02f) << x;
    EXPECT_EQ(push.y(), 0) << x;
    EXPECT_LT(body.surface.push_out(inside + push, 0.01f).norm(), 0.004f) << x;
  }
}

TEST(BodySurface, PointsOutsideAreNotMoved) {
  const Body body;
  EXPECT_EQ(body.surface.push_out(body.shoulders() + Vector3f(0, -0.15f, 0.20f), 0.01f).norm(), 0);
  EXPECT_EQ(body.surface.push_out(body.shoulders() + Vector3f(0.3f, -0.15f, 0), 0.01f).norm(), 0);
}

TEST(BodySurface, DisplacementIsContinuous) {
  // The displacement must be continuous: a step of a millimetre changes it by little.
  const Body body;
  Vector3f last = body.surface.push_out(body.shoulders() + Vector3f(0.05f, -0.3f, 0.09f), 0.01f);
  for (int i = 1; i < 400; ++i) {
    const Vector3f now =
        body.surface.push_out(body.shoulders() + Vector3f(0.05f, -0.3f + 0.001f * static_cast<float>(i), 0.09f), 0.01f);
    EXPECT_LT((now - last).norm(), 0.003f) << i;
    last = now;
  }
}

TEST(BodySurface, MovesWithTheTrunk) {
  Body body;
  Pose pose(*body.character.skeleton);
  pose.view().rotations[0] = AngleAxisf(1.57f, Vector3f::UnitY());
  body.surface.place(to_model_space(*body.character.skeleton, pose.view()));
  EXPECT_GT(body.surface.push_out(body.shoulders() + Vector3f(0.10f, -0.15f, 0), 0.01f).x(), 0.02f);
}

}  // namespace
}  // namespace signweave
