#include "signweave/features/hand_rest.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace signweave {
namespace {

// A hand at shoulder height costs kHigh; kSpeed costs 1. (ours)
constexpr float kHigh = 3;
constexpr float kSpeed = 0.5f;    // metres a second
constexpr float kStill = 0.02f;   // costs nothing
constexpr float kSimilar = 0.1f;  // moments that differ less are equally at rest

float cost_of(const TraceSample& sample, float hips) {
  const float height = static_cast<float>(sample.position[1]) * TraceSample::kPosition;
  double squares = 0;
  for (const std::int16_t one : sample.velocity) squares += static_cast<double>(one) * one;
  const float speed = static_cast<float>(std::sqrt(squares)) * TraceSample::kVelocity;
  return kHigh * std::max(0.0f, 1 - height / hips) + std::max(0.0f, (speed - kStill) / kSpeed);
}

}  // namespace

std::optional<FrameRange> hand_rest(const HandTrace& trace, Side side, std::int64_t near) {
  const std::vector<TraceSample>& samples = trace[palm_on(side)];
  if (samples.empty() || trace.frames <= 0) return std::nullopt;
  const float hips = std::min(-0.1f, trace.body.heights[static_cast<std::size_t>(Height::waist)]);
  std::vector<float> costs;
  costs.reserve(samples.size());
  for (const TraceSample& sample : samples) costs.push_back(cost_of(sample, hips));
  const float least = *std::ranges::min_element(costs);
  std::int64_t best = 0;
  std::int64_t distance = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (costs[i] > least + kSimilar) continue;
    const std::int64_t frame = std::min(static_cast<std::int64_t>(i) * trace.step, trace.frames - 1);
    if (std::abs(frame - near) >= distance) continue;
    distance = std::abs(frame - near);
    best = frame;
  }
  const auto around = static_cast<std::int64_t>(kRestLength.count() * trace.rate.hertz() / 2);
  return FrameRange{std::max<std::int64_t>(0, best - around),
                    std::min(trace.frames, best + std::max<std::int64_t>(around, 1))};
}

}  // namespace signweave
