#include "signweave/evaluation/spans.h"

#include <fmt/format.h>
#include "signweave/evaluation/frame_at.h"

#include <algorithm>
#include <cmath>

#include "signweave/evaluation/path_measures.h"
#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

using Speeds = std::array<std::vector<double>, 2>;  // [Side][frame]

/// A local maximum of one wrist's speed.
struct Peak {
  std::int64_t frame = 0;
  double speed = 0;
  Side side = Side::left;
};

constexpr Seconds kShortest{0.1};  // of a natural movement
constexpr Seconds kLongest{2.0};

std::int64_t frames_in(Seconds time, FrameRate rate) {
  return std::max<std::int64_t>(1, std::llround(time.count() * rate.hertz()));
}

Speeds speeds_of(const EvaluatedMotion& recording) {
  const PathFit fit(recording.motion.rate());
  Speeds speeds;
  for (const Side side : kSides) {
    fit.speeds(recording.tracks[static_cast<std::size_t>(side)].wrist, speeds[static_cast<std::size_t>(side)]);
  }
  return speeds;
}

/// Sorted by descending speed, then by time.
std::vector<Peak> peaks_of(const Speeds& speeds) {
  std::vector<Peak> peaks;
  for (const Side side : kSides) {
    const std::vector<double>& speed = speeds[static_cast<std::size_t>(side)];
    for (std::size_t i = 1; i + 1 < speed.size(); ++i) {
      if (speed[i] >= kLeastPeak && speed[i] >= speed[i - 1] && speed[i] > speed[i + 1]) {
        peaks.push_back({static_cast<std::int64_t>(i), speed[i], side});
      }
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) {
    return a.speed > b.speed || (a.speed == b.speed && a.frame < b.frame);
  });
  return peaks;
}

/// Non-overlapping spans of one group in one recording.
class Picker {
 public:
  Picker(const EvaluatedMotion& recording, std::size_t index, SpanChoice& choice)
      : recording_(recording), index_(index), choice_(choice), context_(frames_in(kContext, recording.motion.rate())) {}

  void begin(std::size_t group) {
    group_ = group;
    taken_.clear();
  }
  /// Takes a span unless it overlaps another, is too near to the motion's ends or contains a defect.
  void take(FrameRange frames, std::int64_t context) {
    const std::int64_t count = recording_.motion.frame_count();
    if (frames.empty() || frames.begin < std::max<std::int64_t>(1, context) ||
        frames.end + std::max<std::int64_t>(1, context) > count) {
      return;
    }
    for (const FrameRange& other : taken_) {
      if (frames.begin < other.end && other.begin < frames.end) return;
    }
    taken_.push_back(frames);
    const FrameRange seen = clamp({frames.begin - context_, frames.end + context_}, count);
    for (std::int64_t frame = seen.begin; frame < seen.end; ++frame) {
      if (!recording_.unusable[at(frame)]) continue;
      ++choice_.left_out;
      return;
    }
    choice_.spans.push_back(span_at(recording_, index_, frames, group_));
  }
  std::int64_t context() const noexcept { return context_; }

 private:
  const EvaluatedMotion& recording_;
  std::size_t index_;
  SpanChoice& choice_;
  std::int64_t context_;
  std::size_t group_ = 0;
  std::vector<FrameRange> taken_;
};

/// Takes spans of one length centred on peaks.
void take_length(const Speeds& speeds, const std::vector<Peak>& peaks, std::int64_t length, Picker& picker) {
  for (const Peak& peak : peaks) {
    const FrameRange frames{peak.frame - length / 2, peak.frame - length / 2 + length};
    const std::vector<double>& speed = speeds[static_cast<std::size_t>(peak.side)];
    if (frames.begin < 1 || frames.end >= static_cast<std::int64_t>(speed.size())) continue;
    const auto fastest = std::max_element(speed.begin() + frames.begin - 1, speed.begin() + frames.end + 1);
    if (*fastest > peak.speed) continue;
    picker.take(frames, picker.context());
  }
}

/// The valley next to a peak in direction `step`; the peak itself if there is none, or a faster frame comes first.
std::int64_t next_valley(const std::vector<double>& speed, const Peak& peak, std::int64_t step) {
  for (std::int64_t i = peak.frame + step; i >= 1 && i + 1 < static_cast<std::int64_t>(speed.size()); i += step) {
    if (speed[at(i)] > peak.speed) return peak.frame;
    const bool lowest = speed[at(i)] <= speed[at(i - 1)] && speed[at(i)] <= speed[at(i + 1)];
    if (lowest && speed[at(i)] <= kValley * peak.speed) return i;
  }
  return peak.frame;
}

