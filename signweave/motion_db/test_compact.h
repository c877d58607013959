#pragma once

#include <rapidcheck.h>

#include <numbers>

#include "signweave/motion_db/test_motion.h"

namespace signweave::motion_db {

/// The character of a random motion.
enum class Manner { smooth, wild, spinning, still, flipping, far_away, no_rotations };
inline constexpr Manner kManners[] = {Manner::smooth,   Manner::wild,     Manner::spinning,    Manner::still,
                                      Manner::flipping, Manner::far_away, Manner::no_rotations};

/// For tests: a random tree of joints with bones of up to half a metre, some of length 0, and tips.
inline std::shared_ptr<const Skeleton> random_skeleton(std::mt19937& random, int joints) {
  std::uniform_real_distribution<float> length(-0.3f, 0.3f);
  const auto offset = [&]() -> Eigen::Vector3f {
    if (random() % 8 == 0) return Eigen::Vector3f::Zero();
    return {length(random), length(random), length(random)};
  };
  std::vector<Joint> list;
  std::vector<Tip> tips;
  for (int i = 0; i < joints; ++i) {
    // Chains are more frequent than branches.
    const JointIndex parent =
        i == 0 ? kNoJoint : (random() % 3 > 0 ? i - 1 : static_cast<JointIndex>(random() % static_cast<unsigned>(i)));
    list.push_back({.name = "joint", .parent = parent, .offset = offset(), .translated = random() % 5 == 0});
    if (random() % 3 == 0) tips.push_back({.joint = i, .offset = offset()});
  }
  return std::make_shared<const Skeleton>(std::move(list), std::move(tips));
}

/// For tests: a random motion of this manner, in the hemisphere of the previous frame unless it flips.
inline Motion random_motion(std::mt19937& random, int joints, std::int64_t frames, Manner manner) {
  Motion motion(random_skeleton(random, joints), FrameRate{60, 1}, frames);
  std::normal_distribution<float> normal;
  const auto vector = [&] { return Eigen::Vector3f(normal(random), normal(random), normal(random)); };
  const auto turn = [](const Eigen::Vector3f& by) {
    return Eigen::Quaternionf(Eigen::AngleAxisf(by.norm(), by.normalized()));
  };
  const float speed = manner == Manner::spinning ? 1.5f : 0.05f;
  const float distance = manner == Manner::far_away ? 1e5f : 1.0f;
  for (std::size_t joint = 0; joint < motion.skeleton().joint_count(); ++joint) {
    const Eigen::Quaternionf first = turn(vector());
    const Eigen::Vector3f swing = vector();
    const bool holds = manner == Manner::still || random() % 4 == 0;
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      Eigen::Quaternionf& q = motion.pose(frame).rotations[joint];
      const float time = holds ? 0.0f : speed * static_cast<float>(frame);
      q = first * turn(swing * (manner == Manner::spinning ? time : std::sin(time)) + Eigen::Vector3f(1e-6f, 0, 0));
      if (manner == Manner::wild) q = turn(vector());
      if (manner == Manner::flipping && random() % 3 == 0) q.coeffs() *= -1.0f;
      if (manner == Manner::no_rotations && random() % 8 == 0) q.coeffs() *= normal(random);
      if (manner == Manner::no_rotations && random() % 64 == 0) q.coeffs() = {1e-40f, -0.0f, 3e38f, 0};
    }
  }
  for (std::size_t at = 0; at < motion.skeleton().translation_count(); ++at) {
    const Eigen::Vector3f first = distance * vector();
    const Eigen::Vector3f swing = (manner == Manner::still ? 0.0f : 0.2f) * vector();
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      motion.pose(frame).translations[at] = first + swing * std::sin(0.03f * static_cast<float>(frame));
    }
  }
  if (manner != Manner::flipping) keep_hemisphere(motion);
  return motion;
}

/// Any manner, 1 to 12 joints, 1 to 69 frames.
inline Motion any_motion() {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const Manner manner = *rc::gen::elementOf(std::vector(std::begin(kManners), std::end(kManners)));
  return random_motion(random, *rc::gen::inRange(1, 13), *rc::gen::inRange<std::int64_t>(1, 70), manner);
}

}  // namespace signweave::motion_db
