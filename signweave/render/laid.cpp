#include "signweave/render/laid.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

/// How many frames of the source are read at a time, at most and about, where they are interpolated.
constexpr std::int64_t kChunk = 256;

/// As many output frames are made of those.
std::int64_t chunk_of(const Laid& laid) noexcept {
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(static_cast<double>(kChunk) / laid.step), 1, kChunk);
}

/// The frames of the source between which some output frames lie.
FrameRange needed(const Laid& laid, FrameRange output) {
  const auto first = static_cast<std::int64_t>(laid.frame_at(output.begin));
  const auto last = static_cast<std::int64_t>(std::ceil(laid.frame_at(output.end - 1)));
  return {first, std::min(last + 1, laid.stretch->source->frame_count())};
}

}  // namespace

double Laid::frame_at(std::int64_t output) const noexcept {
  const double frame = static_cast<double>(stretch->core.begin) + static_cast<double>(output - core) * step;
  return std::clamp(frame, static_cast<double>(stretch->whole.begin), static_cast<double>(last));
}

std::int64_t Laid::frame_of(std::int64_t recorded) const noexcept {
  return core + std::llround(static_cast<double>(recorded - stretch->core.begin) / step);
}

Laid lay(const Stretch& stretch, FrameRate rate, double tempo) {
  const FrameRate own = stretch.source->rate();
  return lay_by_step(stretch, own == rate ? tempo : own.hertz() / rate.hertz() * tempo);
}

Laid lay_by_step(const Stretch& stretch, double step) {
  Laid laid;
  laid.stretch = &stretch;
  laid.last = std::min(stretch.whole.end, stretch.source->frame_count() - 1);
  laid.step = step;
  const auto frames = [&](std::int64_t count) {
    return static_cast<std::int64_t>(std::min(static_cast<double>(count) / laid.step, 1e12) + 1e-9);
  };
  // No more than can be added up; the whole is checked before anything is made.
  const double core = std::min(static_cast<double>(stretch.core.size()) / laid.step, 1e12);
  laid.core_frames = std::max<std::int64_t>(1, std::llround(core));
  laid.preparation = frames(stretch.core.begin - stretch.whole.begin);
  laid.retraction = frames(stretch.whole.end - stretch.core.end);
  return laid;
}

void read_frames(const Laid& laid, FrameRange output, MutablePoses out) {
  if (output.empty()) return;
  const MotionSource& source = *laid.stretch->source;
  if (laid.captured_as_is()) {
    const std::int64_t first = laid.stretch->core.begin + output.begin - laid.core;
    source.read({first, first + output.size()}, out);
    return;
  }
  const std::size_t joints = source.skeleton()->joint_count();
  const std::size_t moved = source.skeleton()->translation_count();
  Motion captured;
  const std::int64_t chunk = chunk_of(laid);
  for (std::int64_t begin = output.begin; begin < output.end; begin += chunk) {
    const std::int64_t end = std::min(begin + chunk, output.end);
    const FrameRange frames = needed(laid, {begin, end});
    captured.reset(source.skeleton(), source.rate(), frames.size());
    source.read(frames, captured.poses({0, frames.size()}));
    for (std::int64_t frame = begin; frame < end; ++frame) {
      const auto at = static_cast<std::size_t>(frame - output.begin);
      sample(captured, laid.frame_at(frame) - static_cast<double>(frames.begin),
             {out.rotations.subspan(at * joints, joints), out.translations.subspan(at * moved, moved)});
    }
  }
}

void read_tracks(const Laid& laid, FrameRange output, std::span<const std::span<float>> out) {
  if (output.empty()) return;
  const MotionSource& source = *laid.stretch->source;
  if (laid.captured_as_is()) {
    const std::int64_t first = laid.stretch->core.begin + output.begin - laid.core;
    source.read_tracks({first, first + output.size()}, out);
    return;
  }
  const std::int64_t chunk = chunk_of(laid);
  std::vector<std::vector<float>> captured(out.size());
  std::vector<std::span<float>> spans(out.size());
  for (std::int64_t begin = output.begin; begin < output.end; begin += chunk) {
    const std::int64_t end = std::min(begin + chunk, output.end);
    const FrameRange frames = needed(laid, {begin, end});
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
        const double at = laid.frame_at(frame) - static_cast<double>(frames.begin);
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
