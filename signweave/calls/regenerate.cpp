#include "signweave/calls/regenerate.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "signweave/choose/captured_spans.h"
#include "signweave/core/text.h"
#include "signweave/features/from_source.h"
#include "signweave/render/render.h"

namespace signweave::calls {
namespace {

std::optional<Milliseconds> milliseconds_in(std::string_view text) {
  std::int64_t ms = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ms);
  // The limit leaves room for the product with any frame rate.
  constexpr std::int64_t kMost = std::int64_t{1} << 40;
  if (error != std::errc() || end != text.data() + text.size() || ms < -kMost || ms > kMost) return std::nullopt;
  return Milliseconds(ms);
}

std::optional<TimeSpan> span_in(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) return std::nullopt;
  const auto begin = milliseconds_in(text.substr(0, dots));
  const auto end = milliseconds_in(text.substr(dots + 2));
  if (!begin || !end) return std::nullopt;
  return TimeSpan{*begin, *end};
}

[[noreturn]] void refuse(std::string_view span, const std::string& what) {
  throw Error(ErrorCode::bad_input, fmt::format("regenerate {}: {}", span, what));
}

[[noreturn]] void refuse_replaced(const std::string& recording) {
  throw Error(ErrorCode::conflict, fmt::format("'{}' was replaced in the meantime: try again", recording));
}

std::string text_of(TimeSpan span) {
  return fmt::format("{}..{}", span.begin.count(), span.end.count());
}

/// The indices in a pose of the requested rotations and translations.
struct Wanted {
  std::vector<std::size_t> rotations, translations;
};

Wanted wanted_of(const Skeleton& skeleton, const JointSet& joints) {
  Wanted wanted;
  const auto is_wanted = [&](JointIndex joint) { return joints.empty() || std::ranges::binary_search(joints, joint); };
  for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
    if (is_wanted(static_cast<JointIndex>(joint))) wanted.rotations.push_back(joint);
  }
  const auto moved = skeleton.translated_joints();
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (is_wanted(moved[i])) wanted.translations.push_back(i);
  }
  return wanted;
}

}  // namespace

std::string check_span(const std::string& text) {
  const auto span = span_in(text);
  if (!span) {
    return fmt::format("'{}': expected FROM..TO in ms of annotation time, such as 1200..1800", printable(text));
  }
  return span->begin < span->end ? std::string() : fmt::format("'{}': FROM must be before TO", printable(text));
}

std::vector<FrameRange> gaps_of(std::span<const std::string> spans, const RecordingInfo& info, FrameRange shown) {
  std::vector<TimeSpan> sorted;
  for (const std::string& text : spans) {
    if (const std::string fault = check_span(text); !fault.empty()) throw Error(ErrorCode::bad_input, fault);
    sorted.push_back(*span_in(text));
  }
  std::ranges::sort(sorted, {}, &TimeSpan::begin);
  std::vector<FrameRange> gaps;
  for (const TimeSpan& span : sorted) {
    const FrameRange gap = frames_of(span, info.clock);
    if (gap.empty()) refuse(text_of(span), "no frame lies in it");
    if (gap.begin < shown.begin + kCapturedAround || gap.end > shown.end - kCapturedAround) {
      refuse(text_of(span), fmt::format("{} captured frames must lie on both sides of it, and what is exported covers "
                                        "{} ms",
                                        kCapturedAround, text_of(span_of(shown, info.clock))));
    }
    if (!gaps.empty() && gap.begin < gaps.back().end + kCapturedAround) {
      refuse(text_of(span), fmt::format("{} captured frames must lie between it and the span before", kCapturedAround));
    }
    gaps.push_back(gap);
  }
  return gaps;
}

void regenerate(const Snapshot& snapshot, const RegenerateJob& job, Motion& motion, std::vector<Notice>& notices) {
  const std::shared_ptr<const MotionSource> source = snapshot.motion(job.info);
  if (motion.frame_count() != job.shown.size() || source->frame_count() < job.shown.end ||
      difference(motion.skeleton(), *source->skeleton())) {
    refuse_replaced(job.info.name);
  }
  SignerModel signer = model_of(*source, job.info.rig);
  JointGroups groups = joint_groups(*source->skeleton(), signer.rig);
  const SignerRig rig{std::move(signer), std::move(groups)};
  const GapMethod& fill = *job.method.fill;
  CapturedSpans captured;
  if (fill.needs == Needs::spans) {
    captured = captured_spans(snapshot, *source->skeleton(), rig.groups, fill.needs, job.info.name);
    if (captured.transitions == 0) {
      notices.push_back({"", fmt::format("no annotated transition of this skeleton in another recording of this "
                                         "database: '{}' falls back to kriging",
                                         job.method.name)});
    }
  }
  const FrameRange all{0, source->frame_count()};
  const std::vector<MotionClip> clips = clips_around(
      job.gaps, {.recording = job.info.name, .source = source, .whole = all, .core = all, .clock = job.info.clock});
  std::vector<std::int64_t> counts;
  for (const FrameRange& gap : job.gaps) counts.push_back(gap.size());
  Renderer renderer(plan_with_gaps(clips, counts), {.skeleton = source->skeleton(),
                                                    .rate = source->rate(),
                                                    .method = &job.method,
                                                    .rig = &rig,
                                                    .model = captured.model.get()});
  const Wanted wanted = wanted_of(*source->skeleton(), job.joints);
  std::vector<ScalarTrack> tracks = motion.take_tracks();
  Motion made;
  for (const FrameRange& gap : job.gaps) {
    renderer.render(gap, made);
    const std::int64_t first = gap.begin - job.shown.begin;
    for (std::int64_t frame = 0; frame < gap.size(); ++frame) {
      const PoseView from = std::as_const(made).pose(frame);
      const MutablePoseView to = motion.pose(first + frame);
      for (const std::size_t joint : wanted.rotations) to.rotations[joint] = from.rotations[joint];
      for (const std::size_t moved : wanted.translations) to.translations[moved] = from.translations[moved];
    }
    for (ScalarTrack& track : tracks) {
      const auto at = std::ranges::find(made.tracks(), track.name, &ScalarTrack::name);
      if (at == made.tracks().end()) refuse_replaced(job.info.name);
      std::ranges::copy(at->values, track.values.begin() + first);
    }
  }
  for (ScalarTrack& track : tracks) motion.add_track(std::move(track));
}

}  // namespace signweave::calls
