#pragma once

#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/query/phase_query.h"
#include "signweave/query/watch.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// A row that takes part in an answer.
struct SegmentPart {
  RowId row = kNoRow;  ///< of Segments
  std::string name;    ///< as Segment::name of that row alone
  TimeSpan span{};
  friend bool operator==(const SegmentPart&, const SegmentPart&) = default;
};

/// One answer (the paper, section 4.2: "each segment a name as well as starting and ending time stamps").
struct Segment {
  std::string recording;
  /// In match form: the gloss of a sign; of a phase its sign's gloss and what it is, "VANNES stroke" (a label that no
  /// mapping knows stands as it is); the label of another annotation; of a sequence the names of its places with
  /// blanks.
  std::string name;
  TimeSpan span{};     ///< of a sequence: from the begin of its first place to the end of its last
  RowId row = kNoRow;  ///< of a sequence: its first place
  /// Every place in order, each followed by its partners in relations; empty for a query of one place without
  /// relations.
  std::vector<SegmentPart> parts;
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// The segments that answer a query, each once, ordered by recording (by name), begin, end, row.
/// The answer is the whole sequence, or the part that `@` marks; where several combinations of parts give one answer,
/// `parts` is the first of them in time.
///
/// Throws Error{cancelled} where `limits` say so, and Error{bad_input} past five million answers without a limit.
std::vector<Segment> find(const PhaseQuery& query, const Segments& segments, const FindLimits& limits = {});

/// What in a query the database does not know (a gloss, a tier, a recording), with near matches: for an empty answer,
/// which is no error.
std::vector<Notice> hints(const PhaseQuery& query, const Segments& segments);

}  // namespace signweave
