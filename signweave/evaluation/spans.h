#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// A captured span that is cut out and regenerated.
struct EvaluatedSpan {
  std::size_t recording = 0;
  FrameRange frames;          ///< regenerated frames; at least one frame is on either side
  std::size_t group = 0;      ///< in SpanChoice::groups
  Side moving = Side::right;  ///< the hand whose wrist moves farther
  std::size_t peaks = 1;      ///< of the moving wrist's speed, see docs/evaluation.md
  bool is_long = false;       ///< longer than kLongGap
};

/// The chosen spans and their groups.
struct SpanChoice {
  std::vector<std::string> groups;   ///< "annotated", "170 ms", …, "natural"; or the names in a table
  std::vector<EvaluatedSpan> spans;  ///< by group, recording, time
  std::size_t left_out = 0;          ///< number left out because of capture defects
  std::vector<std::size_t> fixed;    ///< groups whose spans have one length, independent of the movement

  bool is_fixed(std::size_t group) const { return std::find(fixed.begin(), fixed.end(), group) != fixed.end(); }
};

/// Lengths of the chosen gaps, after their median and spread in annotated corpora (docs/evaluation.md).
inline constexpr Milliseconds kGapLengths[] = {170ms, 280ms, 520ms, 735ms, 1064ms};

/// Chooses annotated transitions; non-overlapping spans of kGapLengths around peaks of wrist speed, the fastest first;
/// and natural movements, from speed valley to speed valley.
SpanChoice choose_spans(std::span<const EvaluatedMotion> recordings);

/// Longer gaps often contain two speed peaks, so they are distinguished by their number.
inline constexpr Seconds kLongGap{0.7};

/// Describes a span of a recording. There must be at least one frame on either side.
EvaluatedSpan span_at(const EvaluatedMotion& recording, std::size_t index, FrameRange frames, std::size_t group);

/// Reads spans from a table: CSV with the columns file, first frame (from 0), frames and, optionally, the name of a
/// group; a first row "file,…" is a heading. A file is given by its recording's name or the end of it. Throws
/// Error{bad_input, "FILE:LINE: …"}, Error{not_found} if the table does not exist.
SpanChoice read_spans(const std::filesystem::path& path, std::span<const EvaluatedMotion> recordings);

/// Sorts spans by group, recording, time.
void sort_spans(SpanChoice& choice);

/// Minimum speed of a peak, at which no frame within the span is faster. Metres a second. (ours)
inline constexpr double kLeastPeak = 0.5;
/// Maximum speed of a valley, relative to the lower of the two peaks around it. (ours)
inline constexpr double kValley = 0.5;

}  // namespace signweave
