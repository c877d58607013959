#include "signweave/features/hand_trace.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

// A trace, before it is sealed:
//
//     u16  kTraceVersion
//     text reason why nothing was measured (empty: it was)
//     i64  numerator, denominator of the motion's rate
//     i64  frames, step
//     f32  shoulder width, metres; f32 × 7 lower borders of the heights from waist up; f32 near reach
//     u8   bits of the existing points, left palm lowest
//     for each of them: 16 bytes per sample (TraceSample)

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Marks a frame with non-finite values.
constexpr std::int16_t kNoNumber = std::numeric_limits<std::int16_t>::min();
constexpr float kLargest = std::numeric_limits<std::int16_t>::max();
constexpr float kOpenness = 127;

std::int16_t rounded(float value, float unit) noexcept {
  return static_cast<std::int16_t>(std::lround(std::clamp(value / unit, -kLargest, kLargest)));
}

std::uint16_t packed(const HandState& state) noexcept {
  const auto openness = static_cast<unsigned>(std::lround(std::clamp(state.openness, 0.0f, 1.0f) * kOpenness));
  return static_cast<std::uint16_t>(openness | static_cast<unsigned>(state.contact) << 7U |
                                    static_cast<unsigned>(state.palm) << 10U |
                                    static_cast<unsigned>(state.fingers) << 13U);
}

HandState unpacked(std::uint16_t bits) noexcept {
  return {.openness = static_cast<float>(bits & 127U) / kOpenness,
          .contact = static_cast<Contact>(bits >> 7U & 7U),
          .palm = static_cast<Facing>(bits >> 10U & 7U),
          .fingers = static_cast<Facing>(bits >> 13U & 7U)};
}

TraceSample sample_of(const PointFrame& frame) noexcept {
  TraceSample sample;
  if (!frame.position.allFinite() || !frame.velocity.allFinite() || !std::isfinite(frame.acceleration)) {
    sample.position.fill(kNoNumber);
    return sample;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    sample.position[i] = rounded(frame.position[axis], TraceSample::kPosition);
    sample.velocity[i] = rounded(frame.velocity[axis], TraceSample::kVelocity);
  }
  constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
  sample.acceleration =
      static_cast<std::uint16_t>(std::lround(std::clamp(frame.acceleration / TraceSample::kAcceleration, 0.0f, kMost)));
  sample.state = packed(frame.state);
  return sample;
}

PointFrame frame_of(const TraceSample& sample) noexcept {
  PointFrame frame;
  if (sample.position[0] == kNoNumber) {
    frame.position.setConstant(std::numeric_limits<float>::quiet_NaN());
    frame.velocity = frame.position;
    frame.acceleration = frame.position[0];
    return frame;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    frame.position[axis] = static_cast<float>(sample.position[i]) * TraceSample::kPosition;
    frame.velocity[axis] = static_cast<float>(sample.velocity[i]) * TraceSample::kVelocity;
  }
  frame.acceleration = static_cast<float>(sample.acceleration) * TraceSample::kAcceleration;
  frame.state = unpacked(sample.state);
  return frame;
}

std::size_t samples_for(std::int64_t frames, std::int64_t step) noexcept {
  return frames <= 0 ? 0 : static_cast<std::size_t>((frames - 1 + step - 1) / step + 1);
}

std::int64_t step_for(FrameRate rate) noexcept {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(rate.hertz() / kTraceHertz - 1e-3)));
}

constexpr std::array kTips = {finger_part(Side::left, Finger::index, FingerPoint::tip),
                              finger_part(Side::right, Finger::index, FingerPoint::tip)};

/// Keeps only the members that are stored.
SignerBody shape_of(const SignerBody& body) {
  return {.shoulder_width = body.shoulder_width, .heights = body.heights, .near_reach = body.near_reach};
}

}  // namespace

std::size_t HandTrace::samples() const noexcept {
  return why_not.empty() ? samples_for(frames, step) : 0;
}

PointTrack HandTrace::track(TracePoint point, FrameRange range) const {
  PointTrack result;
  track(point, range, result);
  return result;
}

void HandTrace::track(TracePoint point, FrameRange range, PointTrack& out) const {
  out.clear();
  const std::vector<TraceSample>& all = (*this)[point];
  if (all.empty()) return;
  assert(0 <= range.begin && range.end <= frames);
  out.reserve(static_cast<std::size_t>(std::max<std::int64_t>(range.size(), 0)));
  for (std::int64_t frame = range.begin; frame < range.end; ++frame) {
    const auto low = static_cast<std::size_t>(frame / step);
    const std::int64_t at = frame - static_cast<std::int64_t>(low) * step;
    PointFrame here = frame_of(all[std::min(low, all.size() - 1)]);
    if (at > 0) {
      const std::int64_t gap = std::min(step, frames - 1 - static_cast<std::int64_t>(low) * step);
      const PointFrame next = frame_of(all[std::min(low + 1, all.size() - 1)]);
      const float part = static_cast<float>(at) / static_cast<float>(gap);
      here.position += part * (next.position - here.position);
      here.velocity += part * (next.velocity - here.velocity);
      here.acceleration += part * (next.acceleration - here.acceleration);
      if (2 * at > gap) here.state = next.state;
    }
    out.push_back(here);
  }
}

