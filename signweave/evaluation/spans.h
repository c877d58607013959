#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// A captured clip that is cut out and made again.
struct EvaluatedSpan {
  std::size_t recording = 0;
  FrameRange frames;          ///< that are made; at least one frame lies on either side
  std::size_t group = 0;      ///< in SpanChoice::groups
  Side moving = Side::right;  ///< the hand whose wrist goes farther
  std::size_t peaks = 1;      ///< of the moving wrist's speed, see docs/evaluation.md
  bool is_long = false;       ///< longer than kLongGap
};

/// What to look for, and what was found.
struct SpanChoice {
  std::vector<std::string> groups;   ///< "annotated", "170 ms", …, "natural"; or the names of a table
  std::vector<EvaluatedSpan> spans;  ///< by group, recording, time
  std::size_t left_out = 0;          ///< that a defect of the capture spoils
  std::vector<std::size_t> fixed;    ///< groups whose spans have one length, so that it tells nothing of the movement

  bool is_fixed(std::size_t group) const { return std::find(fixed.begin(), fixed.end(), group) != fixed.end(); }
};

/// Gap lengths that are looked for. Their median and spread in annotated corpora (docs/evaluation.md).
inline constexpr Milliseconds kGapLengths[] = {170ms, 280ms, 520ms, 735ms, 1064ms};

/// Annotated transitions; non-overlapping spans of kGapLengths about peaks of wrist speed, the fastest first; and
/// natural movements, from speed valley to speed valley.
SpanChoice choose_spans(std::span<const EvaluatedMotion> recordings);

/// Longer gaps often hide two speed peaks, so they are told apart by them.
inline constexpr Seconds kLongGap{0.7};

/// A span of a recording, with what is told of it. At least one frame must lie on either side.
EvaluatedSpan span_at(const EvaluatedMotion& recording, std::size_t index, FrameRange frames, std::size_t group);

/// Spans from a table: CSV with the columns file, first frame (from 0), frames, and perhaps the name of a group; a
/// first row "file,…" is a heading. A file goes by its recording's name or the end of it. Throws Error{bad_input,
/// "FILE:LINE: …"}, Error{not_found} where there is no such table.
SpanChoice read_spans(const std::filesystem::path& path, std::span<const EvaluatedMotion> recordings);

/// By group, recording, time.
void sort_spans(SpanChoice& choice);

/// A peak of wrist speed is one where no frame within the span is faster, and at least so fast. Metres a second. (ours)
inline constexpr double kLeastPeak = 0.5;
/// A valley is where the speed is lowest between two peaks and at most so much of the lower of them. (ours)
inline constexpr double kValley = 0.5;

}  // namespace signweave
