#include "signweave/live/timeline.h"

#include <algorithm>
#include <cassert>

namespace signweave {

void Timeline::append(FrameRange frames, const std::shared_ptr<LiveClip>& clip) {
  if (frames.empty()) return;
  if (!runs_.empty() && runs_.back().clip == clip && runs_.back().frames.end == frames.begin) {
    runs_.back().frames.end = frames.end;
  } else {
    runs_.push_back({.frames = frames, .clip = clip, .made = {}});
  }
  end_ = frames.end;
}

void Timeline::append(FrameRange frames, std::shared_ptr<const Motion> made) {
  if (frames.empty()) return;
  const std::int64_t begin = frames.end - made->frame_count();
  append(frames, std::move(made), begin);
}

void Timeline::append(FrameRange frames, std::shared_ptr<const Motion> made, std::int64_t begin) {
  if (frames.empty()) return;
  assert(begin <= frames.begin && frames.end <= begin + made->frame_count());
  runs_.push_back({.frames = frames, .clip = {}, .made = std::move(made), .made_begin = begin});
  end_ = frames.end;
}

void Timeline::cut(std::int64_t end) noexcept {
  while (!runs_.empty() && runs_.back().frames.begin >= end) runs_.pop_back();
  if (!runs_.empty()) runs_.back().frames.end = std::min(runs_.back().frames.end, end);
  end_ = std::min(end_, end);
}

void Timeline::restart(std::int64_t next) noexcept {
  runs_.clear();
  end_ = next;
}

void Timeline::forget(std::int64_t taken) noexcept {
  while (!runs_.empty() && runs_.front().frames.end <= taken) runs_.pop_front();
}

void Timeline::replace(const std::shared_ptr<LiveClip>& clip, const std::shared_ptr<LiveClip>& by) noexcept {
  for (Run& run : runs_) {
    if (run.clip == clip) run.clip = by;
  }
}

const Timeline::Run* Timeline::run_at(std::int64_t frame) const noexcept {
  const auto at =
      std::ranges::find_if(runs_, [&](const Run& one) { return one.frames.begin <= frame && frame < one.frames.end; });
  return at == runs_.end() ? nullptr : &*at;
}

std::shared_ptr<LiveClip> Timeline::clip_at(std::int64_t frame) const noexcept {
  const Run* const run = run_at(frame);
  return run == nullptr ? nullptr : run->clip;
}

std::int64_t Timeline::end_of_same(std::int64_t frame) const noexcept {
  const Run* const run = run_at(frame);
  return run == nullptr ? frame : run->frames.end;
}

void Timeline::read(FrameRange frames, const TransitionBuilder& builder, FrameRing& ring) {
  const Run& run = *run_at(frames.begin);
  const auto count = static_cast<std::size_t>(frames.size());
  const MutablePoses out = ring.poses(frames.size());
  const std::size_t tracks = builder.tracks().size();
  if (run.made != nullptr) {
    const Motion& made = *run.made;
    const auto first = static_cast<std::size_t>(frames.begin - run.made_begin);
    const std::size_t joints = made.skeleton().joint_count();
    const std::size_t moved = made.skeleton().translation_count();
    std::ranges::copy(made.rotations().subspan(first * joints, count * joints), out.rotations.begin());
    std::ranges::copy(made.translations().subspan(first * moved, count * moved), out.translations.begin());
    for (std::size_t k = 0; k < count; ++k) {
      const std::span<float> values = ring.tracks(static_cast<std::int64_t>(k));
      for (std::size_t i = 0; i < tracks; ++i) values[i] = made.tracks()[i].values[first + k];
    }
    return;
  }
  track_values_.resize(tracks * count);
  track_spans_.clear();
  for (std::size_t i = 0; i < tracks; ++i) track_spans_.push_back(std::span(track_values_).subspan(i * count, count));
  builder.read(*run.clip, frames, out, track_spans_);
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<float> values = ring.tracks(static_cast<std::int64_t>(k));
    for (std::size_t i = 0; i < tracks; ++i) values[i] = track_spans_[i][k];
  }
}

}  // namespace signweave
