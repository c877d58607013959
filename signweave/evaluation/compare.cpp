#include "signweave/evaluation/compare.h"

#include "signweave/evaluation/frame_at.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/motion/blend.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// The generated position for a captured frame at the same relative time, interpolated linearly.
struct FramePosition {
  std::int64_t frame = 0;  ///< 0: the left border, then the generated frames, then the right border
  float share = 0;         ///< weight of the next frame
};
FramePosition place_of(std::int64_t frame, std::int64_t captured, std::int64_t made) {
  if (captured == made) return {frame + 1, 0};
  const double exact =
      static_cast<double>(frame + 1) / static_cast<double>(captured + 1) * static_cast<double>(made + 1);
  const auto whole = std::min(static_cast<std::int64_t>(exact), made);
  return {whole, static_cast<float>(exact - static_cast<double>(whole))};
}

double degrees_between(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  // Uses the sine of half the angle, because a cosine near 1 is imprecise.
  const Eigen::Quaternionf turn = a.conjugate() * b;
  const double sine = static_cast<double>(turn.vec().norm());
  return 2 * std::atan2(sine, std::abs(static_cast<double>(turn.w()))) * 180 / std::numbers::pi;
}

/// True if any of the joints turns by more than half a degree in a recording.
bool any_turns(const Motion& motion, const std::vector<JointIndex>& joints) {
  constexpr double kLeastTurn = 0.5;
  for (const JointIndex joint : joints) {
    const Eigen::Quaternionf& first = motion.pose(0).rotations[static_cast<std::size_t>(joint)];
    for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
      if (degrees_between(first, motion.pose(frame).rotations[static_cast<std::size_t>(joint)]) > kLeastTurn)
        return true;
    }
  }
  return false;
}

}  // namespace

Comparison::Comparison(const EvaluatedMotion& recording)
    : recording_(recording),
      tracker_(recording.motion.skeleton(), recording.signer),
      meter_(recording.motion.rate()),
      margin_(std::max<std::int64_t>(2, std::llround(kMargin.count() * recording.motion.rate().hertz()))) {
  for (const Side side : kSides) {
    for (const JointGroup group : {arm_of(side), fingers_of(side)}) {
      moves_[static_cast<std::size_t>(group)] = any_turns(recording.motion, recording.groups[group]);
    }
  }
}

std::int64_t Comparison::margin_before(FrameRange frames) const noexcept {
  return std::min(margin_, frames.begin - 1);
}

void Comparison::fill_path(FrameRange frames, const std::vector<Vector3f>& captured,
                           std::span<const Vector3f> between) {
  const std::int64_t first = frames.begin - 1 - margin_before(frames);
  const std::int64_t end = std::min(frames.end + 1 + margin_, static_cast<std::int64_t>(captured.size()));
  path_.assign(captured.begin() + first, captured.begin() + frames.begin);
  path_.insert(path_.end(), between.begin(), between.end());
  path_.insert(path_.end(), captured.begin() + frames.end, captured.begin() + end);
}

void Comparison::compare_angles(const EvaluatedSpan& span, PosesView made, JointGroup group, Measurement& out) const {
  const std::vector<JointIndex>& joints = recording_.groups[group];
  if (joints.empty() || !moves_[static_cast<std::size_t>(group)]) return;
  const auto pose = [&](std::int64_t point) {
    if (point == 0) return recording_.motion.pose(span.frames.begin - 1);
    return point > made.frames ? recording_.motion.pose(span.frames.end) : made.pose(point - 1);
  };
  double sum = 0;
  for (std::int64_t frame = 0; frame < span.frames.size(); ++frame) {
    const PoseView captured = recording_.motion.pose(span.frames.begin + frame);
    const FramePosition place = place_of(frame, span.frames.size(), made.frames);
    for (const JointIndex joint : joints) {
      const auto i = static_cast<std::size_t>(joint);
      Eigen::Quaternionf turn = pose(place.frame).rotations[i];
      if (place.share > 0) turn = slerp(turn, pose(place.frame + 1).rotations[i], place.share);
      sum += degrees_between(captured.rotations[i], turn);
    }
  }
  out.value = sum / static_cast<double>(joints.size()) / static_cast<double>(span.frames.size());
}

