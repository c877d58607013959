#include "signweave/features/phase_features.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace signweave {
namespace {

float seconds_of(FrameRange frames, FrameRate rate) {
  return static_cast<float>(static_cast<double>(frames.size()) * rate.frame_time().count());
}

HandAt at(const HandFrame& frame, const SignerBody& body) {
  return {.position = frame.position,
          .velocity = frame.velocity,
          .acceleration = frame.acceleration,
          .curvature = frame.curvature,
          .palm = frame.palm,
          .fingers = frame.fingers,
          .elbow = frame.elbow,
          .openness = frame.openness,
          .handshape = frame.handshape,
          .zone = zone_of(frame.position, body),
          .contact = frame.contact};
}

HandOver over(std::span<const HandFrame> frames, FrameRate rate, const SignerBody& body) {
  HandOver hand{.known = true, .begin = at(frames.front(), body), .end = at(frames.back(), body)};
  const auto speed = [&](std::size_t i) { return frames[i].velocity.norm(); };
  const std::size_t last = frames.size() - 1;
  double path = 0;
  double speeds = 0;
  double accelerations = 0;
  double curvatures = 0;
  std::size_t peak = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const double v = speed(i);
    speeds += v;
    accelerations += frames[i].acceleration.norm();
    curvatures += v * static_cast<double>(frames[i].curvature);
    if (v > static_cast<double>(speed(peak))) peak = i;
    if (i > 0) path += 0.5 * (v + static_cast<double>(speed(i - 1)));
  }
  const auto count = static_cast<double>(frames.size());
  hand.path_length = static_cast<float>(path * rate.frame_time().count());
  hand.displacement = (frames.back().position - frames.front().position).norm() * body.shoulder_width;
  hand.mean_speed = static_cast<float>(speeds / count);
  hand.peak_speed = speed(peak);
  hand.peak_time = last > 0 ? static_cast<float>(peak) / static_cast<float>(last) : 0;
  hand.mean_acceleration = static_cast<float>(accelerations / count);
  hand.mean_curvature = speeds > 0 ? static_cast<float>(curvatures / speeds) : 0;
  for (std::size_t k = 0; k < HandOver::kProfile; ++k) {
    const float place = static_cast<float>(k) / (HandOver::kProfile - 1) * static_cast<float>(last);
    const auto low = std::min(static_cast<std::size_t>(place), last);
    const std::size_t high = std::min(low + 1, last);
    hand.profile[k] = std::lerp(speed(low), speed(high), place - static_cast<float>(low));
  }
  return hand;
}

/// Returns an empty string, or the reason why no phase can be measured.
std::string why_not_measured(const Motion& motion, const SignerModel& model) {
  if (motion.frame_count() == 0) return "the motion has no frame";
  if (!model.body) {
    const std::string why = why_no_signer_space(model.rig);
    return why.empty()
               ? "the shoulders are in one place, or too near each other for a body: name them in a mapping file"
               : why;
  }
  const HandMotion first = measure_hands(motion, model, {0, 1});
  const std::string& left = first.hands[0].why_not;
  const std::string& right = first.hands[1].why_not;
  return left.empty() || right.empty() ? "" : left + ", " + right;
}

}  // namespace

SignerModel model_of(const Motion& motion, const RigNames& names) {
  SignerModel model{.rig = map_rig(motion, names), .body = {}};
  model.body = signer_body(motion, model.rig);
  return model;
}

PhaseFeatures features_over(const HandMotion& measured, FrameRange frames, FrameRate rate, const SignerBody& body) {
  assert(!frames.empty() && measured.range.begin <= frames.begin && frames.end <= measured.range.end);
  PhaseFeatures features;
  features.seconds = seconds_of(frames, rate);
  const auto begin = static_cast<std::size_t>(frames.begin - measured.range.begin);
  const auto count = static_cast<std::size_t>(frames.size());
  for (const Side side : kSides) {
    const auto index = static_cast<std::size_t>(side);
    const std::vector<HandFrame>& all = measured.hands[index].frames;
    if (all.empty()) continue;
    features.hands[index] = over(std::span(all).subspan(begin, count), rate, body);
    features.known = true;
  }
  if (!measured.trunk.empty()) {
    features.trunk_begin = measured.trunk[begin];
    features.trunk_end = measured.trunk[begin + count - 1];
  }
  if (!measured.hands_distance.empty()) {
    features.hands_distance_begin = measured.hands_distance[begin];
    features.hands_distance_end = measured.hands_distance[begin + count - 1];
  }
  return features;
}

RecordingFeatures measure_phases(const Motion& motion, const SignerModel& model, std::span<const TimeSpan> phases,
                                 const FrameClock& clock) {
  RecordingFeatures result;
  result.phases.resize(phases.size());
  result.why_not = why_not_measured(motion, model);
  if (result.why_not.empty()) result.shoulder_width = model.body->shoulder_width;
  bool known = phases.empty();
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const FrameRange requested = frames_of(phases[i], clock);
    FrameRange frames = clamp(requested, motion.frame_count());
    PhaseFeatures& features = result.phases[i];
    const bool shorter_than_frame = requested.empty() && 0 <= requested.begin && requested.begin < motion.frame_count();
    if (shorter_than_frame) frames = {requested.begin, requested.begin + 1};
    if (frames.empty()) continue;
    if (result.why_not.empty()) {
      features = features_over(measure_hands(motion, model, frames), frames, motion.rate(), *model.body);
      if (!finite(features)) features = {};
      known = known || features.known;
    }
    features.seconds = shorter_than_frame ? 0 : seconds_of(frames, motion.rate());
  }
  if (result.why_not.empty() && !known) {
    result.why_not =
        "no phase lies within the motion; if the two do not start together, import it with an offset or sync points";
  }
  return result;
}

}  // namespace signweave
