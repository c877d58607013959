#include "signweave/features/dominance.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

/// A stroke is one-handed if one palm moves this many times as far as the other, and this far, metres. (ours)
constexpr float kOneHanded = 2.5f;
constexpr float kMoves = 0.05f;
/// Fewer signs that are annotated for one hand do not count. (ours)
constexpr std::size_t kEnoughAnnotated = 10;
/// Without strokes, a motion is cut into pieces of this length. (ours)
constexpr Seconds kPieceOfMotion{0.5};

float share(double left, double right) {
  return left + right > 0 ? static_cast<float>((right - left) / (left + right)) : 0.0f;
}

float path_of(const HandTrace& trace, Side side, FrameRange frames) {
  double sum = 0;
  const std::vector<TraceSample>& samples = trace[palm_on(side)];
  for (std::int64_t i = (frames.begin + trace.step - 1) / trace.step; i * trace.step < frames.end; ++i) {
    if (i >= static_cast<std::int64_t>(samples.size())) break;
    const std::array<std::int16_t, 3>& v = samples[static_cast<std::size_t>(i)].velocity;
    sum += Eigen::Vector3d(v[0], v[1], v[2]).norm();
  }
  const double seconds = static_cast<double>(trace.step) * trace.rate.frame_time().count();
  return static_cast<float>(sum * double{TraceSample::kVelocity} * seconds);
}

}  // namespace

std::string_view name_of(const Dominance& dominance) noexcept {
  if (!dominance.hand) return "unknown";
  return *dominance.hand == Side::left ? "left" : "right";
}

std::optional<Side> only_hand(const StrokePaths& paths) noexcept {
  const float more = std::max(paths.left, paths.right);
  if (!std::isfinite(more) || more < kMoves || more < kOneHanded * std::min(paths.left, paths.right)) {
    return std::nullopt;
  }
  return paths.left > paths.right ? Side::left : Side::right;
}

Dominance dominance_of(std::span<const StrokePaths> strokes, const HandCounts& annotated) {
  StrokePaths one_handed;
  StrokePaths all;
  std::size_t count_one_handed = 0;
  std::size_t count = 0;
  for (const StrokePaths& stroke : strokes) {
    if (!std::isfinite(stroke.left) || !std::isfinite(stroke.right)) continue;
    const float more = std::max(stroke.left, stroke.right);
    if (more < kMoves) continue;
    all.left += stroke.left;
    all.right += stroke.right;
    ++count;
    if (more < kOneHanded * std::min(stroke.left, stroke.right)) continue;
    one_handed.left += stroke.left;
    one_handed.right += stroke.right;
    ++count_one_handed;
  }
  Dominance dominance;
  dominance.strokes = count_one_handed > 0 ? count_one_handed : count;
  const StrokePaths& paths = count_one_handed > 0 ? one_handed : all;
  dominance.score = share(double{paths.left}, double{paths.right});
  if (annotated.left + annotated.right >= kEnoughAnnotated) {
    const float tiers = share(static_cast<double>(annotated.left), static_cast<double>(annotated.right));
    dominance.score = dominance.strokes > 0 ? 0.5f * (dominance.score + tiers) : tiers;
  }
  if (std::abs(dominance.score) >= kDominant) dominance.hand = dominance.score > 0 ? Side::right : Side::left;
  return dominance;
}

Notice notice_unknown_hand(std::string recording, const Dominance& found) {
  return {std::move(recording),
          fmt::format("the signer's dominant hand is unknown (score {:.2f} of {} strokes, from -1 for left to 1 for "
                      "right); assumed to be the right one",
                      found.score, found.strokes)};
}

std::vector<StrokePaths> paths_in(const HandTrace& trace, std::span<const FrameRange> strokes) {
  std::vector<StrokePaths> paths;
  if (trace[TracePoint::left_palm].empty() || trace[TracePoint::right_palm].empty()) return paths;
  const auto add = [&](FrameRange frames) {
    frames = clamp(frames, trace.frames);
    paths.push_back({path_of(trace, Side::left, frames), path_of(trace, Side::right, frames)});
  };
  for (const FrameRange& stroke : strokes) add(stroke);
  if (!strokes.empty()) return paths;
  const auto piece = std::max<std::int64_t>(1, std::llround(trace.rate.hertz() * kPieceOfMotion.count()));
  for (std::int64_t begin = 0; begin < trace.frames; begin += piece) add({begin, begin + piece});
  return paths;
}

}  // namespace signweave
