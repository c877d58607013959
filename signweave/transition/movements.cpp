#include "signweave/transition/movements.h"

#include <algorithm>
#include <cmath>

#include "signweave/transition/fill.h"
#include "signweave/transition/learned.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Minimum speed of a peak; a valley is at most half as fast. Arm lengths a second. (ours)
constexpr float kLeastPeak = 1.0f;
constexpr float kValley = 0.5f;
/// Seconds.
constexpr double kLengths[] = {0.4, 0.52, 0.735, 1.064};
constexpr double kShortest = 0.1;
constexpr double kLongest = 1.5;
/// Speeds are measured over this time on both sides. Seconds.
constexpr double kHalfStep = 0.03;

std::int64_t frames_in(double seconds, FrameRate rate) {
  return std::max<std::int64_t>(1, std::llround(seconds * rate.hertz()));
}

std::vector<float> speeds_of(const Motion& motion, const ArmChain& chain, ArmScratch& scratch) {
  std::vector<Vector3f> path;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    path.push_back(place_arm(chain, motion.pose(frame), scratch.pose));
  }
  const auto& at = scratch.pose.positions;
  const auto of = [&](JointIndex joint) { return at[static_cast<std::size_t>(joint)]; };
  const float length = (of(chain.joints.elbow) - of(chain.joints.shoulder)).norm() +
                       (of(chain.joints.wrist) - of(chain.joints.elbow)).norm();
  std::vector<float> speeds(path.size(), 0.0f);
  const auto half = static_cast<std::size_t>(frames_in(kHalfStep, motion.rate()));
  const auto unit = static_cast<float>(motion.rate().hertz()) / static_cast<float>(2 * half) / length;
  for (std::size_t i = half; i + half < path.size(); ++i) speeds[i] = unit * (path[i + half] - path[i - half]).norm();
  return speeds;
}

/// The fastest first.
std::vector<std::int64_t> peaks_of(const std::vector<float>& speeds) {
  std::vector<std::int64_t> peaks;
  for (std::size_t i = 1; i + 1 < speeds.size(); ++i) {
    if (speeds[i] >= kLeastPeak && speeds[i] >= speeds[i - 1] && speeds[i] > speeds[i + 1]) {
      peaks.push_back(static_cast<std::int64_t>(i));
    }
  }
  std::ranges::stable_sort(peaks, [&](std::int64_t a, std::int64_t b) {
    return speeds[static_cast<std::size_t>(a)] > speeds[static_cast<std::size_t>(b)];
  });
  return peaks;
}

/// The slowest frame next to a peak in direction `step`; the peak itself if a faster frame comes first.
std::int64_t adjacent_valley(const std::vector<float>& speeds, std::int64_t peak, std::int64_t step) {
  const auto speed = [&](std::int64_t frame) { return speeds[static_cast<std::size_t>(frame)]; };
  for (std::int64_t i = peak + step; i >= 1 && i + 1 < static_cast<std::int64_t>(speeds.size()); i += step) {
    if (!(speed(i) <= speed(peak))) return peak;
    if (speed(i) <= speed(i - 1) && speed(i) <= speed(i + 1) && speed(i) <= kValley * speed(peak)) return i;
  }
  return peak;
}

}  // namespace

std::vector<FrameRange> captured_movements(const Motion& motion, const JointGroups& groups, std::size_t most,
                                           ArmScratch& scratch) {
  std::vector<FrameRange> all;
  const std::int64_t context = frames_in(0.1, motion.rate()) + 1;
  const std::int64_t count = motion.frame_count();
  // Movements of one kind do not overlap, whichever hand they are of.
  const auto take = [&](FrameRange frames, std::size_t first) {
    if (frames.begin < context || frames.end + context > count) return;
    for (std::size_t i = first; i < all.size(); ++i) {
      if (frames.begin < all[i].end && all[i].begin < frames.end) return;
    }
    all.push_back(frames);
  };
  std::array<std::vector<float>, 2> speeds;
  std::array<std::vector<std::int64_t>, 2> peaks;
  for (const Side side : kSides) {
    const auto s = static_cast<std::size_t>(side);
    find_arm(motion.skeleton(), groups, side, scratch.chains[s]);
    if (!scratch.chains[s].known() || count < 2 * context) continue;
    speeds[s] = speeds_of(motion, scratch.chains[s], scratch);
    peaks[s] = peaks_of(speeds[s]);
  }
  for (const double length : kLengths) {
    const std::size_t first = all.size();
    const std::int64_t frames = frames_in(length, motion.rate());
    for (std::size_t s = 0; s < 2; ++s) {
      for (const std::int64_t peak : peaks[s]) take({peak - frames / 2, peak - frames / 2 + frames}, first);
    }
  }
  const std::size_t first = all.size();
  for (std::size_t s = 0; s < 2; ++s) {
    for (const std::int64_t peak : peaks[s]) {
      const FrameRange frames{adjacent_valley(speeds[s], peak, -1) + 1, adjacent_valley(speeds[s], peak, 1)};
      if (frames.begin > peak || frames.end <= peak || frames.size() < frames_in(kShortest, motion.rate()) ||
          frames.size() > frames_in(kLongest, motion.rate())) {
        continue;
      }
      take(frames, first);
    }
  }
  std::ranges::stable_sort(all, [](FrameRange a, FrameRange b) { return a.begin < b.begin; });
  if (all.size() <= most) return all;
  std::vector<FrameRange> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

std::vector<ResidualSpan> residual_spans(const Motion& motion, const JointGroups& groups,
                                         const std::vector<FrameRange>& movements, std::size_t fold) {
  static const TransitionModel kUntaught;
  const std::int64_t context = frames_in(kContext.count(), motion.rate());
  GapScratch scratch;
  Motion kriged;
  std::vector<ResidualSpan> spans;
  for (const FrameRange& frames : movements) {
    const Gap gap{.skeleton = &motion.skeleton(),
                  .groups = &groups,
                  .rate = motion.rate(),
                  .before = view_of(motion, {std::max<std::int64_t>(0, frames.begin - context), frames.begin}),
                  .after = view_of(motion, {frames.end, std::min(motion.frame_count(), frames.end + context)}),
                  .count = frames.size()};
    kriged.reset(motion.shared_skeleton(), motion.rate(), frames.size());
    fill_kriging({.gap = gap, .model = kUntaught, .scratch = scratch}, kriged.poses({0, frames.size()}));
    if (auto span =
            residual_span(fold, gap, view_of(motion, frames), view_of(kriged, {0, frames.size()}), scratch.arms)) {
      spans.push_back(*std::move(span));
    }
  }
  return spans;
}

}  // namespace signweave
