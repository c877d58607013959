#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave::defect {
namespace {

// What people reach. A step counts as a jump where it is faster than this *and* so much faster than the steps beside
// it: athletes' limbs come near these speeds, but they take many frames to speed up.
/// Elbow of a professional pitcher, 2,320°/s (Fleisig et al. 1999, J. Biomechanics 32).
constexpr double kFastestLimb = 40;  // rad/s
/// A finger's snap, 7,800°/s (Acharya et al. 2021, J. R. Soc. Interface 18): nothing of a body turns faster.
constexpr double kFastestTurn = 136;  // rad/s
/// To turn so much for one frame alone takes this much to speed up and again to slow down. (ours)
constexpr double kHardestTurn = 2'500;  // rad/s²
/// The hand of an Olympic boxer has 9.1 ± 2.1 m/s (Walilko, Viano, Bir 2005, Br. J. Sports Med. 39), a sprinter at
/// best 12.3 (Graubner and Nixdorf 2011, New Studies in Athletics 26).
constexpr double kFastestPoint = 12.3;  // m/s
/// A body's middle that starts and stops within a frame: 50 times gravity. (ours)
constexpr double kHardestShift = 500;    // m/s²
constexpr float kLeastShift = 0.03f;     // metres
constexpr float kLeastTurn = 0.1f;       // radians: less is noise at any rate
constexpr std::int64_t kTogether = 3;    // frames: jumps so near are one
constexpr std::size_t kWholeBody = 6;    // joints that jump at once
constexpr double kWholeBodyShare = 0.2;  // of all, likewise

float angle_between(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) noexcept {
  const float cosine = std::min(1.0f, std::abs(a.dot(b)));
  return 2 * std::acos(cosine);
}

/// How far the farthest point of what a joint carries is at most: along the bones.
std::vector<float> reaches(const Skeleton& skeleton) {
  std::vector<float> reach(skeleton.joint_count(), 0.0f);
  for (const Tip& tip : skeleton.tips()) {
    float& of = reach[static_cast<std::size_t>(tip.joint)];
    of = std::max(of, tip.offset.norm());
  }
  for (std::size_t i = skeleton.joint_count(); i-- > 1;) {
    const Joint& joint = skeleton.joints()[i];
    float& of = reach[static_cast<std::size_t>(joint.parent)];
    of = std::max(of, reach[i] + joint.offset.norm());
  }
  return reach;
}

}  // namespace

JumpWatch::JumpWatch(const Motion& motion)
    : motion_(motion),
      hertz_(motion.rate().hertz()),
      reach_(reaches(motion.skeleton())),
      carried_(motion.skeleton().joint_count()) {
  for (Steps& steps : ring_) {
    steps.turns.resize(motion.skeleton().joint_count());
    steps.shifts.resize(motion.skeleton().translation_count());
  }
  for (std::size_t i = 1; i < carried_.size(); ++i) {
    carried_[static_cast<std::size_t>(motion.skeleton().joints()[i].parent)].push_back(static_cast<JointIndex>(i));
  }
}

void JumpWatch::see(std::int64_t frame) {
  seen_ = frame + 1;
  if (frame == 0) return;
  const PoseView before = motion_.pose(frame - 1);
  const PoseView now = motion_.pose(frame);
  Steps& steps = ring_[static_cast<std::size_t>(frame % kRing)];
  float most = 0;
  for (std::size_t i = 0; i < steps.turns.size(); ++i) {
    const bool same = before.rotations[i].coeffs() == now.rotations[i].coeffs();
    steps.turns[i] = same ? 0 : angle_between(before.rotations[i], now.rotations[i]);
    most = std::max(most, same ? 0.0f : 1.0f);
  }
  for (std::size_t i = 0; i < steps.shifts.size(); ++i) {
    steps.shifts[i] = (now.translations[i] - before.translations[i]).norm();
    most = std::max(most, steps.shifts[i]);
  }
  steps.repeated = most == 0;
  if (frame >= 3) judge(frame - 2);
}