void take_natural(const EvaluatedMotion& recording, const Speeds& speeds, const std::vector<Peak>& peaks,
                  Picker& picker) {
  const std::int64_t shortest = frames_in(kShortest, recording.motion.rate());
  const std::int64_t longest = frames_in(kLongest, recording.motion.rate());
  for (const Peak& peak : peaks) {
    const std::vector<double>& speed = speeds[static_cast<std::size_t>(peak.side)];
    const std::int64_t left = next_valley(speed, peak, -1);
    const std::int64_t right = next_valley(speed, peak, 1);
    const FrameRange frames{left + 1, right};  // the valleys are the borders
    if (left == peak.frame || right == peak.frame) continue;
    if (frames.size() < shortest || frames.size() > longest) continue;
    picker.take(frames, picker.context());
  }
}

/// Takes annotated transitions; if no sign has phases, the gaps between signs.
void take_annotated(const EvaluatedMotion& recording, Picker& picker) {
  const std::vector<AnnotatedTransition> transitions = transitions_in(recording.signs);
  const bool phases =
      std::any_of(transitions.begin(), transitions.end(), [](const AnnotatedTransition& one) { return !one.inferred; });
  for (const AnnotatedTransition& one : transitions) {
    if (phases && one.inferred) continue;
    picker.take(frames_of(one.span, recording.clock), 0);
  }
}

/// The number of speed peaks: a peak is at least kLeastShare of the fastest, and between two peaks the speed falls to
/// kBetween of the lower one.
std::size_t peaks_in(std::span<const double> speed) {
  constexpr double kLeastShare = 0.3;
  constexpr double kBetween = 0.75;
  const double most = *std::max_element(speed.begin(), speed.end());
  std::size_t peaks = 0;
  double high = 0;
  double low = 0;
  bool rising = true;
  for (const double one : speed) {
    if (rising) {
      high = std::max(high, one);
      if (one >= kBetween * high) continue;
      if (high >= kLeastShare * most) ++peaks;
      rising = false;
      low = one;
    } else {
      low = std::min(low, one);
      if (one * kBetween <= low) continue;
      rising = true;
      high = one;
    }
  }
  if (rising && high >= kLeastShare * most) ++peaks;
  return std::max<std::size_t>(1, peaks);
}

}  // namespace

EvaluatedSpan span_at(const EvaluatedMotion& recording, std::size_t index, FrameRange frames, std::size_t group) {
  EvaluatedSpan span{.recording = index, .frames = frames, .group = group};
  span.is_long = static_cast<double>(frames.size()) * recording.motion.rate().frame_time() > kLongGap;
  std::array<double, 2> lengths{};
  for (const Side side : kSides) {
    const std::vector<Eigen::Vector3f>& wrist = recording.tracks[static_cast<std::size_t>(side)].wrist;
    if (wrist.empty()) continue;
    lengths[static_cast<std::size_t>(side)] =
        length_of(std::span(wrist).subspan(at(frames.begin - 1), at(frames.size() + 2)));
  }
  const bool right =
      !recording.tracks[1].wrist.empty() && (lengths[1] >= lengths[0] || recording.tracks[0].wrist.empty());
  span.moving = right ? Side::right : Side::left;
  std::vector<double> speed;
  const std::vector<Eigen::Vector3f>& wrist = recording.tracks[static_cast<std::size_t>(span.moving)].wrist;
  const FrameRange seen = clamp({frames.begin - 3, frames.end + 3}, recording.motion.frame_count());
  PathFit(recording.motion.rate()).speeds(std::span(wrist).subspan(at(seen.begin), at(seen.size())), speed);
  if (!speed.empty()) span.peaks = peaks_in(std::span(speed).subspan(at(frames.begin - seen.begin), at(frames.size())));
  return span;
}

void sort_spans(SpanChoice& choice) {
  std::sort(choice.spans.begin(), choice.spans.end(), [](const EvaluatedSpan& a, const EvaluatedSpan& b) {
    return std::tuple(a.group, a.recording, a.frames.begin) < std::tuple(b.group, b.recording, b.frames.begin);
  });
}

SpanChoice choose_spans(std::span<const EvaluatedMotion> recordings) {
  SpanChoice choice;
  choice.groups.emplace_back("annotated");
  for (const Milliseconds length : kGapLengths) {
    choice.fixed.push_back(choice.groups.size());
    choice.groups.push_back(fmt::format("{} ms", length.count()));
  }
  choice.groups.emplace_back("natural");
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const EvaluatedMotion& recording = recordings[i];
    const Speeds speeds = speeds_of(recording);
    const std::vector<Peak> peaks = peaks_of(speeds);
    Picker picker(recording, i, choice);
    picker.begin(0);
    take_annotated(recording, picker);
    for (std::size_t length = 0; length < std::size(kGapLengths); ++length) {
      picker.begin(1 + length);
      take_length(speeds, peaks, frames_in(kGapLengths[length], recording.motion.rate()), picker);
    }
    picker.begin(choice.groups.size() - 1);
    take_natural(recording, speeds, peaks, picker);
  }
  sort_spans(choice);
  return choice;
}

}  // namespace signweave
