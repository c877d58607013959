#include "app/calls/remake.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "signweave/choose/captured_spans.h"
#include "signweave/core/text.h"
#include "signweave/evaluation/regenerate.h"
#include "signweave/features/from_source.h"

namespace signweave::calls {
namespace {

std::optional<Milliseconds> milliseconds_in(std::string_view text) {
  std::int64_t ms = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ms);
  // No more than a day's times any frame rate can be counted.
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
  throw Error(ErrorCode::bad_input, fmt::format("--remake {}: {}", span, what));
}

std::string text_of(TimeSpan span) {
  return fmt::format("{}..{}", span.begin.count(), span.end.count());
}

/// The frames of a recording in which a gap lies, as far as a method looks, and as far as nothing else is cut out.
struct Window {
  Motion motion;
  FrameRange frames;  ///< of the recording
};

/// Joints and translations that are wanted, by their place in a pose.
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

void read(const MotionSource& source, FrameRange frames, Window& window) {
  window.frames = frames;
  window.motion.reset(source.skeleton(), source.rate(), frames.size());
  source.read(frames, window.motion.poses({0, frames.size()}));
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
    if (gap.begin < shown.begin + kBesideRemade || gap.end > shown.end - kBesideRemade) {
      refuse(text_of(span), fmt::format("{} captured frames must lie on both sides of it, and what is exported covers "
                                        "{} ms",
                                        kBesideRemade, text_of(span_of(shown, info.clock))));
    }
    if (!gaps.empty() && gap.begin < gaps.back().end + kBesideRemade) {
      refuse(text_of(span), fmt::format("{} captured frames must lie between it and the span before", kBesideRemade));
    }
    gaps.push_back(gap);
  }
  return gaps;
}

void remake(const Snapshot& snapshot, const RemakeJob& job, Motion& motion, std::vector<Notice>& notices) {
  const std::unique_ptr<MotionSource> source = snapshot.motion(job.info);
  const Skeleton& skeleton = *source->skeleton();
  if (motion.frame_count() != job.shown.size() || source->frame_count() < job.shown.end ||
      difference(motion.skeleton(), skeleton)) {
    throw Error(ErrorCode::conflict, fmt::format("'{}' was replaced meanwhile: ask again", job.info.name));
  }
  const SignerModel signer = model_of(*source, job.info.rig);
  const JointGroups groups = joint_groups(skeleton, signer.rig);
  const GapMethod& fill = *job.method.fill;
  CapturedSpans captured;
  if (fill.needs == Needs::spans) {
    captured = captured_spans(snapshot, skeleton, groups, fill.needs, job.info.name);
    if (captured.transitions == 0) {
      notices.push_back({"", fmt::format("no annotated transition of this skeleton in another recording of this "
                                         "database: '{}' goes by none, and makes the likeliest way",
                                         job.method.name)});
    }
  }
  const TransitionModel& model = captured.model ? *captured.model : default_transition_model();
  const Wanted wanted = wanted_of(skeleton, job.joints);
  std::vector<ScalarTrack> tracks = motion.take_tracks();
  BodyGuard guard(skeleton, signer, groups);
  Regenerator regenerator;
  Window window;
  const auto context = static_cast<std::int64_t>(std::ceil(kContext.count() * source->rate().hertz())) + 2;
  for (std::size_t i = 0; i < job.gaps.size(); ++i) {
    const FrameRange gap = job.gaps[i];
    const std::int64_t captured_from = i == 0 ? 0 : job.gaps[i - 1].end;
    const std::int64_t captured_to = i + 1 < job.gaps.size() ? job.gaps[i + 1].begin : source->frame_count();
    read(*source, {std::max(captured_from, gap.begin - context), std::min(captured_to, gap.end + context)}, window);
    const FrameRange here{gap.begin - window.frames.begin, gap.end - window.frames.begin};
    const Regenerator::Made made =
        regenerator.make(fill, gap_at(window.motion, groups, here, gap.size()), model, &guard);
    for (std::int64_t frame = 0; frame < gap.size(); ++frame) {
      const PoseView from = made.poses.pose(frame);
      const MutablePoseView to = motion.pose(gap.begin - job.shown.begin + frame);
      for (const std::size_t joint : wanted.rotations) to.rotations[joint] = from.rotations[joint];
      for (const std::size_t moved : wanted.translations) to.translations[moved] = from.translations[moved];
    }
    for (ScalarTrack& track : tracks) {
      const std::span<float> values(track.values);
      const auto begin = static_cast<std::size_t>(gap.begin - job.shown.begin);
      const auto count = static_cast<std::size_t>(gap.size());
      go_over(values[begin - 1], values[begin + count], values.subspan(begin, count));
    }
  }
  for (ScalarTrack& track : tracks) motion.add_track(std::move(track));
}

}  // namespace signweave::calls
