#include "signweave/live/living_rest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/core/error.h"
#include "signweave/motion/degree.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

// Breaths a second, and the variation of rate and depth over minutes: 12.5 to 15.5 breaths a minute. (ours)
constexpr double kBreaths = 14.0 / 60;
constexpr double kInhale = 0.4;  // share of a breath; then exhaling and a pause
constexpr double kPause = 0.04;
// Amplitudes at full inhalation. (ours)
constexpr float kSpinePitch = 0.25f * kDegree;
constexpr float kChestPitch = 0.7f * kDegree;
constexpr float kLift = 1.0f * kDegree;  // of the clavicles
// Swaying: pitch, turn, roll. (ours)
const Vector3f kTrunkSway(0.22f * kDegree, 0.15f * kDegree, 0.22f * kDegree);
const Vector3f kHeadDrift(0.35f * kDegree, 0.7f * kDegree, 0.3f * kDegree);
constexpr float kSpineShare = 0.6f;  // share of the trunk's sway
// Blinks: one in each slot, within its middle half, so that they are 2 to 6 s apart.
constexpr double kSlot = 4.0;
constexpr double kSlotMargin = 1.0;
constexpr double kClosing = 0.08;
constexpr double kOpening = 0.15;

/// From 0 to 1 with zero velocity and acceleration at both ends.
double smoother_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 - t * (15 - 6 * t));
}

/// Pseudo-random bits (Steele, Lea and Flood 2014, SplitMix).
std::uint64_t scrambled(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}
/// A number in [0, 1).
double share_of(std::uint64_t bits) {
  return static_cast<double>(scrambled(bits) >> 11) * 0x1p-53;
}

/// The sine of an angle in turns.
double wave(double turns) {
  return std::sin(2 * std::numbers::pi * (turns - std::floor(turns)));
}

/// Depth of a breath at phase [0, 1): inhale, exhale slowing towards the end, pause.
double breath_at(double part) {
  if (part < kInhale) return smoother_step(part / kInhale);
  const double out = std::min(1.0, (part - kInhale) / (1 - kPause - kInhale));
  return 1 - smoother_step(out * (1.5 - 0.5 * out));
}

/// The unit quaternion of a small rotation vector (radians).
Quaternionf small_turn(const Vector3f& vector) {
  const float square = vector.squaredNorm() / 4;
  const Vector3f sine = (0.5f - square / 12) * vector;
  return {std::sqrt(1 - sine.squaredNorm()), sine.x(), sine.y(), sine.z()};
}

/// x to the signer's left, y up along the trunk, z forward, in model space; none if left and right are unknown.
std::optional<Matrix3f> signer_axes(const RigMap& rig, const ModelPose& pose) {
  constexpr float kLeast = 1e-4f;  // metres
  Vector3f left = Vector3f::Zero();
  for (const Part part : {Part::left_upper_arm, Part::left_clavicle, Part::left_thigh, Part::left_eye}) {
    const PartPlace& other = rig[of(Side::right, part)];
    if (!rig.has(part) || !other.known()) continue;
    left = position_of(rig[part], pose) - position_of(other, pose);
    if (left.norm() > kLeast) break;
  }
  if (!(left.norm() > kLeast) || !left.allFinite()) return std::nullopt;
  Matrix3f axes;
  axes.col(0) = left.normalized();
  Vector3f up = Vector3f::UnitY();
  for (const Part low : {Part::pelvis, Part::spine, Part::chest}) {
    const Part high = rig.has(Part::neck) ? Part::neck : Part::head;
    if (!rig.has(low) || !rig.has(high)) continue;
    const Vector3f trunk = position_of(rig[high], pose) - position_of(rig[low], pose);
    if (!(trunk.norm() > kLeast)) continue;
    up = trunk.normalized();
    break;
  }
  up -= axes.col(0) * axes.col(0).dot(up);
  if (!(up.norm() > 0.1f)) return std::nullopt;
  axes.col(1) = up.normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

bool lies_above(const Skeleton& skeleton, JointIndex above, JointIndex joint) {
  while (joint > above) joint = skeleton.joint(joint).parent;
  return joint == above;
}

/// True if a joint is an ancestor of the legs: it must not rotate.
bool carries_legs(const Skeleton& skeleton, const RigMap& rig, JointIndex joint) {
  for (const Part part : {Part::pelvis, Part::left_thigh, Part::right_thigh, Part::left_foot, Part::right_foot}) {
    if (rig.has(part) && lies_above(skeleton, joint, rig[part].joint)) return true;
  }
  return false;
}

}  // namespace

