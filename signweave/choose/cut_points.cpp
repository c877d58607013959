#include "signweave/choose/cut_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

/// Joints with a smaller reach have little influence on a hand's position.
constexpr float kLeastReach = 0.04f;  // metres
constexpr Seconds kVelocityContext{0.05};
constexpr Seconds kLeastGap{0.1};
/// Time in which a hand at rest moves to the begin of its next preparation.
constexpr Seconds kSettling{0.3};
/// Minimum kept part of a retraction or preparation; less looks like a twitch.
constexpr Seconds kLeastKept{0.1};
/// Minimum distance between cut points.
constexpr Seconds kLeastStep{0.03};

std::int64_t frames_in(Seconds time, double hertz) noexcept {
  return std::max<std::int64_t>(1, std::llround(time.count() * hertz));
}

/// The distance from each joint to its farthest descendant point in the rest pose, metres.
std::vector<float> reaches_of(const Skeleton& skeleton) {
  const Pose rest(skeleton);
  const ModelPose places = to_model_space(skeleton, rest.view());
  std::vector<float> reaches(skeleton.joint_count(), 0.0f);
  const auto carry = [&](JointIndex from, const Eigen::Vector3f& point) {
    for (JointIndex joint = from; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
      const auto at = static_cast<std::size_t>(joint);
      reaches[at] = std::max(reaches[at], (point - places.positions[at]).norm());
    }
  };
  for (std::size_t joint = 0; joint < reaches.size(); ++joint) {
    carry(static_cast<JointIndex>(joint), places.positions[joint]);
  }
  for (const Tip& tip : skeleton.tips()) carry(tip.joint, position_of(tip, places));
  return reaches;
}

/// ∫ |acceleration|² of the cubic over `seconds`, from the squared path and the inner products of path and velocities.
double effort_of(double path_square, double path_speeds, double speeds, double seconds) noexcept {
  const double inverse = 1.0 / seconds;
  return std::max(0.0, 12.0 * path_square * inverse * inverse * inverse - 12.0 * path_speeds * inverse * inverse +
                           4.0 * speeds * inverse);
}

}  // namespace

CutChooser::CutChooser(const Skeleton& skeleton, const JointGroups& groups) {
  const std::vector<float> reaches = reaches_of(skeleton);
  for (std::size_t joint = 1; joint < reaches.size(); ++joint) {  // without the root
    if (reaches[joint] < kLeastReach) continue;
    joints_[static_cast<std::size_t>(timed_of(groups.of[joint]))].push_back({joint, reaches[joint]});
  }
}

void CutChooser::look(const std::vector<Weighted>& joints, const CutSide& side, int direction, std::int64_t most,
                      const TransitionRoom& room, Points& out) {
  const double hertz = room.frames_per_second;
  const std::int64_t step =
      std::max({std::int64_t{1}, frames_in(kLeastStep, hertz), (most + kMostPoints - 2) / (kMostPoints - 1)});
  out.kept.clear();
  const std::int64_t least = frames_in(kLeastKept, hertz);
  for (std::int64_t kept = 0; kept <= most; kept += step) {
    if (kept == 0 || kept >= least) out.kept.push_back(kept);
  }
  const auto count = static_cast<Eigen::Index>(out.kept.size());
  const auto numbers = static_cast<Eigen::Index>(4 * joints.size());
  out.states.resize(numbers, 2 * count);
  // Backwards from a cut on the left, forwards from one on the right: only kept frames are read.
  const std::int64_t context = 2 * frames_in(0.5 * kVelocityContext, hertz);
  for (Eigen::Index point = 0; point < count; ++point) {
    const std::int64_t at = side.stroke + direction * out.kept[static_cast<std::size_t>(point)];
    const std::int64_t away = std::clamp<std::int64_t>(at - direction * context, 0, side.frames.frames - 1);
    const PoseView pose = side.frames.pose(at);
    const PoseView other = side.frames.pose(away);
    const float per_second = away == at ? 0.0f : static_cast<float>(hertz / static_cast<double>(at - away));
    // The parabola through three frames gives the velocity at the cut itself, not half of the context earlier.
    const std::int64_t half = (at + away) / 2;
    const bool bent = (at - away) % 2 == 0 && away != at;
    const PoseView middle = side.frames.pose(half);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      // A rotation by a small angle moves a unit quaternion by half of it.
      const float weight = 2.0f * joints[i].reach * signs_[i];
      const Eigen::Vector4f place = weight * pose.rotations[joints[i].joint].coeffs();
      const Eigen::Vector4f from = weight * other.rotations[joints[i].joint].coeffs();
      out.states.col(point).segment<4>(static_cast<Eigen::Index>(4 * i)) = place;
      out.states.col(count + point).segment<4>(static_cast<Eigen::Index>(4 * i)) =
          bent ? Eigen::Vector4f(per_second *
                                 (3.0f * place - 4.0f * weight * middle.rotations[joints[i].joint].coeffs() + from))
               : Eigen::Vector4f(per_second * (place - from));
    }
  }
  out.path.assign(static_cast<std::size_t>(count), 0.0);
  for (Eigen::Index point = 1; point < count; ++point) {
    const float path = (out.states.col(point) - out.states.col(point - 1)).norm();
    out.path[static_cast<std::size_t>(point)] =
        out.path[static_cast<std::size_t>(point - 1)] + static_cast<double>(path);
  }
}

