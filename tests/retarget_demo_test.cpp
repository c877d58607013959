// The synthetic signer's recordings on other bodies, compared with the source: one body defined here, and the
// characters built by studio/avatar, if they exist.

#include <gtest/gtest.h>

#include <iostream>

#include "demo/corpus.h"
#include "signweave/retarget/test_character.h"
#include "tests/retarget_figures.h"

namespace signweave {
namespace {

/// The first seconds of a recording of the demo corpus.
Motion recording(std::size_t which, std::int64_t frames) {
  const Motion whole = demo::make_recording(demo::corpus_scripts(2)[which], {100, 1}, 1).motion;
  const std::int64_t count = std::min(frames, whole.frame_count());
  Motion part(whole.shared_skeleton(), whole.rate(), count);
  for (std::int64_t frame = 0; frame < count; ++frame) {
    std::copy(whole.pose(frame).rotations.begin(), whole.pose(frame).rotations.end(),
              part.pose(frame).rotations.begin());
    std::copy(whole.pose(frame).translations.begin(), whole.pose(frame).translations.end(),
              part.pose(frame).translations.begin());
  }
  return part;
}

SignerModel model_in(const Motion& motion) {
  SignerModel signer{.rig = map_rig(motion), .body = {}};
  signer.body = signer_body(motion, signer.rig);
  return signer;
}

void expect_the_same_signing(const std::string& name, const Motion& motion, const Character& character) {
  const SignerModel signer = model_in(motion);
  ASSERT_TRUE(signer.body);
  const Retargeted shown = retarget(motion, signer, character);
  const RetargetFigures figures = measure_retargeting(motion, signer, shown.motion, character);
  std::cout << figures.line(name) << '\n';
  EXPECT_LT(quantile(figures.palm, 1), 5);
  EXPECT_LT(quantile(figures.fingers, 1), 5);
  // Fingertips that nearly touch still do; the distance of a wide open thumb depends on the hand's own proportions.
  if (!figures.pinch.empty()) {
    EXPECT_LT(quantile(figures.pinch, 0.95), 0.06f);
  }
  EXPECT_LT(quantile(figures.thumb, 0.5), 0.08f);
  EXPECT_LT(quantile(figures.held, 0.5), 0.10f);
  EXPECT_LT(quantile(figures.held, 0.95), 0.25f);
  EXPECT_LT(quantile(figures.inside, 1), 0.005f);
  EXPECT_LT(quantile(figures.elbow, 1), 0.12f);
  EXPECT_LT(quantile(figures.step, 1), 25);
}

TEST(RetargetDemo, OnABodyDefinedByHand) {
  const Motion motion = recording(0, 2000);
  // Shorter arms, broader shoulders, hands of another length.
  const auto body = whole_person(0.9f);
  std::vector<Joint> joints(body->joints().begin(), body->joints().end());
  for (Joint& joint : joints) {
    if (joint.name.ends_with("ForeArm") || joint.name.ends_with("Hand")) joint.offset *= 0.92f;
    if (joint.name == "LeftArm" || joint.name == "RightArm") joint.offset *= 1.1f;
  }
  const Character character = character_of(
      std::make_shared<const Skeleton>(joints, std::vector<Tip>(body->tips().begin(), body->tips().end())));
  expect_the_same_signing("made meteo", motion, character);
}

class RetargetDemoCharacter : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Built, RetargetDemoCharacter, testing::Values("woman", "man"),
                         [](const auto& row) { return std::string(row.param); });

TEST_P(RetargetDemoCharacter, ShowsTheSameSigning) {
  const auto path = built_character(GetParam());
  if (!path) {
    std::cout << kNoCharacter << std::endl;
    return;
  }
  const Character character = read_character(*path);
  for (const std::size_t which : {0, 1}) {
    expect_the_same_signing(fmt::format("{} demo {}", GetParam(), which), recording(which, 6000), character);
  }
}

TEST_P(RetargetDemoCharacter, ThePackedFileEqualsThePlainOne) {
  const auto packed = built_character(GetParam());
  const auto plain = built_character(GetParam(), true);
  if (!packed || !plain) {
    std::cout << kNoCharacter << std::endl;
    return;
  }
  const Character a = read_character(*packed);
  const Character b = read_character(*plain);
  ASSERT_EQ(a.skeleton->joint_count(), b.skeleton->joint_count());
  for (std::size_t i = 0; i < a.skeleton->joint_count(); ++i) {
    EXPECT_EQ(a.skeleton->joints()[i].name, b.skeleton->joints()[i].name);
    EXPECT_LT((a.skeleton->joints()[i].offset - b.skeleton->joints()[i].offset).norm(), 1e-5f);
  }
  EXPECT_EQ(a.face_units, b.face_units);
  EXPECT_EQ(a.hand(Side::left).fingers[1].joints, b.hand(Side::left).fingers[1].joints);
}

}  // namespace
}  // namespace signweave