LivingRest::LivingRest(std::shared_ptr<const Skeleton> skeleton, FrameRate rate, const RigMap& rig, RestPose rest,
                       std::vector<std::string> tracks, LivingRestOptions options)
    : skeleton_(std::move(skeleton)),
      rate_(rate),
      rest_(std::move(rest)),
      tracks_(std::move(tracks)),
      options_(options) {
  if (rest_.pose.rotations.size() != skeleton_->joint_count() ||
      rest_.pose.translations.size() != skeleton_->translation_count()) {
    throw Error{ErrorCode::bad_input,
                fmt::format("a rest pose of {} joints for a skeleton of {}: take one of the same skeleton",
                            rest_.pose.rotations.size(), skeleton_->joint_count())};
  }
  if (rest_.tracks.size() != tracks_.size()) {
    throw Error{ErrorCode::bad_input,
                fmt::format("{} values for {} tracks: each track needs one", rest_.tracks.size(), tracks_.size())};
  }
  for (std::size_t i = 0; i < phases_.size(); ++i) phases_[i] = share_of(scrambled(options_.seed) + i);
  for (std::size_t i = 0; i < kLidTracks.size(); ++i) {
    lids_[i] = static_cast<std::size_t>(std::ranges::find(tracks_, kLidTracks[i]) - tracks_.begin());
  }
  add_moved(rig, to_model_space(*skeleton_, rest_.pose.view()));
}

void LivingRest::add_moved(const RigMap& rig, const ModelPose& pose) {
  const std::optional<Matrix3f> axes = signer_axes(rig, pose);
  if (!axes) return;
  const auto add = [&](Role role, Part part) {
    if (!rig.has(part) || carries_legs(*skeleton_, rig, rig[part].joint)) return;
    Moved moved{.role = role, .joint = rig[part].joint, .lift = Vector3f::Zero(), .to_parent = *axes};
    // Spine and chest, or neck and head, may be the same joint: the later part determines its role.
    const auto end = moved_.begin() + static_cast<std::ptrdiff_t>(moved_count_);
    const auto same = std::find_if(moved_.begin(), end, [&](const Moved& other) { return other.joint == moved.joint; });
    if (same == end) ++moved_count_;
    const JointIndex parent = skeleton_->joint(moved.joint).parent;
    if (parent != kNoJoint) {
      moved.to_parent = pose.rotations[static_cast<std::size_t>(parent)].conjugate().toRotationMatrix() * *axes;
    }
    *same = moved;
  };
  add(rig.has(Part::chest) ? Role::spine : Role::chest, Part::spine);
  add(Role::chest, Part::chest);
  add(Role::neck, Part::neck);
  add(Role::head, Part::head);
  for (const Side side : kSides) {
    const Part clavicle = of(side, Part::left_clavicle);
    const Part shoulder = of(side, Part::left_upper_arm);
    const std::size_t before = moved_count_;
    add(Role::clavicle, clavicle);
    add(Role::upper_arm, shoulder);
    if (moved_count_ < before + 2) continue;
    const Vector3f bone = axes->transpose() * (position_of(rig[shoulder], pose) - position_of(rig[clavicle], pose));
    const Vector3f axis = bone.cross(Vector3f::UnitY());
    if (axis.norm() > 0.2f * bone.norm()) moved_[before].lift = axis.normalized();
  }
  for (std::size_t i = 0; i < moved_count_; ++i) {
    for (std::size_t j = 0; j < moved_count_; ++j) {
      const auto best = moved_[i].above;
      if (i == j || !lies_above(*skeleton_, moved_[j].joint, moved_[i].joint)) continue;
      if (best < 0 || moved_[j].joint > moved_[static_cast<std::size_t>(best)].joint) {
        moved_[i].above = static_cast<int>(j);
      }
    }
  }
}