namespace {

/// Traces the motion provided by `piece_of(FrameRange, use)`, which calls `use(motion, first)` with a motion that
/// contains all frames needed to measure the range, and the index of its first frame.
template <typename PieceOf>
HandTrace trace_pieces(FrameRate rate, std::int64_t frames, const SignerModel& model, const Pause& pause,
                       PieceOf&& piece_of) {
  HandTrace trace{.rate = rate, .frames = frames, .step = step_for(rate)};
  if (frames == 0) {
    trace.why_not = "the motion has no frame";
    return trace;
  }
  piece_of(FrameRange{0, 1}, [&](const Motion& motion, std::int64_t) {
    const HandMotion first = measure_hands(motion, model, {0, 1});
    if (!first.hands[0].why_not.empty() && !first.hands[1].why_not.empty()) trace.why_not = first.hands[1].why_not;
  });
  if (!trace.why_not.empty()) return trace;
  trace.shoulder_width = model.body->shoulder_width;
  trace.body = shape_of(*model.body);
  const std::size_t samples = samples_for(trace.frames, trace.step);
  for (std::vector<TraceSample>& points : trace.points) points.reserve(samples);
  const auto add = [&](const Motion& motion, std::int64_t moved, FrameRange block) {
    const FrameRange here{block.begin - moved, block.end - moved};
    const HandMotion hands = measure_hands(motion, model, here);
    const std::vector<PointTrack> tips = track_points(motion, model, kTips, here);
    for (std::int64_t frame = block.begin; frame < block.end; ++frame) {
      if (frame % trace.step != 0 && frame != trace.frames - 1) continue;
      const auto at = static_cast<std::size_t>(frame - block.begin);
      for (std::size_t side = 0; side < 2; ++side) {
        if (hands.hands[side].why_not.empty()) {
          trace.points[side].push_back(sample_of(point_of(hands.hands[side].frames[at])));
        }
        if (!tips[side].empty()) trace.points[2 + side].push_back(sample_of(tips[side][at]));
      }
    }
  };
  // Piece by piece, because the measurements of a frame are large.
  for_pieces({0, frames}, pause, [&](FrameRange block) {
    piece_of(block, [&](const Motion& motion, std::int64_t first) { add(motion, first, block); });
  });
  return trace;
}

}  // namespace

HandTrace trace_hands(const Motion& motion, const SignerModel& model) {
  return trace_pieces(motion.rate(), motion.frame_count(), model, {},
                      [&](FrameRange, auto&& use) { use(motion, std::int64_t{0}); });
}

HandTrace trace_hands(const MotionSource& source, const SignerModel& model, const Pause& pause) {
  Piece piece;
  return trace_pieces(source.rate(), source.frame_count(), model, pause, [&](FrameRange frames, auto&& use) {
    read_piece(source, frames, piece);
    use(piece.motion, piece.first);
  });
}

void encode(const HandTrace& trace, ByteWriter& out) {
  out.number(kTraceVersion);
  out.text(trace.why_not);
  out.number(trace.rate.numerator);
  out.number(trace.rate.denominator);
  out.number(trace.frames);
  out.number(trace.step);
  out.number(trace.shoulder_width);
  for (std::size_t i = 1; i < trace.body.heights.size(); ++i) out.number(trace.body.heights[i]);
  out.number(trace.body.near_reach);
  unsigned bits = 0;
  for (std::size_t i = 0; i < kTracePoints; ++i) bits |= trace.points[i].empty() ? 0U : 1U << i;
  out.number(static_cast<std::uint8_t>(bits));
  for (const std::vector<TraceSample>& points : trace.points) out.raw(std::as_bytes(std::span(points)));
}

std::optional<HandTrace> decode_trace(ByteReader& in, const Pause& pause) {
  if (in.number<std::uint16_t>() != kTraceVersion) return std::nullopt;
  HandTrace trace;
  trace.why_not = in.text();
  trace.rate.numerator = in.number<std::int64_t>();
  trace.rate.denominator = in.number<std::int64_t>();
  trace.frames = in.number<std::int64_t>();
  trace.step = in.number<std::int64_t>();
  if (trace.rate.numerator <= 0 || trace.rate.denominator <= 0) in.fail("the frame rate is not positive");
  if (trace.frames < 0 || trace.frames > std::numeric_limits<std::int64_t>::max() / 2 || trace.step < 1 ||
      trace.step > std::numeric_limits<std::int32_t>::max()) {
    in.fail("the frame count or the step is out of range");
  }
  const auto number = [&](float& value) {
    value = in.number<float>();
    if (!std::isfinite(value)) in.fail("a body size is not finite");
  };
  number(trace.shoulder_width);
  trace.body.shoulder_width = trace.shoulder_width;
  trace.body.heights[0] = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 1; i < trace.body.heights.size(); ++i) number(trace.body.heights[i]);
  number(trace.body.near_reach);
  const auto bits = in.number<std::uint8_t>();
  if (bits >> kTracePoints != 0) in.fail("it has unknown points");
  const std::size_t samples = trace.samples();
  if (samples > in.left() / sizeof(TraceSample) && bits != 0) in.fail("it has too few samples");
  for (std::size_t i = 0; i < kTracePoints; ++i) {
    if ((bits >> i & 1U) == 0) continue;
    if (pause) pause();
    const ByteSpan bytes = in.take(samples * sizeof(TraceSample));
    trace.points[i].resize(samples);
    if (samples > 0) std::memcpy(trace.points[i].data(), bytes.data(), bytes.size());
    for (const TraceSample& sample : trace.points[i]) {
      if ((sample.state >> 10U & 7U) == 7 || sample.state >> 13U == 7) in.fail("a facing is unknown");
    }
  }
  in.finish();
  return trace;
}

}  // namespace signweave
