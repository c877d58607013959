#include "signweave/synthesis/transition.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/motion/blend.h"

namespace signweave {
namespace {

/// Context of a tenth of a second on either side: long enough to tell a velocity from noise.
std::int64_t context_frames(double frames_per_second) noexcept {
  return std::max<std::int64_t>(1, std::llround(0.1 * frames_per_second));
}

/// Keeps `total` frames of both sides together, shared out as they were captured; fewer where fewer were.
void keep(const TransitionRoom& room, std::int64_t total, TransitionCut& cut) noexcept {
  const std::int64_t both = room.retraction + room.preparation;
  if (both <= total) {
    cut.retraction_frames = room.retraction;
    cut.preparation_frames = room.preparation;
    return;
  }
  const double share = static_cast<double>(room.retraction) / static_cast<double>(both);
  cut.retraction_frames =
      std::clamp<std::int64_t>(std::llround(static_cast<double>(total) * share),
                               std::max<std::int64_t>(0, total - room.preparation), std::min(room.retraction, total));
  cut.preparation_frames = total - cut.retraction_frames;
}

/// A third of the transition, in which one pose turns into another. Where it is much shorter the hands have to leap.
std::int64_t third(const TransitionRoom& room) noexcept {
  return (room.length + 2) / 3;
}

/// Keeps at most two thirds of the transition; the rest is made as a gap, from pose and velocity at its borders.
TransitionCut cut_with_gap(const TransitionRoom& room) noexcept {
  TransitionCut cut{.length = room.length, .blend_frames = context_frames(room.frames_per_second)};
  keep(room, room.length - third(room), cut);
  return cut;
}

/// Reading "overlap": the p frames of each side are cross-faded, length = m_i + m_j − p, with p a third of the length.
/// Where the captured frames do not reach that far, or a pause lies between, the middle third is made as a gap.
TransitionCut cut_for_overlap(const TransitionRoom& room) {
  const std::int64_t faded = third(room);
  const std::int64_t total = room.length + faded;
  if (room.pause || room.retraction < faded || room.preparation < faded || room.retraction + room.preparation < total) {
    return cut_with_gap(room);
  }
  TransitionCut cut{.length = room.length, .blend_frames = faded};
  keep(room, total, cut);
  // Each side has to reach over the whole cross-fade, and no further than the transition.
  cut.retraction_frames = std::clamp(cut.retraction_frames, faded, room.length);
  cut.preparation_frames = total - cut.retraction_frames;
  return cut;
}

/// Reading "gap": at most a quarter of the transition is kept on each side, the rest is made; p frames of context give
/// position and velocity at each border.
TransitionCut cut_for_gap(const TransitionRoom& room) {
  if (room.pause) return cut_with_gap(room);
  TransitionCut cut{.length = room.length, .blend_frames = context_frames(room.frames_per_second)};
  cut.retraction_frames = std::min(room.retraction, room.length / 4);
  cut.preparation_frames = std::min(room.preparation, room.length / 4);
  return cut;
}

constexpr TransitionMethod kMethods[] = {
    {"overlap", "cross-fades the end of one retraction with the begin of the next preparation", cut_for_overlap},
    {"gap", "makes the middle anew from pose and velocity at both borders", cut_for_gap},
};

/// The rotation per frame at a border, as a rotation vector in the joint's own space, no longer than `most` radians.
Eigen::Vector3f velocity(const Eigen::Quaternionf& earlier, const Eigen::Quaternionf& later, std::int64_t span,
                         float most) noexcept {
  Eigen::Quaternionf step = earlier.conjugate() * later;
  if (step.w() < 0) step.coeffs() *= -1.0f;
  const float sine = step.vec().norm();
  if (sine < 1e-7f) return Eigen::Vector3f::Zero();
  const float square = sine * sine;
  // Mostly it is a small angle, for which the series of the arc sine is exact to 2e-6.
  const float half = sine < 0.3f
                         ? sine * (1.0f + square * (1.0f / 6.0f + square * (3.0f / 40.0f + square * (15.0f / 336.0f))))
                         : std::atan2(sine, step.w());
  const float speed = std::min(most, 2.0f * half / static_cast<float>(span));
  return step.vec() * (speed / sine);
}

/// How far something has gone `frames` after it moved at 1 a frame, if it slows down evenly to rest within `ease`
/// frames.
float coasted(double frames, double ease) noexcept {
  return static_cast<float>(frames >= ease ? ease / 2.0 : frames - frames * frames / (2.0 * ease));
}

}  // namespace

std::span<const TransitionMethod> transition_methods() noexcept {
  return kMethods;
}

const TransitionMethod* find_transition_method(std::string_view name) noexcept {
  for (const TransitionMethod& method : kMethods) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

float crossfade_weight(std::int64_t index, std::int64_t count) noexcept {
  const float t = static_cast<float>(index + 1) / static_cast<float>(count + 1);
  return t * t * (3.0f - 2.0f * t);
}

void GapFiller::between(const Border& from, const Border& to, std::int64_t count, double ease) {
  count_ = count;
  ease_ = std::max(1.0, std::min(ease, static_cast<double>(count + 1)));
  // A joint that would turn farther than half a turn until it rests is no human one.
  const float most = std::numbers::pi_v<float> / (static_cast<float>(ease_) / 2.0f);
  const std::size_t joints = from.pose.rotations.size();
  const std::size_t moved = from.pose.translations.size();
  signed_to_.assign(to.pose.rotations.begin(), to.pose.rotations.end());
  from_places_.assign(from.pose.translations.begin(), from.pose.translations.end());
  to_places_.assign(to.pose.translations.begin(), to.pose.translations.end());
  from_turns_.assign(joints, Eigen::Vector3f::Zero());
  to_turns_.assign(joints, Eigen::Vector3f::Zero());
  from_shifts_.assign(moved, Eigen::Vector3f::Zero());
  to_shifts_.assign(moved, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < joints; ++i) {
    // Chosen at the borders, so that it is the same for every frame.
    if (from.pose.rotations[i].dot(signed_to_[i]) < 0) signed_to_[i].coeffs() *= -1.0f;
    if (from.span > 0) from_turns_[i] = velocity(from.context.rotations[i], from.pose.rotations[i], from.span, most);
    if (to.span > 0) to_turns_[i] = velocity(to.pose.rotations[i], to.context.rotations[i], to.span, most);
  }
  from_.assign(from.pose.rotations, from_turns_);
  to_.assign(signed_to_, to_turns_);
  from_rest_ = from_;
  to_rest_ = to_;
  const float whole = coasted(ease_, ease_);
  from_rest_.coast(whole);
  to_rest_.coast(-whole);
  for (std::size_t i = 0; i < moved; ++i) {
    const auto per_frame = [&](const Eigen::Vector3f& way, std::int64_t span) {
      return way / static_cast<float>(span);
    };
    if (from.span > 0) {
      from_shifts_[i] = per_frame(from.pose.translations[i] - from.context.translations[i], from.span);
    }
    if (to.span > 0) to_shifts_[i] = per_frame(to.context.translations[i] - to.pose.translations[i], to.span);
  }
}

void GapFiller::fill(std::int64_t index, MutablePoseView out) const noexcept {
  const auto intervals = static_cast<double>(count_ + 1);
  const auto since = static_cast<double>(index + 1);  // frames from the left border
  const float onward = coasted(since, ease_);
  const float back = coasted(intervals - since, ease_);
  const float weight = crossfade_weight(index, count_);
  const bool from_rests = since >= ease_;
  const bool to_rests = intervals - since >= ease_;
  slerp_coasting(from_rests ? from_rest_ : from_, from_rests ? 0.0f : onward, to_rests ? to_rest_ : to_,
                 to_rests ? 0.0f : -back, weight, out.rotations);
  for (std::size_t i = 0; i < out.translations.size(); ++i) {
    const Eigen::Vector3f a = from_places_[i] + onward * from_shifts_[i];
    const Eigen::Vector3f b = to_places_[i] - back * to_shifts_[i];
    out.translations[i] = a + weight * (b - a);
  }
}

Milliseconds transition_duration(const DurationModel& model, const TransitionStats& corpus) noexcept {
  if (model.fixed) return *model.fixed;
  return corpus.count > 0 ? corpus.mean : kUnmeasuredTransition;
}

}  // namespace signweave