void Comparison::compare_hand(const EvaluatedSpan& span, PosesView made, Side side,
                              std::array<Measurement, kMeasures>& out) {
  const HandTrack& captured = recording_.tracks[static_cast<std::size_t>(side)];
  const HandTrack& track = tracks_[static_cast<std::size_t>(side)];
  const auto score = [&](Measure measure) -> Measurement& { return out[static_cast<std::size_t>(measure)]; };
  const std::int64_t count = span.frames.size();
  const auto mean_distance = [&](const std::vector<Vector3f>& of_captured, const std::vector<Vector3f>& of_made) {
    const auto point = [&](std::int64_t i) -> const Vector3f& {
      if (i == 0) return of_captured[at(span.frames.begin - 1)];
      return i > made.frames ? of_captured[at(span.frames.end)] : of_made[at(i - 1)];
    };
    double sum = 0;
    for (std::int64_t frame = 0; frame < count; ++frame) {
      const FramePosition place = place_of(frame, count, made.frames);
      Vector3f where = point(place.frame);
      if (place.share > 0) where += place.share * (point(place.frame + 1) - where);
      sum += static_cast<double>((where - of_captured[at(span.frames.begin + frame)]).norm());
    }
    return sum / static_cast<double>(count);
  };

  score(Measure::wrist).value = 1000 * mean_distance(captured.wrist, track.wrist);
  if (recording_.signer.body) {
    score(Measure::wrist_widths).value =
        score(Measure::wrist).value / 1000 / static_cast<double>(recording_.signer.body->shoulder_width);
  }
  if (moves_[static_cast<std::size_t>(fingers_of(side))]) {
    double sum = 0;
    std::size_t tips = 0;
    for (std::size_t finger = 0; finger < kFingers.size(); ++finger) {
      if (captured.tips[finger].empty()) continue;
      sum += mean_distance(captured.tips[finger], track.tips[finger]);
      ++tips;
    }
    if (tips > 0) score(Measure::fingertips).value = 1000 * sum / static_cast<double>(tips);
  }
  compare_angles(span, made, arm_of(side), score(Measure::arm_angle));
  compare_angles(span, made, fingers_of(side), score(Measure::finger_angle));
  if (!captured.depth.empty()) {
    // NaN compares as not deeper.
    const auto deepest = [](std::span<const float> depth) { return *std::max_element(depth.begin(), depth.end()); };
    const float before = deepest(std::span(captured.depth).subspan(at(span.frames.begin - 1), at(count + 2)));
    score(Measure::depth).value = 1000 * static_cast<double>(std::max(0.0f, deepest(track.depth) - before));
  }

  const auto all = std::span(captured.wrist);
  const std::int64_t left = margin_before(span.frames);
  fill_path(span.frames, captured.wrist, all.subspan(at(span.frames.begin), at(count)));
  WristKinematics& was = captured_[static_cast<std::size_t>(side)];
  was = meter_.measure(path_, left, count);
  fill_path(span.frames, captured.wrist, track.wrist);
  WristKinematics& is = made_[static_cast<std::size_t>(side)];
  is = meter_.measure(path_, left, made.frames);
  if (!was.moves) return;
  const auto logarithms = [&](double made_one, double captured_one, Measure ratio, Measure error) {
    // Zero has no logarithm: limited to a thousandth.
    const double ln = std::log(std::max(made_one, 1e-3 * captured_one) / captured_one);
    score(ratio).value = ln;
    score(error).value = std::abs(ln);
  };
  logarithms(is.length, was.length, Measure::path_length, Measure::path_length_error);
  logarithms(is.peak_speed, was.peak_speed, Measure::peak_speed, Measure::peak_speed_error);
  score(Measure::velocity_jump) = {is.velocity_jump, was.velocity_jump};
  score(Measure::acceleration_jump) = {is.acceleration_jump, was.acceleration_jump};
  if (!is.moves) return;
  score(Measure::peak_time).value = 1000 * duration_of_gap(count) * std::abs(is.peak_time - was.peak_time);
  score(Measure::jerk).value = is.jerk - was.jerk;
  score(Measure::jerk_error).value = std::abs(is.jerk - was.jerk);
  score(Measure::arc_length).value = is.arc_length - was.arc_length;
  score(Measure::arc_length_error).value = std::abs(is.arc_length - was.arc_length);
}

double Comparison::duration_of_gap(std::int64_t count) const noexcept {
  return static_cast<double>(count + 1) * recording_.motion.rate().frame_time().count();
}

SpanScores Comparison::compare(const EvaluatedSpan& span, PosesView made) {
  SpanScores scores;
  tracker_.track(made, tracks_);
  bool both = true;
  for (const Side side : kSides) {
    const auto hand = static_cast<std::size_t>(side);
    if (tracker_.has_wrist(side)) compare_hand(span, made, side, scores.of[hand]);
    both = both && tracker_.has_wrist(side) && captured_[hand].moves && made_[hand].moves;
  }
  if (both) {
    const auto lag = [](const std::array<WristKinematics, 2>& hands) { return hands[1].onset - hands[0].onset; };
    for (auto& of : scores.of) {
      of[static_cast<std::size_t>(Measure::onset_lag)].value =
          1000 * duration_of_gap(span.frames.size()) * std::abs(lag(made_) - lag(captured_));
    }
  }
  scores.of[static_cast<std::size_t>(HandChoice::moving)] = scores.of[static_cast<std::size_t>(span.moving)];
  return scores;
}

}  // namespace signweave
