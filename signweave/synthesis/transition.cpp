#include "signweave/synthesis/transition.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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

/// The rotation per frame at a border, as a rotation vector in the joint's own space.
Eigen::Vector3f velocity(const Eigen::Quaternionf& earlier, const Eigen::Quaternionf& later,
                         std::int64_t span) noexcept {
  Eigen::Quaternionf step = earlier.conjugate() * later;
  if (step.w() < 0) step.coeffs() *= -1.0f;
  const float sine = step.vec().norm();
  if (sine < 1e-7f) return Eigen::Vector3f::Zero();
  const float angle = 2.0f * std::atan2(sine, step.w());
  return step.vec() * (angle / (sine * static_cast<float>(span)));
}

Eigen::Quaternionf turned(const Eigen::Quaternionf& from, const Eigen::Vector3f& by) noexcept {
  const float angle = by.norm();
  return angle < 1e-9f ? from : from * Eigen::Quaternionf(Eigen::AngleAxisf(angle, by / angle));
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

void fill_gap(const Border& from, const Border& to, std::int64_t index, std::int64_t count, double ease,
              MutablePoseView out) noexcept {
  const auto intervals = static_cast<double>(count + 1);
  const auto since = static_cast<double>(index + 1);  // frames from the left border
  const double slowing = std::max(1.0, std::min(ease, intervals));
  const float onward = coasted(since, slowing);
  const float back = coasted(intervals - since, slowing);
  const auto t = static_cast<float>(since / intervals);
  const float weight = t * t * (3.0f - 2.0f * t);
  for (std::size_t i = 0; i < out.rotations.size(); ++i) {
    Eigen::Quaternionf a = from.pose.rotations[i];
    Eigen::Quaternionf b = to.pose.rotations[i];
    if (a.dot(b) < 0) b.coeffs() *= -1.0f;  // chosen at the borders, so that it is the same for every frame
    if (from.span > 0) a = turned(a, onward * velocity(from.context.rotations[i], from.pose.rotations[i], from.span));
    if (to.span > 0) b = turned(b, -back * velocity(to.pose.rotations[i], to.context.rotations[i], to.span));
    out.rotations[i] = slerp_as_signed(a, b, weight);
  }
  for (std::size_t i = 0; i < out.translations.size(); ++i) {
    Eigen::Vector3f a = from.pose.translations[i];
    Eigen::Vector3f b = to.pose.translations[i];
    if (from.span > 0) a += (a - from.context.translations[i]) * (onward / static_cast<float>(from.span));
    if (to.span > 0) b -= (to.context.translations[i] - b) * (back / static_cast<float>(to.span));
    out.translations[i] = a + weight * (b - a);
  }
}

Milliseconds transition_duration(const DurationModel& model, const TransitionStats& corpus) noexcept {
  if (model.fixed) return *model.fixed;
  return corpus.count > 0 ? corpus.mean : kUnmeasuredTransition;
}

}  // namespace signweave
