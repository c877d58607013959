#include "signweave/render/junction.h"

#include <gtest/gtest.h>

#include <cstring>

#include "signweave/motion/motion_source.h"
#include "signweave/render/render.h"
#include "signweave/render/test_signing_person.h"

namespace signweave {
namespace {

using namespace testing_person;

MotionClip clip_of(Motion motion) {
  const std::int64_t frames = motion.frame_count();
  return {.recording = "r",
          .source = std::make_shared<MemorySource>(std::move(motion)),
          .whole = {0, frames},
          .core = {0, frames},
          .clock = {},
          .signs = {}};
}

/// Hands that pass through the head, the trunk and each other if nothing keeps them out.
std::vector<MotionClip> colliding_strokes(const Person& person) {
  const auto crossed = [](Side side, float t) {
    return Eigen::Vector3f(side == Side::left ? -0.1f : 0.1f, 1.2f + 0.05f * t, 0.3f);
  };
  const auto behind = [](Side side, float t) {
    return Eigen::Vector3f(side == Side::left ? 0.35f : -0.35f, 1.3f + 0.05f * t, -0.1f);
  };
  std::vector<MotionClip> clips;
  for (const Person::WristAt& path : {Person::WristAt(in_front), Person::WristAt(crossed), Person::WristAt(behind),
                                      Person::WristAt(together), Person::WristAt(at_chin)}) {
    clips.push_back(clip_of(person.stroke(path)));
  }
  return clips;
}

bool same_joints(const Motion& a, const Motion& b, const JointGroups& of, GroupSet groups) {
  for (std::size_t i = 0; i < a.rotations().size(); ++i) {
    if (!groups.has(of.of[i % of.of.size()])) continue;
    if (std::memcmp(a.rotations()[i].coeffs().data(), b.rotations()[i].coeffs().data(), 4 * sizeof(float)) != 0) {
      return false;
    }
  }
  return true;
}

TEST(JunctionFiller, TheShownJointsAreThoseOfTheWholeBody) {
  const Person person;
  const SignerRig rig{person.signer, person.groups};
  const std::vector<MotionClip> clips = colliding_strokes(person);
  const std::vector<std::int64_t> gaps = {40, 50, 45, 35};
  using enum JointGroup;
  for (const TransitionMethod& method : transition_methods()) {
    const JunctionSettings settings{.skeleton = person.skeleton, .rate = {100, 1}, .method = &method, .rig = &rig};
    const Plan plan = plan_with_gaps(clips, gaps);
    Motion whole;
    Renderer(plan, settings).render({0, plan.frames}, whole);
    for (const GroupSet shown : {GroupSet{left_arm, left_fingers}, GroupSet{right_arm, right_fingers},
                                 GroupSet{left_fingers}, GroupSet{right_fingers}, GroupSet{body}}) {
      Motion made;
      Renderer(plan, settings, shown).render({0, plan.frames}, made);
      EXPECT_TRUE(same_joints(made, whole, person.groups, shown)) << method.name;
    }
  }
}

}  // namespace
}  // namespace signweave