void CutChooser::look_at_both(const std::vector<Weighted>& joints, const TransitionRoom& room, const CutSide& from,
                              const CutSide& to, std::int64_t most_after, std::int64_t most_before) {
  const PoseView last = from.frames.pose(from.stroke);
  const PoseView first = to.frames.pose(to.stroke);
  signs_.assign(joints.size(), 1.0f);
  look(joints, from, 1, most_after, room, left_);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (last.rotations[joints[i].joint].dot(first.rotations[joints[i].joint]) < 0) signs_[i] = -1.0f;
  }
  look(joints, to, -1, most_before, room, right_);
  // Relative to one pose, to avoid cancellation.
  const Eigen::VectorXf origin = left_.states.col(0);
  left_.states.leftCols(std::ssize(left_.kept)).colwise() -= origin;
  right_.states.leftCols(std::ssize(right_.kept)).colwise() -= origin;
}

bool CutChooser::meets(const std::vector<Weighted>& joints, const TransitionRoom& room, const TransitionCut& cut,
                       const CutSide& from, const CutSide& to) {
  look_at_both(joints, room, from, to, cut.retraction_frames, cut.preparation_frames);
  const float between =
      (right_.states.col(std::ssize(right_.kept) - 1) - left_.states.col(std::ssize(left_.kept) - 1)).norm();
  return static_cast<double>(between) < 0.5 * (left_.path.back() + right_.path.back());
}

TransitionCut CutChooser::choose(const std::vector<Weighted>& joints, const TransitionRoom& room, const CutSide& from,
                                 const CutSide& to) {
  const std::int64_t least_gap = std::min(room.length, frames_in(kLeastGap, room.frames_per_second));
  const std::int64_t most = room.length - least_gap;
  look_at_both(joints, room, from, to, std::min(most, room.retraction), std::min(most, room.preparation));
  const auto lefts = static_cast<Eigen::Index>(left_.kept.size());
  const auto rights = static_cast<Eigen::Index>(right_.kept.size());
  products_.noalias() = left_.states.transpose() * right_.states;

  TransitionCut best{.length = room.length, .blend_frames = frames_in(Seconds(0.1), room.frames_per_second)};
  double best_cost = std::numeric_limits<double>::infinity();
  // Paths are summed over joints, and so is their noise.
  const double still = kStillness * std::sqrt(std::max(1.0, static_cast<double>(joints.size())));
  const double straight = static_cast<double>((right_.states.col(0) - left_.states.col(0)).norm());
  ends_.clear();
  for (Eigen::Index j = 0; j < rights; ++j) {
    const auto b = right_.states.col(j);
    const auto vb = right_.states.col(rights + j);
    ends_.push_back({.place = b.squaredNorm(), .both = b.dot(vb), .speed = vb.squaredNorm()});
  }
  for (Eigen::Index i = 0; i < lefts; ++i) {
    const auto a = left_.states.col(i);
    const auto va = left_.states.col(lefts + i);
    const double aa = a.squaredNorm();
    const double a_va = a.dot(va);
    const double va_va = va.squaredNorm();
    for (Eigen::Index j = 0; j < rights; ++j) {
      const std::int64_t kept = left_.kept[static_cast<std::size_t>(i)] + right_.kept[static_cast<std::size_t>(j)];
      if (kept > most) break;
      const Squares& end = ends_[static_cast<std::size_t>(j)];
      const double path_square = std::max(0.0, aa + static_cast<double>(end.place - 2.0f * products_(i, j)));
      const double path = std::sqrt(path_square);
      const double seconds = static_cast<double>(room.length - kept + 1) / room.frames_per_second;
      const double share = static_cast<double>(room.length - kept) / static_cast<double>(room.length);
      const double detour =
          (left_.path[static_cast<std::size_t>(i)] + path + right_.path[static_cast<std::size_t>(j)] - straight) /
          (straight + still);
      if (detour + kMaking * share >= best_cost) continue;  // the other terms are never below 0
      const double path_speeds = products_(lefts + i, j) + end.both - a_va - products_(i, rights + j);
      const double va_vb = products_(lefts + i, rights + j);
      const double vb_vb = end.speed;
      const double from_rest = 12.0 * std::max(path_square, still * still) / (seconds * seconds * seconds);
      const double turning =
          std::log1p(effort_of(path_square, path_speeds, va_va + va_vb + vb_vb, seconds) / from_rest);
      const double asked = std::pow(path / (straight + still), kHurryPower);
      const double hurry = std::log(std::max(1.0, asked / share));
      const double cost = detour + kTurning * turning + hurry + kMaking * share;
      if (cost >= best_cost) continue;
      best_cost = cost;
      best.retraction_frames = left_.kept[static_cast<std::size_t>(i)];
      best.preparation_frames = right_.kept[static_cast<std::size_t>(j)];
      best.waits = path_square < kWaitingPath * kWaitingPath && va_va < kWaitingSpeed * kWaitingSpeed &&
                   vb_vb < kWaitingSpeed * kWaitingSpeed;
    }
  }
  return best;
}

TransitionCuts CutChooser::choose(const TransitionRoom& room, const CutSide& from, const CutSide& to) {
  TransitionCuts cuts;
  for (std::size_t part = 0; part < kTimed; ++part) {
    const TransitionCut rest = cut_with_gap(room);
    if (room.pause && meets(joints_[part], room, rest, from, to)) {
      cuts[part] = rest;
      // At rest it is still, except for the remaining distance between the two rest poses.
      const std::int64_t settling = frames_in(kSettling, room.frames_per_second);
      cuts[part].pause_frames = std::clamp<std::int64_t>(rest.gap() - settling, 0, room.pause_frames);
      continue;
    }
    // The other parts move as if there were no pause, and wait for it.
    TransitionRoom moving = room;
    moving.length = std::max<std::int64_t>(1, room.length - room.pause_frames);
    cuts[part] = choose(joints_[part], moving, from, to);
    cuts[part].pause_frames = room.length - moving.length;
    cuts[part].length = room.length;
  }
  return cuts;
}

}  // namespace signweave