LivingRest::Life LivingRest::life_at(std::int64_t frame) const noexcept {
  const double seconds =
      static_cast<double>(frame) * static_cast<double>(rate_.denominator) / static_cast<double>(rate_.numerator);
  const double ease = smoother_step(seconds / kRestEase.count());
  const auto size = static_cast<float>(ease) * options_.amount;
  // The first breath begins at 0.
  const double breaths =
      kBreaths * seconds + 0.12 * wave(seconds / 47.3) + 0.09 * (wave(seconds / 83.9 + phases_[7]) - wave(phases_[7]));
  const double depth = 0.85 + 0.15 * wave(seconds / 31.7 + phases_[6]);
  const auto breath = static_cast<float>(depth * breath_at(breaths - std::floor(breaths)));
  // Two waves each, whose periods have no small common multiple.
  const auto slow = [&](std::size_t i, double first, double second) {
    return static_cast<float>(0.6 * wave(seconds / first + phases_[i]) + 0.4 * wave(seconds / second - phases_[i]));
  };
  const Vector3f sway =
      size * kTrunkSway.cwiseProduct(Vector3f(slow(0, 7.31, 12.9), slow(1, 13.7, 23.3), slow(2, 9.17, 16.3)));
  const Vector3f drift =
      size * kHeadDrift.cwiseProduct(Vector3f(slow(3, 6.13, 10.7), slow(4, 8.59, 19.1), slow(5, 11.3, 17.9)));
  const Vector3f in = -size * breath * Vector3f::UnitX();  // the chest rises as the trunk leans back
  Life life{.breath = size * breath, .turns = {}};
  life.turns[0] = kSpineShare * sway + kSpinePitch * in;
  life.turns[1] = sway + kChestPitch * in;
  life.turns[2] = 0.5f * (life.turns[1] + drift);
  life.turns[3] = drift;
  return life;
}

void LivingRest::move(const Life& life, std::span<Quaternionf> rotations) const noexcept {
  std::array<Quaternionf, kMostMoved> turns;  // rotation of each moved joint in model space, signer's axes
  for (std::size_t i = 0; i < moved_count_; ++i) {
    const Moved& moved = moved_[i];
    if (moved.role == Role::upper_arm) {
      turns[i].setIdentity();
    } else if (moved.role == Role::clavicle) {
      turns[i] = small_turn(life.turns[static_cast<std::size_t>(Role::chest)] + kLift * life.breath * moved.lift);
    } else {
      turns[i] = small_turn(life.turns[static_cast<std::size_t>(moved.role)]);
    }
  }
  for (std::size_t i = 0; i < moved_count_; ++i) {
    const Moved& moved = moved_[i];
    Quaternionf turn = turns[i];
    if (moved.above >= 0) turn = turns[static_cast<std::size_t>(moved.above)].conjugate() * turn;
    turn.vec() = (moved.to_parent * turn.vec()).eval();
    Quaternionf& rotation = rotations[static_cast<std::size_t>(moved.joint)];
    rotation = turn * rotation;
  }
}

void LivingRest::read(FrameRange frames, MutablePoses out) const noexcept {
  const std::size_t joints = rest_.pose.rotations.size();
  const std::size_t translations = rest_.pose.translations.size();
  for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
    const auto at = static_cast<std::size_t>(frame - frames.begin);
    const auto rotations = out.rotations.subspan(at * joints, joints);
    std::ranges::copy(rest_.pose.rotations, rotations.begin());
    std::ranges::copy(rest_.pose.translations, out.translations.subspan(at * translations, translations).begin());
    if (frame > 0) move(life_at(frame), rotations);
  }
}

float LivingRest::lids_at(std::int64_t frame) const noexcept {
  const double frame_time = static_cast<double>(rate_.denominator) / static_cast<double>(rate_.numerator);
  const double slot = std::floor(static_cast<double>(frame) * frame_time / kSlot);
  const double share = share_of(scrambled(options_.seed) ^ static_cast<std::uint64_t>(slot));
  const double moment = slot * kSlot + kSlotMargin + (kSlot - 2 * kSlotMargin) * share;
  // Closed at a whole frame, so that low frame rates show it too.
  const auto shut = static_cast<std::int64_t>(std::llround(moment / frame_time));
  const double away = static_cast<double>(frame - shut) * frame_time;
  return static_cast<float>(1 - smoother_step(away < 0 ? -away / kClosing : away / kOpening));
}

void LivingRest::read_tracks(FrameRange frames, std::span<const std::span<float>> out) const noexcept {
  for (std::size_t track = 0; track < out.size(); ++track) {
    if (out[track].empty()) continue;
    const float open = rest_.tracks[track];
    const bool lid = std::ranges::find(lids_, track) != lids_.end();
    for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
      float& value = out[track][static_cast<std::size_t>(frame - frames.begin)];
      value = lid && frame > 0 ? open + (1 - open) * lids_at(frame) : open;
    }
  }
}

}  // namespace signweave
