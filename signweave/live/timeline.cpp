#include "signweave/live/timeline.h"

#include <algorithm>

namespace signweave {

void Timeline::append(FrameRange frames, const std::shared_ptr<LiveClip>& clip) {
  if (frames.empty()) return;
  if (!segments_.empty() && segments_.back().clip == clip && segments_.back().frames.end == frames.begin) {
    segments_.back().frames.end = frames.end;
  } else {
    segments_.push_back({.frames = frames, .clip = clip, .made = {}});
  }
  end_ = frames.end;
}

void Timeline::append(FrameRange frames, std::shared_ptr<const Motion> made) {
  if (frames.empty()) return;
  const std::int64_t begin = frames.end - made->frame_count();
  segments_.push_back({.frames = frames, .clip = {}, .made = std::move(made), .made_begin = begin});
  end_ = frames.end;
}

void Timeline::cut(std::int64_t end) noexcept {
  while (!segments_.empty() && segments_.back().frames.begin >= end) segments_.pop_back();
  if (!segments_.empty()) segments_.back().frames.end = std::min(segments_.back().frames.end, end);
  end_ = std::min(end_, end);
}

void Timeline::begin_anew(std::int64_t next) noexcept {
  segments_.clear();
  end_ = next;
}

void Timeline::forget(std::int64_t taken) noexcept {
  while (!segments_.empty() && segments_.front().frames.end <= taken) segments_.pop_front();
}

void Timeline::replace(const std::shared_ptr<LiveClip>& clip, const std::shared_ptr<LiveClip>& by) noexcept {
  for (Segment& segment : segments_) {
    if (segment.clip == clip) segment.clip = by;
  }
}

const Timeline::Segment* Timeline::segment_at(std::int64_t frame) const noexcept {
  const auto at = std::ranges::find_if(
      segments_, [&](const Segment& one) { return one.frames.begin <= frame && frame < one.frames.end; });
  return at == segments_.end() ? nullptr : &*at;
}

std::shared_ptr<LiveClip> Timeline::clip_at(std::int64_t frame) const noexcept {
  const Segment* const segment = segment_at(frame);
  return segment == nullptr ? nullptr : segment->clip;
}

std::int64_t Timeline::end_of_same(std::int64_t frame) const noexcept {
  const Segment* const segment = segment_at(frame);
  return segment == nullptr ? frame : segment->frames.end;
}

void Timeline::read(FrameRange frames, const TransitionBuilder& builder, FrameRing& ring) {
  const Segment& segment = *segment_at(frames.begin);
  const auto count = static_cast<std::size_t>(frames.size());
  const MutablePoses out = ring.poses(frames.size());
  const std::size_t tracks = builder.tracks().size();
  if (segment.made != nullptr) {
    const Motion& made = *segment.made;
    const auto first = static_cast<std::size_t>(frames.begin - segment.made_begin);
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
  builder.read(*segment.clip, frames, out, track_spans_);
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<float> values = ring.tracks(static_cast<std::int64_t>(k));
    for (std::size_t i = 0; i < tracks; ++i) values[i] = track_spans_[i][k];
  }
}

}  // namespace signweave
