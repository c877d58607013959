#include "signweave/render/held_clip.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "signweave/motion/motion_source.h"

namespace signweave {
namespace {

/// Frames of another source, the first and the last of them repeated. Their numbers are those of the source, so that
/// positions between them are rounded alike; repeated ones before the first may have negative numbers.
class HeldSource final : public MotionSource {
 public:
  HeldSource(std::shared_ptr<const MotionSource> source, FrameRange shown, std::int64_t after)
      : source_(std::move(source)), shown_(shown), end_(shown.end + after) {}

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return source_->skeleton(); }
  FrameRate rate() const noexcept override { return source_->rate(); }
  std::int64_t frame_count() const noexcept override { return end_; }
  std::span<const std::string> tracks() const noexcept override { return source_->tracks(); }

  void read(FrameRange frames, MutablePoses out) const override {
    const std::size_t joints = skeleton()->joint_count();
    const std::size_t moved = skeleton()->translation_count();
    const auto part = [&](FrameRange range) {
      const auto begin = static_cast<std::size_t>(range.begin - frames.begin);
      const auto size = static_cast<std::size_t>(range.size());
      return MutablePoses{out.rotations.subspan(begin * joints, size * joints),
                          out.translations.subspan(begin * moved, size * moved)};
    };
    const auto repeat = [&](FrameRange range, std::int64_t recorded) {
      if (range.empty()) return;
      source_->read({recorded, recorded + 1}, part({range.begin, range.begin + 1}));
      const MutablePoses first = part({range.begin, range.begin + 1});
      for (std::int64_t frame = range.begin + 1; frame < range.end; ++frame) {
        const MutablePoses pose = part({frame, frame + 1});
        std::ranges::copy(first.rotations, pose.rotations.begin());
        std::ranges::copy(first.translations, pose.translations.begin());
      }
    };
    const Split split = split_of(frames);
    repeat(split.before, shown_.begin);
    if (!split.shown.empty()) source_->read(split.shown, part(split.shown));
    repeat(split.after, shown_.end - 1);
  }

  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const override {
    std::vector<std::span<float>> parts(out.size());
    const auto part_of = [&](FrameRange range) {
      for (std::size_t i = 0; i < out.size(); ++i) {
        parts[i] = out[i].empty() ? out[i]
                                  : out[i].subspan(static_cast<std::size_t>(range.begin - frames.begin),
                                                   static_cast<std::size_t>(range.size()));
      }
      return std::span<const std::span<float>>(parts);
    };
    const auto repeat = [&](FrameRange range, std::int64_t recorded) {
      if (range.empty()) return;
      source_->read_tracks({recorded, recorded + 1}, part_of({range.begin, range.begin + 1}));
      for (const std::span<float> values : part_of(range)) {
        if (!values.empty()) std::ranges::fill(values.subspan(1), values.front());
      }
    };
    const Split split = split_of(frames);
    repeat(split.before, shown_.begin);
    if (!split.shown.empty()) source_->read_tracks(split.shown, part_of(split.shown));
    repeat(split.after, shown_.end - 1);
  }

 private:
  struct Split {
    FrameRange before, shown, after;
  };
  Split split_of(FrameRange frames) const noexcept {
    const std::int64_t begin = std::clamp(shown_.begin, frames.begin, frames.end);
    const std::int64_t end = std::clamp(shown_.end, begin, frames.end);
    return {{frames.begin, begin}, {begin, end}, {end, frames.end}};
  }

  std::shared_ptr<const MotionSource> source_;
  FrameRange shown_;
  std::int64_t end_;
};

std::int64_t recorded_frames(std::int64_t output, double step) {
  return output > 0 ? static_cast<std::int64_t>(std::ceil(static_cast<double>(output) * step)) + 1 : 0;
}

}  // namespace

HeldClip hold(const PlacedClip& placed, const HeldFrames& held) {
  const MotionClip& clip = *placed.captured;
  PlacedClip alone = placed;
  alone.core = 0;
  const bool holds_last = held.after_core > 0 || held.at_end > 0;
  std::int64_t end = std::min(clip.whole.end + 1, clip.source->frame_count());  // as PlacedClip::last
  if (holds_last) {
    const std::int64_t shown_after = held.after_core > 0 ? 0 : placed.after;
    const double last = alone.frame_at(placed.core_frames + shown_after - 1);
    end = std::min(clip.source->frame_count(), static_cast<std::int64_t>(std::ceil(last)) + 1);
  }
  const FrameRange shown{clip.whole.begin, end};
  const std::int64_t before = recorded_frames(held.before, placed.step);
  const std::int64_t after = recorded_frames(held.after_core + held.at_end, placed.step);

  auto made = std::make_shared<MotionClip>(clip);
  made->source = std::make_shared<HeldSource>(clip.source, shown, after);
  made->whole = {shown.begin - before, holds_last ? made->source->frame_count() : clip.whole.end};
  made->core = {clip.core.begin, held.after_core > 0 ? made->whole.end : std::min(made->whole.end, clip.core.end)};

  HeldClip result{.clip = made, .placed = placed_by_step(*made, placed.step)};
  PlacedClip& now = result.placed;
  now.core_frames = placed.core_frames + held.after_core;
  now.preparation = placed.preparation + held.before;
  now.retraction = held.after_core > 0 ? 0 : held.at_end > 0 ? placed.after + held.at_end : placed.retraction;
  now.before = placed.before;
  now.after = std::min(placed.after, now.retraction);
  now.core = placed.core;
  now.standing = placed.standing;
  return result;
}

}  // namespace signweave
