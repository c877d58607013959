#include "signweave/evaluation/regenerate.h"

#include <algorithm>
#include <ctime>
#include <memory>
#include <utility>

#include "signweave/render/plan.h"
#include "signweave/render/window.h"

namespace signweave {
namespace {

/// CPU time of this thread, independent of other load.
double microseconds_of_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// True if all rotations are bit-identical except for signs, and all translations are equal.
bool same_but_signs(PoseView a, PoseView b) {
  for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
    const auto& one = a.rotations[joint].coeffs();
    const auto& other = b.rotations[joint].coeffs();
    if (one != other && one != -other) return false;
  }
  return std::ranges::equal(a.translations, b.translations);
}

}  // namespace

Gap gap_at(const Motion& motion, const JointGroups& groups, FrameRange frames, std::int64_t count) {
  const std::int64_t context = context_frames(motion.rate());
  return {.skeleton = &motion.skeleton(),
          .groups = &groups,
          .rate = motion.rate(),
          .before = view_of(motion, {std::max<std::int64_t>(0, frames.begin - context), frames.begin}),
          .after = view_of(motion, {frames.end, std::min(motion.frame_count(), frames.end + context)}),
          .count = count};
}

Regenerator::Made Regenerator::make(const GapMethod& method, const CutOut& cut) {
  const TransitionMethod by{.name = method.name, .description = {}, .cut = nullptr, .fill = &method};
  const MotionClip whole{.recording = {},
                         .source = std::make_shared<BorrowedSource>(cut.motion),
                         .whole = {0, cut.motion.frame_count()},
                         .core = {0, cut.motion.frame_count()},
                         .clock = {cut.motion.rate().frame_time(), Seconds(0)},
                         .signs = {},
                         .junction = {.method = &by},
                         .noise = {std::shared_ptr<void>(), cut.noise}};
  const std::vector<MotionClip> clips = clips_around({&cut.frames, 1}, whole);
  const Plan plan = plan_with_gaps(clips, {&cut.count, 1});
  const FrameRange gap{cut.frames.begin, cut.frames.begin + cut.count};
  const std::int64_t margin = std::max(filler_.context(), kGuard);
  const FrameRange all{std::max<std::int64_t>(0, gap.begin - margin), std::min(plan.frames, gap.end + margin)};
  window_.reset(cut.motion.shared_skeleton(), cut.motion.rate(), all.size());
  const OutputWindow window{window_, all.begin};
  // Cleared, so that frames that a method does not fill are noticed.
  const MutablePoses out = window.poses(gap);
  std::ranges::fill(out.rotations, Eigen::Quaternionf::Identity());
  std::ranges::fill(out.translations, Eigen::Vector3f::Zero());
  fetch(plan.placed, window);
  const double begin = microseconds_of_thread();
  join({.clips = plan.placed, .cuts = plan.cuts}, filler_, window, scratch_);

  Made made{.poses = window.view(gap), .microseconds = microseconds_of_thread() - begin};
  for (std::int64_t i = 1; i <= kGuard; ++i) {
    for (const auto& [frame, captured] :
         {std::pair{gap.begin - i, cut.frames.begin - i}, {gap.end + i - 1, cut.frames.end + i - 1}}) {
      if (frame < 0 || frame >= plan.frames) continue;
      if (!same_but_signs(window.pose(frame), cut.motion.pose(captured))) ++made.changed;
    }
  }
  return made;
}

}  // namespace signweave
