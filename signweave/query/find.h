#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/query/phase_query.h"
#include "signweave/query/stop_check.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

class Movement;

/// A row that is part of an answer.
struct SegmentPart {
  RowId row = kNoRow;  ///< of Segments
  std::string name;    ///< as Segment::name for that row alone
  TimeSpan span{};
  friend bool operator==(const SegmentPart&, const SegmentPart&) = default;
};

/// One answer (the paper, section 4.2: "each segment a name as well as starting and ending time stamps").
struct Segment {
  std::string recording;
  /// Its tier; for an inferred stroke or a unit, that of its signs; for a sequence, that of its first place.
  std::string tier;
  /// In match form. Sign: its gloss. Phase: its sign's gloss and its kind, "VANNES stroke" (a label without a mapping
  /// is used verbatim). Other annotation: its label. Sequence: the names of its places, separated by blanks.
  std::string name;
  TimeSpan span{};     ///< for a sequence: from the begin of its first place to the end of its last
  RowId row = kNoRow;  ///< for a sequence: that of its first place
  /// Every place in order, each followed by its partners in relations (those of groups that end there last; a partner
  /// that is a sequence contributes its own parts). Empty for a query of one place without relations.
  std::vector<SegmentPart> parts;
  std::vector<std::pair<std::string, std::string>> bindings;  ///< variable names without `$`, and values in match form
  std::optional<float> distance = {};  ///< to the example of like(…), in shoulder widths (query/example.h)
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Statistics of a search.
struct FindCounts {
  std::size_t looked_at = 0;  ///< rows the plan starts from
  std::size_t kept = 0;       ///< those of them that meet the conditions there
};

/// The same without names.
struct FoundRow {
  RowId row = kNoRow;  ///< of Segments
  TimeSpan span{};
};

/// A query prepared for some segments, to be run repeatedly. For one thread at a time.
class PreparedQuery {
 public:
  /// Borrows the movement; if it is null, no movement is known. Throws Error{cancelled} if `limits` require it, and
  /// Error{not_found} with near matches for a scalar track that no recording has.
  PreparedQuery(PhaseQuery query, std::shared_ptr<const Segments> segments, const Movement* movement = nullptr,
                const FindLimits& limits = {});
  ~PreparedQuery();
  PreparedQuery(PreparedQuery&&) noexcept;
  PreparedQuery& operator=(PreparedQuery&&) noexcept;

  /// As the free function `find` below.
  std::vector<Segment> find(const FindLimits& limits = {});
  /// Statistics of the last search.
  FindCounts counts() const noexcept;
  /// The same without names, parts and bindings; replaces the contents of `rows`.
  void find(std::vector<FoundRow>& rows, const FindLimits& limits = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The segments that answer a query, each once, ordered by recording (by name), begin, end, row.
/// An answer is the whole sequence, or the part marked by `@`; if several combinations of parts give one answer,
/// `parts` is the first of them in time. With like(…) the answers are ordered by distance, nearest first, and without a
/// limit the kNearest nearest are returned; answers whose movement is not known are omitted.
///
/// Throws Error{cancelled} if `limits` require it, Error{not_found} for a scalar track that no recording has, and
/// Error{bad_input} for more than five million answers without a limit.
std::vector<Segment> find(const PhaseQuery& query, const Segments& segments, const FindLimits& limits = {},
                          const Movement* movement = nullptr);

/// The names in a query that the database does not have (a gloss, a tier, a recording), with near matches. Meant for an
/// empty answer, which is not an error.
std::vector<Notice> hints(const PhaseQuery& query, const Segments& segments);

}  // namespace signweave