/// The larger of the steps on both sides. Of a step there and back again the other half is passed over.
template <typename Distance>
float JumpWatch::around(std::int64_t frame, std::vector<float> Steps::*what, std::size_t index,
                        const Distance& distance) const {
  constexpr float kBack = 0.3f;  // of the step: that near is back
  const auto step = [&](std::int64_t into_frame) {
    return into_frame >= 1 && into_frame < seen_ ? (into(into_frame).*what)[index] : 0.0f;
  };
  const float own = step(frame);
  const auto beside = [&](std::int64_t next, std::int64_t beyond, std::int64_t a, std::int64_t b) {
    const bool inside = a >= 0 && b < seen_;
    return inside && step(next) > 0.5f * own && distance(a, b) < kBack * own ? step(beyond) : step(next);
  };
  return std::max(beside(frame - 1, frame - 2, frame - 2, frame), beside(frame + 1, frame + 2, frame - 1, frame + 1));
}

/// How far from the axis of a turn the farthest joint or tip is that it carries, metres.
float JumpWatch::lever(std::int64_t frame, JointIndex joint) {
  if (model_of_ != frame) to_model_space(motion_.skeleton(), motion_.pose(frame), model_);
  model_of_ = frame;
  const auto j = static_cast<std::size_t>(joint);
  const Eigen::Quaternionf turn = motion_.pose(frame - 1).rotations[j].conjugate() * motion_.pose(frame).rotations[j];
  const Eigen::Vector3f axis = model_.rotations[j] * turn.vec().normalized();
  float most = 0;
  std::vector<JointIndex> open = {joint};
  while (!open.empty()) {
    const JointIndex at = open.back();
    open.pop_back();
    most = std::max(most, axis.cross(model_.positions[static_cast<std::size_t>(at)] - model_.positions[j]).norm());
    open.insert(open.end(), carried_[static_cast<std::size_t>(at)].begin(),
                carried_[static_cast<std::size_t>(at)].end());
    for (const Tip& tip : motion_.skeleton().tips()) {
      if (tip.joint == at) most = std::max(most, axis.cross(position_of(tip, model_) - model_.positions[j]).norm());
    }
  }
  return most;
}

void JumpWatch::judge(std::int64_t frame) {
  const Steps& steps = into(frame);
  // Where a frame was written twice for want of a new one, the next step is that of both.
  double hertz = hertz_;
  for (std::int64_t before = frame - 1; before >= std::max<std::int64_t>(1, frame - 2) && into(before).repeated;
       --before) {
    hertz = hertz_ / static_cast<double>(frame - before + 1);
  }
  for (std::size_t i = 0; i < steps.turns.size(); ++i) {
    const float step = steps.turns[i];
    const double speed = static_cast<double>(step) * hertz;
    if (step < kLeastTurn || (speed < kFastestLimb && speed * static_cast<double>(reach_[i]) < kFastestPoint)) continue;
    const float beside = around(frame, &Steps::turns, i, [&](std::int64_t a, std::int64_t b) {
      return angle_between(motion_.pose(a).rotations[i], motion_.pose(b).rotations[i]);
    });
    const double excess = static_cast<double>(step - beside) * hertz;
    const bool turns = excess > kFastestLimb && excess * hertz > kHardestTurn;
    if (turns || speed > kFastestTurn ||
        (excess * static_cast<double>(reach_[i]) > kFastestPoint &&
         excess * static_cast<double>(lever(frame, static_cast<JointIndex>(i))) > kFastestPoint)) {
      jumps_.push_back({frame, static_cast<JointIndex>(i), true, step, beside});
    }
  }
  for (std::size_t i = 0; i < steps.shifts.size(); ++i) {
    const float step = steps.shifts[i];
    const double speed = static_cast<double>(step) * hertz;
    if (step < kLeastShift || speed * hertz < kHardestShift) continue;
    const float beside = around(frame, &Steps::shifts, i, [&](std::int64_t a, std::int64_t b) {
      return (motion_.pose(a).translations[i] - motion_.pose(b).translations[i]).norm();
    });
    const double excess = static_cast<double>(step - beside) * hertz;
    if (speed > kFastestPoint || (excess * hertz > kHardestShift && step - beside > kLeastShift)) {
      jumps_.push_back({frame, motion_.skeleton().translated_joints()[i], false, step, beside});
    }
  }
}

