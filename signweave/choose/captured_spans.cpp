#include "signweave/choose/captured_spans.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {
namespace {

/// The transitions of one recording that are inside its motion, with a frame on both sides.
struct Found {
  std::uint32_t recording = 0;
  FrameRange frames;
};

std::vector<Found> transitions_of(const Contents& contents, std::uint32_t recording) {
  const RecordingInfo& info = contents.recordings[recording];
  const std::vector<Sign> signs = signs_of(contents.segments, recording);
  std::vector<Found> found;
  for (const AnnotatedTransition& one : transitions_in(signs)) {
    if (one.inferred || Seconds(one.span.duration()) > kLongestSpan) continue;
    const FrameRange frames = frames_of(one.span, info.clock);
    if (frames.size() >= 2 && frames.begin >= 1 && frames.end < info.motion->frames) {
      found.push_back({recording, frames});
    }
  }
  return found;
}

/// Keeps at most `most`, evenly spread.
template <class Value>
std::vector<Value> spread(const std::vector<Value>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<Value> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

/// Reads a transition with its context, and adds it and its middle half. Returns false if neither was added.
bool add(const MotionSource& source, const JointGroups& groups, FrameRange frames, Motion& memory,
         SpanCollector& collector) {
  const auto context = static_cast<std::int64_t>(std::ceil(kContext.count() * source.rate().hertz())) + 4;
  const FrameRange read{std::max<std::int64_t>(0, frames.begin - context),
                        std::min(source.frame_count(), frames.end + context)};
  memory.reset(source.skeleton(), source.rate(), read.size());
  source.read(read, memory.poses({0, read.size()}));
  const FrameRange whole{frames.begin - read.begin, frames.end - read.begin};
  const std::int64_t quarter = whole.size() / 4;
  bool kept = false;
  for (const FrameRange gap : {whole, FrameRange{whole.begin + quarter, whole.end - quarter}}) {
    const Gap captured{.skeleton = &memory.skeleton(),
                       .groups = &groups,
                       .rate = memory.rate(),
                       .before = view_of(memory, {std::max<std::int64_t>(0, gap.begin - context), gap.begin}),
                       .after = view_of(memory, {gap.end, std::min(memory.frame_count(), gap.end + context)}),
                       .count = gap.size()};
    kept = collector.add(captured, view_of(memory, gap)) || kept;
  }
  return kept;
}

}  // namespace

CapturedSpans captured_spans(const Snapshot& snapshot, const Skeleton& skeleton, const JointGroups& groups, Needs needs,
                             std::string_view without) {
  const Contents& contents = snapshot.contents();
  SpanCollector collector;
  CapturedSpans captured;
  if (without.empty()) {
    const std::shared_ptr<const semantic_db::Learned> learned = snapshot.learned();
    collector.set_residuals({learned, &learned->residuals});
  }
  if (needs != Needs::spans) {
    captured.model = collector.take_model();
    return captured;
  }
  std::vector<std::uint32_t> recordings;
  for (std::uint32_t i = 0; i < contents.recordings.size(); ++i) {
    const RecordingInfo& info = contents.recordings[i];
    if (info.name == without) continue;
    if (info.motion && info.document != 0 && info.motion->joints == skeleton.joint_count()) recordings.push_back(i);
  }
  std::vector<Found> all;
  for (const std::uint32_t recording : spread(recordings, kMostSpanRecordings)) {
    std::ranges::copy(transitions_of(contents, recording), std::back_inserter(all));
  }
  Motion memory;
  std::unique_ptr<MotionSource> source;  // of the previous recording
  std::uint32_t of = 0;
  for (const Found& one : spread(all, kMostSpanTransitions)) {
    try {
      if (!source || of != one.recording) {
        source = snapshot.motion(contents.recordings[one.recording]);
        of = one.recording;
      }
      if (difference(skeleton, *source->skeleton())) continue;
      if (add(*source, groups, one.frames, memory, collector)) ++captured.transitions;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::corrupt && error.code() != ErrorCode::not_found) throw;
    }
  }
  captured.model = collector.take_model();
  return captured;
}

}  // namespace signweave
