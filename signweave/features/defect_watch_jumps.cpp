#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave::defect {
namespace {

// Human limits. A step counts as a jump if it is faster than this *and* exceeds the adjacent steps by this much:
// athletes' limbs come near these speeds, but they take many frames to accelerate.
/// Elbow of a professional pitcher, 2,320°/s (Fleisig et al. 1999, J. Biomechanics 32).
constexpr double kFastestLimb = 40;  // rad/s
/// A finger snap, 7,800°/s (Acharya et al. 2021, J. R. Soc. Interface 18): no part of a body rotates faster.
constexpr double kFastestTurn = 136;  // rad/s
/// The acceleration needed to rotate this fast for a single frame, and the deceleration after it. (ours)
constexpr double kHardestTurn = 2'500;  // rad/s²
/// The hand of an Olympic boxer reaches 9.1 ± 2.1 m/s (Walilko, Viano, Bir 2005, Br. J. Sports Med. 39), a sprinter at
/// best 12.3 (Graubner and Nixdorf 2011, New Studies in Athletics 26).
constexpr double kFastestPoint = 12.3;  // m/s
/// The acceleration of a body that starts and stops within a frame: 50 times gravity. (ours)
constexpr double kHardestShift = 500;    // m/s²
constexpr float kLeastShift = 0.03f;     // metres
constexpr float kLeastTurn = 0.1f;       // radians: less is noise at any frame rate
constexpr std::int64_t kTogether = 3;    // frames: jumps this close are merged
constexpr std::size_t kWholeBody = 6;    // minimum number of joints that jump at the same time
constexpr double kWholeBodyShare = 0.2;  // the same as a fraction of all joints
// Maximum number of points visited for the levers of one frame, per joint and tip. A body needs as many as its joints
// are deep.
constexpr std::size_t kMostLooks = 64;

float angle_between(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) noexcept {
  const float cosine = std::min(1.0f, std::abs(a.dot(b)));
  return 2 * std::acos(cosine);
}

/// Returns an upper bound of the distance to the farthest point that each joint carries: measured along the bones.
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

JumpWatch::JumpWatch(const Motion& motion, Excuse excuse)
    : motion_(motion),
      excuse_(std::move(excuse)),
      hertz_(motion.rate().hertz()),
      many_(std::max(kWholeBody,
                     static_cast<std::size_t>(kWholeBodyShare * static_cast<double>(motion.skeleton().joint_count())))),
      reach_(reaches(motion.skeleton())),
      carried_(motion.skeleton().joint_count()),
      tips_(motion.skeleton().joint_count()) {
  for (Steps& steps : ring_) {
    steps.turns.resize(motion.skeleton().joint_count());
    steps.shifts.resize(motion.skeleton().translation_count());
  }
  for (std::vector<Jump>& near : near_) near.resize(motion.skeleton().joint_count());
  for (std::size_t i = 1; i < carried_.size(); ++i) {
    carried_[static_cast<std::size_t>(motion.skeleton().joints()[i].parent)].push_back(static_cast<JointIndex>(i));
  }
  for (const Tip& tip : motion.skeleton().tips()) tips_[static_cast<std::size_t>(tip.joint)].push_back(tip);
}

void JumpWatch::see(std::int64_t frame, bool whole) {
  seen_ = frame + 1;
  const bool known = whole && last_whole_;
  last_whole_ = whole;
  if (frame == 0) return;
  Steps& steps = ring_[static_cast<std::size_t>(frame % kRing)];
  if (known) {
    const PoseView before = motion_.pose(frame - 1);
    const PoseView now = motion_.pose(frame);
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
  } else {  // treated like the ends of the motion
    std::fill(steps.turns.begin(), steps.turns.end(), 0.0f);
    std::fill(steps.shifts.begin(), steps.shifts.end(), 0.0f);
    steps.repeated = false;
  }
  if (frame >= 3) judge(frame - 2);
}

/// Returns the larger of the two adjacent steps. For a step away and back, the other half is skipped.
template <typename Distance>
float JumpWatch::around(std::int64_t frame, std::vector<float> Steps::*what, std::size_t index,
                        const Distance& distance) const {
  constexpr float kBack = 0.3f;  // fraction of the step: closer than this counts as back
  const auto step = [&](std::int64_t into_frame) {
    return into_frame >= 1 && into_frame < seen_ ? (into(into_frame).*what)[index] : 0.0f;
  };
  const float own = step(frame);
  const auto adjacent = [&](std::int64_t next, std::int64_t beyond, std::int64_t a, std::int64_t b) {
    const bool inside = a >= 0 && b < seen_;
    return inside && step(next) > 0.5f * own && distance(a, b) < kBack * own ? step(beyond) : step(next);
  };
  return std::max(adjacent(frame - 1, frame - 2, frame - 2, frame),
                  adjacent(frame + 1, frame + 2, frame - 1, frame + 1));
}

/// Returns whether any joint or tip carried by a joint is farther than `lever`, metres, from the axis of its rotation.
/// In degenerate skeletons with chains of thousands of joints, the last joints of a frame are not visited and count as
/// no jump.
bool JumpWatch::reaches_beyond(std::int64_t frame, JointIndex joint, double lever) {
  if (model_of_ != frame) {
    to_model_space(motion_.skeleton(), motion_.pose(frame), model_);
    model_of_ = frame;
    looked_at_ = 0;
  }
  const std::size_t most = kMostLooks * (reach_.size() + motion_.skeleton().tips().size());
  const auto j = static_cast<std::size_t>(joint);
  const Eigen::Quaternionf turn = motion_.pose(frame - 1).rotations[j].conjugate() * motion_.pose(frame).rotations[j];
  const Eigen::Vector3f axis = model_.rotations[j] * turn.vec().normalized();
  const auto beyond = [&](const Eigen::Vector3f& point) {
    return static_cast<double>(axis.cross(point - model_.positions[j]).norm()) > lever;
  };
  open_.assign(1, joint);
  while (!open_.empty() && looked_at_ < most) {
    const auto at = static_cast<std::size_t>(open_.back());
    open_.pop_back();
    looked_at_ += 1 + tips_[at].size();
    if (beyond(model_.positions[at])) return true;
    for (const Tip& tip : tips_[at]) {
      if (beyond(position_of(tip, model_))) return true;
    }
    open_.insert(open_.end(), carried_[at].begin(), carried_[at].end());
  }
  return false;
}

void JumpWatch::judge(std::int64_t frame) {
  const Steps& steps = into(frame);
  now_.clear();
  // If a frame was repeated because no new one was available, the next step spans both.
  double hertz = hertz_;
  for (std::int64_t before = frame - 1; before >= std::max<std::int64_t>(1, frame - 2) && into(before).repeated;
       --before) {
    hertz = hertz_ / static_cast<double>(frame - before + 1);
  }
  for (std::size_t i = 0; i < steps.turns.size(); ++i) {
    const float step = steps.turns[i];
    const double speed = static_cast<double>(step) * hertz;
    if (step < kLeastTurn || (speed < kFastestLimb && speed * static_cast<double>(reach_[i]) < kFastestPoint)) continue;
    const float adjacent = around(frame, &Steps::turns, i, [&](std::int64_t a, std::int64_t b) {
      return angle_between(motion_.pose(a).rotations[i], motion_.pose(b).rotations[i]);
    });
    const double excess = static_cast<double>(step - adjacent) * hertz;
    const bool turns = excess > kFastestLimb && excess * hertz > kHardestTurn;
    if (turns || speed > kFastestTurn ||
        (excess * static_cast<double>(reach_[i]) > kFastestPoint &&
         reaches_beyond(frame, static_cast<JointIndex>(i), kFastestPoint / excess))) {
      now_.push_back({frame, frame, static_cast<JointIndex>(i), true, step, adjacent});
    }
  }
  for (std::size_t i = 0; i < steps.shifts.size(); ++i) {
    const float step = steps.shifts[i];
    const double speed = static_cast<double>(step) * hertz;
    if (step < kLeastShift || speed * hertz < kHardestShift) continue;
    const float adjacent = around(frame, &Steps::shifts, i, [&](std::int64_t a, std::int64_t b) {
      return (motion_.pose(a).translations[i] - motion_.pose(b).translations[i]).norm();
    });
    const double excess = static_cast<double>(step - adjacent) * hertz;
    if (speed > kFastestPoint || (excess * hertz > kHardestShift && step - adjacent > kLeastShift)) {
      now_.push_back({frame, frame, motion_.skeleton().translated_joints()[i], false, step, adjacent});
    }
  }
  gather(frame);
}

/// Merges the jumps of a frame with those before it.
void JumpWatch::gather(std::int64_t frame) {
  if (now_.size() >= many_) {  // the motion continues at another position: reported once
    Jump all = *std::max_element(now_.begin(), now_.end(), [](const Jump& a, const Jump& b) {
      return a.turns != b.turns ? b.turns : a.step < b.step;
    });
    all.count = now_.size();
    keep(all);
    return;
  }
  for (const Jump& jump : now_) {
    Jump& near = near_[jump.turns ? 1 : 0][static_cast<std::size_t>(jump.joint)];
    if (near.first >= 0 && frame <= near.last + kTogether) {
      near.last = frame;
      if (jump.step > near.step) {
        near.step = jump.step;
        near.around = jump.around;
      }
    } else {
      keep(near);
      near = jump;
    }
  }
}

bool JumpWatch::comes_before(const Jump& a, const Jump& b) noexcept {
  const auto order = [](const Jump& jump) {
    return std::tuple(jump.first, jump.count > 1 ? 0 : 1, jump.joint, jump.turns ? 0 : 1);
  };
  return order(a) < order(b);
}

/// Only the earliest jumps are reported, so no more than these are stored.
void JumpWatch::keep(const Jump& jump) {
  if (jump.first < 0 || (excuse_ && excuse_(jump.first, jump.count > 1 ? kNoJoint : jump.joint))) return;
  ++jumps_;
  kept_.push_back(jump);
  if (kept_.size() < 2 * kMostDefects) return;
  std::sort(kept_.begin(), kept_.end(), comes_before);
  kept_.resize(kMostDefects);
}

Defect JumpWatch::defect_of(const Jump& jump) const {
  const double speed = static_cast<double>(jump.step) * hertz_;
  const double degrees = static_cast<double>(jump.step) * 180 / std::numbers::pi;
  const std::string name = printable(motion_.skeleton().joint(jump.joint).name);
  if (jump.count > 1) {
    return {.kind = DefectKind::jump,
            .frames = {jump.first, jump.first + 1},
            .value = static_cast<float>(speed),
            .text = fmt::format("{} joints jump at once, {} by {:.0f}°: a cut, or frames are missing", jump.count, name,
                                degrees)};
  }
  const double adjacent = static_cast<double>(jump.around) * (jump.turns ? 180 / std::numbers::pi : 100.0);
  const std::string text = jump.turns ? fmt::format(
                                            "{} rotates by {:.0f}° in one frame ({:.3g} rad/s), in adjacent frames by "
                                            "{:.2g}°; fix it or cut it out",
                                            name, degrees, speed, adjacent)
                                      : fmt::format(
                                            "{} shifts by {:.3g} cm in one frame ({:.3g} m/s), in adjacent frames by "
                                            "{:.2g} cm; fix it or cut it out",
                                            name, static_cast<double>(jump.step) * 100, speed, adjacent);
  // Away and back: the frames in between are the misplaced ones.
  return {.kind = DefectKind::jump,
          .joint = jump.joint,
          .frames = {jump.first, std::max(jump.first + 1, jump.last)},
          .value = static_cast<float>(speed),
          .text = text};
}

Found JumpWatch::found() {
  for (std::int64_t frame = std::max<std::int64_t>(1, seen_ - 2); frame < seen_; ++frame) judge(frame);
  for (std::vector<Jump>& near : near_) {
    for (Jump& jump : near) keep(std::exchange(jump, {}));
  }
  std::sort(kept_.begin(), kept_.end(), comes_before);
  kept_.resize(std::min(kept_.size(), kMostDefects));
  Found result{.more = jumps_ - kept_.size()};
  for (const Jump& jump : kept_) result.defects.push_back(defect_of(jump));
  return result;
}

}  // namespace signweave::defect