std::vector<Defect> JumpWatch::found() {
  for (std::int64_t frame = std::max<std::int64_t>(1, seen_ - 2); frame < seen_; ++frame) judge(frame);
  std::vector<Defect> result;
  // Many joints at once: the motion goes on elsewhere. Said once.
  const std::size_t many =
      std::max(kWholeBody, static_cast<std::size_t>(kWholeBodyShare * static_cast<double>(reach_.size())));
  std::vector<Jump> single;
  for (std::size_t i = 0; i < jumps_.size();) {
    std::size_t end = i;
    while (end < jumps_.size() && jumps_[end].frame == jumps_[i].frame) ++end;
    if (end - i >= many) {
      const auto fastest = std::max_element(
          jumps_.begin() + static_cast<std::ptrdiff_t>(i), jumps_.begin() + static_cast<std::ptrdiff_t>(end),
          [](const Jump& a, const Jump& b) { return a.turns != b.turns ? b.turns : a.step < b.step; });
      result.push_back({.kind = DefectKind::jump,
                        .frames = {jumps_[i].frame, jumps_[i].frame + 1},
                        .value = static_cast<float>(static_cast<double>(fastest->step) * hertz_),
                        .text = fmt::format("{} joints jump at once, {} by {:.0f}°: a cut, or frames are missing",
                                            end - i, printable(motion_.skeleton().joint(fastest->joint).name),
                                            static_cast<double>(fastest->step) * 180 / std::numbers::pi)});
    } else {
      single.insert(single.end(), jumps_.begin() + static_cast<std::ptrdiff_t>(i),
                    jumps_.begin() + static_cast<std::ptrdiff_t>(end));
    }
    i = end;
  }
  std::stable_sort(single.begin(), single.end(), [](const Jump& a, const Jump& b) {
    return a.joint != b.joint ? a.joint < b.joint : a.turns != b.turns ? a.turns : a.frame < b.frame;
  });
  for (std::size_t i = 0; i < single.size();) {
    std::size_t last = i;
    std::size_t worst = i;
    while (last + 1 < single.size() && single[last + 1].joint == single[i].joint &&
           single[last + 1].turns == single[i].turns && single[last + 1].frame <= single[last].frame + kTogether) {
      ++last;
      if (single[last].step > single[worst].step) worst = last;
    }
    const Jump& jump = single[worst];
    const double speed = static_cast<double>(jump.step) * hertz_;
    const double degrees = static_cast<double>(jump.step) * 180 / std::numbers::pi;
    const double beside = static_cast<double>(jump.around) * (jump.turns ? 180 / std::numbers::pi : 100.0);
    const std::string name = printable(motion_.skeleton().joint(jump.joint).name);
    const std::string text =
        jump.turns ? fmt::format(
                         "{} turns by {:.0f}° in one frame ({:.3g} rad/s), beside it by {:.2g}°; mend it or cut "
                         "it out",
                         name, degrees, speed, beside)
                   : fmt::format(
                         "{} shifts by {:.3g} cm in one frame ({:.3g} m/s), beside it by {:.2g} cm; mend it or "
                         "cut it out",
                         name, static_cast<double>(jump.step) * 100, speed, beside);
    // There and back: the frames between are those out of place.
    result.push_back({.kind = DefectKind::jump,
                      .joint = jump.joint,
                      .frames = {single[i].frame, std::max(single[i].frame + 1, single[last].frame)},
                      .value = static_cast<float>(speed),
                      .text = text});
    i = last + 1;
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Defect& a, const Defect& b) { return a.frames.begin < b.frames.begin; });
  return result;
}

}  // namespace signweave::defect
