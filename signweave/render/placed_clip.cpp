#include "signweave/render/placed_clip.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

/// Approximate maximum number of source frames read at a time for interpolation.
constexpr std::int64_t kChunk = 256;

/// The number of output frames made from one such chunk.
std::int64_t chunk_of(const PlacedClip& placed) noexcept {
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(static_cast<double>(kChunk) / placed.step), 1, kChunk);
}

/// The source frames needed to interpolate some output frames.
FrameRange needed(const PlacedClip& placed, FrameRange output) {
  const auto first = static_cast<std::int64_t>(std::floor(placed.frame_at(output.begin)));
  const auto last = static_cast<std::int64_t>(std::ceil(placed.frame_at(output.end - 1)));
  return {first, std::min(last + 1, placed.captured->source->frame_count())};
}

}  // namespace

double PlacedClip::frame_at(std::int64_t output) const noexcept {
  const double frame = static_cast<double>(captured->core.begin) + static_cast<double>(output - core) * step;
  return std::clamp(frame, static_cast<double>(captured->whole.begin), static_cast<double>(last));
}

std::int64_t PlacedClip::frame_of(std::int64_t recorded) const noexcept {
  return core + std::llround(static_cast<double>(recorded - captured->core.begin) / step);
}

PlacedClip placed_at_tempo(const MotionClip& clip, FrameRate rate, double tempo) {
  const FrameRate own = clip.source->rate();
  const double own_tempo = clip.speed == 1 ? tempo : tempo * clip.speed;
  return placed_by_step(clip, own == rate ? own_tempo : own.hertz() / rate.hertz() * own_tempo);
}

PlacedClip placed_by_step(const MotionClip& clip, double step) {
  PlacedClip placed;
  placed.captured = &clip;
  placed.last = std::min(clip.whole.end, clip.source->frame_count() - 1);
  placed.step = step;
  const auto frames = [&](std::int64_t count) {
    return static_cast<std::int64_t>(std::min(static_cast<double>(count) / placed.step, 1e12) + 1e-9);
  };
  // Limited so that sums do not overflow; the total is checked before anything is made.
  const double core = std::min(static_cast<double>(clip.core.size()) / placed.step, 1e12);
  placed.core_frames = std::max<std::int64_t>(1, std::llround(core));
  placed.preparation = frames(clip.core.begin - clip.whole.begin);
  placed.retraction = frames(clip.whole.end - clip.core.end);
  return placed;
}

void read_frames(const PlacedClip& placed, FrameRange output, MutablePoses out) {
  if (output.empty()) return;
  const MotionSource& source = *placed.captured->source;
  if (placed.captured_as_is()) {
    const std::int64_t first = placed.captured->core.begin + output.begin - placed.core;
    source.read({first, first + output.size()}, out);
    return;
  }
  const std::size_t joints = source.skeleton()->joint_count();
  const std::size_t moved = source.skeleton()->translation_count();
  Motion captured;
  const std::int64_t chunk = chunk_of(placed);
  for (std::int64_t begin = output.begin; begin < output.end; begin += chunk) {
    const std::int64_t end = std::min(begin + chunk, output.end);
    const FrameRange frames = needed(placed, {begin, end});
    captured.reset(source.skeleton(), source.rate(), frames.size());
    source.read(frames, captured.poses({0, frames.size()}));
    for (std::int64_t frame = begin; frame < end; ++frame) {
      const auto at = static_cast<std::size_t>(frame - output.begin);
      sample(captured, placed.frame_at(frame) - static_cast<double>(frames.begin),
             {out.rotations.subspan(at * joints, joints), out.translations.subspan(at * moved, moved)});
    }
  }
}

void read_tracks(const PlacedClip& placed, FrameRange output, std::span<const std::span<float>> out) {
  if (output.empty()) return;
  const MotionSource& source = *placed.captured->source;
  if (placed.captured_as_is()) {
    const std::int64_t first = placed.captured->core.begin + output.begin - placed.core;
    source.read_tracks({first, first + output.size()}, out);
    return;
  }
  const std::int64_t chunk = chunk_of(placed);
  std::vector<std::vector<float>> captured(out.size());
  std::vector<std::span<float>> spans(out.size());
  for (std::int64_t begin = output.begin; begin < output.end; begin += chunk) {
    const std::int64_t end = std::min(begin + chunk, output.end);
    const FrameRange frames = needed(placed, {begin, end});
    for (std::size_t track = 0; track < out.size(); ++track) {
      if (out[track].empty()) continue;
      captured[track].resize(static_cast<std::size_t>(frames.size()));
      spans[track] = captured[track];
    }
    source.read_tracks(frames, spans);
    for (std::size_t track = 0; track < out.size(); ++track) {
      const std::vector<float>& values = captured[track];
      if (values.empty()) continue;
      for (std::int64_t frame = begin; frame < end; ++frame) {
        const double at = placed.frame_at(frame) - static_cast<double>(frames.begin);
        const auto before = static_cast<std::size_t>(at);
        const std::size_t after = std::min(before + 1, values.size() - 1);
        const auto part = static_cast<float>(at - static_cast<double>(before));
        out[track][static_cast<std::size_t>(frame - output.begin)] =
            values[before] + part * (values[after] - values[before]);
      }
    }
  }
}

}  // namespace signweave
