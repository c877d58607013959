#pragma once

// For tests: a small body whose joints turn by given functions of time, and gaps cut out of its motion.

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "signweave/transition/learned.h"
#include "signweave/transition/method.h"

namespace signweave::testing_gap {

enum : std::size_t {
  kHips,
  kChest,
  kHead,
  kUpper,
  kFore,
  kHand,
  kFinger,
  kRightUpper,
  kRightFore,
  kRightHand,
  kJoints
};

/// A body with a translated root and both arms.
inline std::shared_ptr<const Skeleton> body(const char* hips = "Hips") {
  return std::make_shared<const Skeleton>(std::vector<Joint>{{hips, kNoJoint, {0, 1, 0}, true},
                                                             {"Chest", 0, {0, 0.3f, 0}, false},
                                                             {"Head", 1, {0, 0.3f, 0}, false},
                                                             {"LeftArm", 1, {0.2f, 0.2f, 0}, false},
                                                             {"LeftForeArm", 3, {0.3f, 0, 0}, false},
                                                             {"LeftHand", 4, {0.25f, 0, 0}, false},
                                                             {"LeftIndex", 5, {0.1f, 0, 0}, false},
                                                             {"RightArm", 1, {-0.2f, 0.2f, 0}, false},
                                                             {"RightForeArm", 7, {-0.3f, 0, 0}, false},
                                                             {"RightHand", 8, {-0.25f, 0, 0}, false}},
                                          std::vector<Tip>{});
}

inline JointGroups groups() {
  using enum JointGroup;
  JointGroups groups;
  groups.of = {body, body, body, left_arm, left_arm, left_arm, left_fingers, right_arm, right_arm, right_arm};
  groups.all = {std::vector<JointIndex>{0, 1, 2}, {3, 4, 5}, {7, 8, 9}, {6}, {}};
  groups.of_translation = {body};
  groups.roles = {JointRole::trunk, JointRole::trunk,     JointRole::other,  JointRole::shoulder,
                  JointRole::elbow, JointRole::other_arm, JointRole::finger, JointRole::shoulder,
                  JointRole::elbow, JointRole::other_arm};
  groups.wrists = {static_cast<JointIndex>(kHand), static_cast<JointIndex>(kRightHand)};
  return groups;
}

using Turn = std::function<Eigen::Quaternionf(std::size_t joint, double seconds)>;
using PositionAt = std::function<Eigen::Vector3f(double seconds)>;

inline Eigen::Quaternionf about(const Eigen::Vector3f& axis, double angle) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(angle), axis.normalized()));
}
/// A different axis for each joint.
inline Eigen::Vector3f axis_of(std::size_t joint) {
  const auto j = static_cast<float>(joint);
  return Eigen::Vector3f(std::sin(1 + j), 0.7f, std::cos(2 * j)).normalized();
}

inline Motion motion_of(FrameRate rate, std::int64_t frames, const Turn& turn, const PositionAt& place = {},
                        std::shared_ptr<const Skeleton> skeleton = body()) {
  Motion motion(std::move(skeleton), rate, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const double seconds = static_cast<double>(frame) / rate.hertz();
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      motion.pose(frame).rotations[joint] = turn(joint, seconds);
    }
    motion.pose(frame).translations[0] = place ? place(seconds) : Eigen::Vector3f(0, 1, 0);
  }
  keep_hemisphere(motion);
  return motion;
}

/// A smooth motion that never repeats; different for each `seed`.
inline Motion lively(double seed, FrameRate rate = {100, 1}, std::int64_t frames = 300,
                     std::shared_ptr<const Skeleton> skeleton = body()) {
  const auto turn = [seed](std::size_t joint, double t) {
    const double phase = seed + 1.7 * static_cast<double>(joint);
    const Eigen::Vector3f wobble(0, 0, static_cast<float>(0.3 * std::sin(1.9 * t + 2 * phase)));
    return about(axis_of(joint) + wobble, 0.7 * std::sin(3.1 * t + phase) + 0.3 * std::sin(5.3 * t + 2 * phase));
  };
  const auto place = [seed](double t) {
    return Eigen::Vector3f(static_cast<float>(0.1 * std::sin(2 * t + seed)), 1, static_cast<float>(0.05 * t));
  };
  return motion_of(rate, frames, turn, place, std::move(skeleton));
}

/// A gap cut out of a motion, with at most `context` frames on either side. Borrows from both arguments.
inline Gap cut(const Motion& motion, const JointGroups& groups, FrameRange frames, std::int64_t context = 1 << 20) {
  return {.skeleton = &motion.skeleton(),
          .groups = &groups,
          .rate = motion.rate(),
          .before = view_of(motion, {std::max<std::int64_t>(0, frames.begin - context), frames.begin}),
          .after = view_of(motion, {frames.end, std::min(motion.frame_count(), frames.end + context)}),
          .count = frames.size()};
}

struct Filled {
  std::vector<Eigen::Quaternionf> rotations;
  std::vector<Eigen::Vector3f> translations;
  std::size_t joints = 0;
  const Eigen::Quaternionf& at(std::int64_t frame, std::size_t joint) const {
    return rotations[static_cast<std::size_t>(frame) * joints + joint];
  }
};
/// Initial value of frames; those that are not filled keep it.
inline const Eigen::Quaternionf kUntouched{7, 7, 7, 7};

inline Filled fill(const GapMethod& method, const Gap& gap, const TransitionModel& model, GapScratch& scratch,
                   GroupSet set = GroupSet::all()) {
  const auto count = static_cast<std::size_t>(gap.count);
  Filled filled{std::vector<Eigen::Quaternionf>(count * gap.before.joints(), kUntouched),
                std::vector<Eigen::Vector3f>(count * gap.before.moved(), Eigen::Vector3f(7, 7, 7)),
                gap.before.joints()};
  method.fill({.gap = gap, .model = model, .groups = set, .scratch = scratch}, {filled.rotations, filled.translations});
  return filled;
}
inline Filled fill(const GapMethod& method, const Gap& gap, const TransitionModel& model,
                   GroupSet set = GroupSet::all()) {
  GapScratch scratch;
  return fill(method, gap, model, scratch, set);
}

/// Angle between two rotations in radians, independent of their signs.
inline double angle(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  return 2.0 * std::atan2((a.conjugate() * b).vec().cast<double>().norm(), std::abs(static_cast<double>(a.dot(b))));
}

template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}
inline bool same_bits(const Filled& a, const Filled& b) {
  return same_bits(a.rotations, b.rotations) && same_bits(a.translations, b.translations);
}

/// The default model with captured spans, so that every method can be tested.
inline std::shared_ptr<const TransitionModel> model_with_spans() {
  static const std::shared_ptr<const TransitionModel> model = [] {
    const JointGroups of = groups();
    SpanCollector collector;
    for (int seed = 0; seed < 4; ++seed) {
      const Motion motion = lively(0.4 + seed);
      for (const std::int64_t begin : {40, 110, 190}) {
        for (const std::int64_t count : {20, 45, 70}) {
          collector.add(cut(motion, of, {begin, begin + count}), view_of(motion, {begin, begin + count}));
        }
      }
    }
    return collector.take_model();
  }();
  return model;
}

/// A model without damping and without learned parameters.
inline const TransitionModel& untaught() {
  static const TransitionModel model;
  return model;
}

}  // namespace signweave::testing_gap
