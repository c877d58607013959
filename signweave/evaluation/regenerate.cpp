#include "signweave/evaluation/regenerate.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>

namespace signweave {
namespace {

/// Time of this thread alone: what else the machine does does not count.
double microseconds_of_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// The frame of a side, or its outermost one where it has fewer.
std::int64_t nearest(std::int64_t frame, std::int64_t frames) {
  return std::clamp<std::int64_t>(frame, 0, frames - 1);
}

}  // namespace

Gap gap_at(const Motion& motion, const JointGroups& groups, FrameRange frames, std::int64_t count) {
  const auto context = static_cast<std::int64_t>(std::ceil(kContext.count() * motion.rate().hertz() - 1e-6)) + 1;
  return {.skeleton = &motion.skeleton(),
          .groups = &groups,
          .rate = motion.rate(),
          .before = view_of(motion, {std::max<std::int64_t>(0, frames.begin - context), frames.begin}),
          .after = view_of(motion, {frames.end, std::min(motion.frame_count(), frames.end + context)}),
          .count = count};
}

Regenerator::Made Regenerator::make(const GapMethod& method, const Gap& gap, const TransitionModel& model,
                                    BodyGuard* guard) {
  const std::size_t joints = gap.before.joints();
  const std::size_t moved = gap.before.moved();
  const auto all = static_cast<std::size_t>(gap.count + 2 * kGuard);
  rotations_.resize(all * joints);
  translations_.resize(all * moved);
  // The gap lies between captured frames here as in a motion, so that what is written past it is seen.
  const auto beside = [&](std::int64_t i) {
    return i < kGuard ? gap.before.pose(nearest(gap.before.frames - kGuard + i, gap.before.frames))
                      : gap.after.pose(nearest(i - kGuard, gap.after.frames));
  };
  const auto place = [&](std::int64_t i) { return static_cast<std::size_t>(i < kGuard ? i : gap.count + i); };
  for (std::int64_t i = 0; i < 2 * kGuard; ++i) {
    const PoseView pose = beside(i);
    std::copy(pose.rotations.begin(), pose.rotations.end(),
              rotations_.begin() + static_cast<std::ptrdiff_t>(place(i) * joints));
    std::copy(pose.translations.begin(), pose.translations.end(),
              translations_.begin() + static_cast<std::ptrdiff_t>(place(i) * moved));
  }
  const std::size_t first = static_cast<std::size_t>(kGuard);
  const auto frames = static_cast<std::size_t>(gap.count);
  // What a method leaves out is seen as well: nothing of the gap before is left here.
  std::fill_n(rotations_.begin() + static_cast<std::ptrdiff_t>(first * joints), frames * joints,
              Eigen::Quaternionf::Identity());
  std::fill_n(translations_.begin() + static_cast<std::ptrdiff_t>(first * moved), frames * moved,
              Eigen::Vector3f::Zero());
  const MutablePoses out{std::span(rotations_).subspan(first * joints, frames * joints),
                         std::span(translations_).subspan(first * moved, frames * moved)};
  const double begin = microseconds_of_thread();
  method.fill({.gap = gap, .model = model, .groups = GroupSet::all(), .scratch = scratch_}, out);
  if (guard != nullptr) guard->mend(gap, GroupSet::all(), out);
  const double took = microseconds_of_thread() - begin;

  Made made{.poses = {out.rotations, out.translations, gap.count}, .microseconds = took};
  for (std::int64_t i = 0; i < 2 * kGuard; ++i) {
    const PoseView pose = beside(i);
    const auto same = [](const auto& a, const auto* b) { return std::memcmp(a.data(), b, a.size_bytes()) == 0; };
    if (!same(pose.rotations, rotations_.data() + place(i) * joints) ||
        (moved > 0 && !same(pose.translations, translations_.data() + place(i) * moved))) {
      ++made.changed;
    }
  }
  return made;
}

}  // namespace signweave
