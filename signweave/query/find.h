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
  std::string
      tier;  ///< that it lies on; of an inferred stroke or a unit that of its signs; of a sequence of its first place
  /// In match form: the gloss of a sign; of a phase its sign's gloss and what it is, "VANNES stroke" (a label that no
  /// mapping knows stands as it is); the label of another annotation; of a sequence the names of its places with
  /// blanks.
  std::string name;
  TimeSpan span{};     ///< of a sequence: from the begin of its first place to the end of its last
  RowId row = kNoRow;  ///< of a sequence: its first place
  /// Every place in order, each followed by its partners in relations (those of groups that end there last; of a
  /// partner that is a sequence its own parts); empty for a query of one place without relations.
  std::vector<SegmentPart> parts;
  std::vector<std::pair<std::string, std::string>> bindings;  ///< variables without `$`, and their values in match form
  std::optional<float> distance = {};  ///< from the example of like(…), shoulder widths (query/example.h)
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// What a search was about.
struct FindCounts {
  std::size_t looked_at = 0;  ///< rows that the plan begins with
  std::size_t kept = 0;       ///< those of them that fulfil the conditions there
};

/// The same without its names.
struct FoundRow {
  RowId row = kNoRow;  ///< of Segments
  TimeSpan span{};
};

/// A query made ready for some segments, to be asked again and again. For one thread at a time.
class PreparedQuery {
 public:
  /// Borrows the movement; without it nothing is known of movement. Throws Error{cancelled} where `limits` say so,
  /// Error{not_found} with near matches for a scalar track that no recording has.
  PreparedQuery(PhaseQuery query, std::shared_ptr<const Segments> segments, const Movement* movement = nullptr,
                const FindLimits& limits = {});
  ~PreparedQuery();
  PreparedQuery(PreparedQuery&&) noexcept;
  PreparedQuery& operator=(PreparedQuery&&) noexcept;

  /// As `find` below.
  std::vector<Segment> find(const FindLimits& limits = {});
  /// Of the last search.
  FindCounts counts() const noexcept;
  /// The same without names, parts and bindings, instead of what was in `rows`.
  void find(std::vector<FoundRow>& rows, const FindLimits& limits = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The segments that answer a query, each once, ordered by recording (by name), begin, end, row.
/// The answer is the whole sequence, or the part that `@` marks; where several combinations of parts give one answer,
/// `parts` is the first of them in time. With like(…) the answers come by their distance, the nearest first, and
/// without a limit the kNearest nearest; those of which nothing is known are left out.
///
/// Throws Error{cancelled} where `limits` say so, Error{not_found} for a scalar track that no recording has, and
/// Error{bad_input} past five million answers without a limit.
std::vector<Segment> find(const PhaseQuery& query, const Segments& segments, const FindLimits& limits = {},
                          const Movement* movement = nullptr);

/// What in a query the database does not know (a gloss, a tier, a recording), with near matches: for an empty answer,
/// which is no error.
std::vector<Notice> hints(const PhaseQuery& query, const Segments& segments);

}  // namespace signweave
