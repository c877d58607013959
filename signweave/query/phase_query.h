#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"
#include "signweave/features/two_handed.h"
#include "signweave/query/movement_term.h"

namespace signweave {

// The syntax tree of a query on signs, phases and annotations (the paper's PhaseQuery, section 4.2). Plain data:
// docs/query.md defines its meaning, parse.h parses it, find.h evaluates it. A new kind of condition needs one
// enumerator here, one row in parse.cpp and one case in matcher.cpp.

/// The subject of a condition.
enum class Field {
  gloss,      ///< label of a sign; for a phase, that of its sign
  phase,      ///< PhaseKind of a phase
  hand,       ///< of a sign or phase, as annotated
  recording,  ///< name of the recording
  tier,       ///< label on the tier `Condition::tier`: of the segment itself, or of one that overlaps it there
  duration,
  begin,  ///< annotation time
  end,
  movement,  ///< `Condition::movement`
  hands,     ///< how both hands take part, as measured
  unit,      ///< the segment is a unit: no comparison, no value
  signer,    ///< name of the signer
  like,      ///< not a condition, but the order of the answers: by distance to an example
};

enum class Compare { equal, not_equal, matches, less, less_equal, greater, greater_equal };

/// A regular expression (RE2) that must match the whole label.
struct Regex {
  std::string pattern;
  bool ignore_case = false;
  friend bool operator==(const Regex&, const Regex&) = default;
};

/// $NAME: the same label at every use in a query.
struct QueryVariable {
  std::string name;
  friend bool operator==(const QueryVariable&, const QueryVariable&) = default;
};

/// FIELD COMPARE VALUE. The parser ensures that they fit: texts and regular expressions for gloss, recording, tier; a
/// PhaseKind (or a regular expression over their names) for phase; a Hand for hand; Hands for hands; milliseconds for
/// the times; the kind given by `value_kind` for movement. `like` has an Example and no comparison; it is allowed only
/// among the outermost operands of `&` of an element, once in a query.
struct Condition {
  Field field = Field::gloss;
  std::string tier;       ///< for Field::tier only
  MovementTerm movement;  ///< for Field::movement only
  Compare compare = Compare::equal;
  std::variant<std::string, Regex, PhaseKind, Hand, Hands, Milliseconds, Amount, Height, Across, Reach, Facing, Contact,
               Example, QueryVariable>
      value;
  friend bool operator==(const Condition&, const Condition&) = default;
};

/// From one segment to others: along the parents of annotations, or by time within one recording.
enum class Link {
  parent,      ///< the parent annotation; for a phase: its sign
  child,       ///< an annotation whose parent the segment is
  ancestor,    ///< parent, its parent, …
  descendant,  ///< child, its child, …
  overlaps,    ///< they share some time
  during,      ///< the segment lies within the other; bounds may be equal
  starts,      ///< both begin at the same millisecond
  ends,        ///< both end at the same millisecond
  equals,      ///< same begin and end
};

struct PhaseQuery;

/// A composed condition on one segment.
struct Expression {
  enum class Kind {
    condition,  ///< `condition`
    all,        ///< two or more operands, `&`
    any,        ///< two or more operands, `|`
    negation,   ///< one operand, `!`
    link,       ///< `link`(operand): one operand, or none and a sequence if the link is a relation in time
  };
  Kind kind = Kind::condition;
  Condition condition;
  Link link = Link::parent;
  std::vector<Expression> operands;
  std::vector<PhaseQuery> sequence;  ///< at most one
  friend bool operator==(const Expression&, const Expression&) = default;
};

/// An expression whose segment is a part of the answer.
struct Term {
  Expression expression;
  bool marked = false;  ///< `@`: this segment alone is the answer
  friend bool operator==(const Term&, const Term&) = default;
};

/// LINK PARTNER after a segment, by time: overlaps, during, starts, ends or equals.
struct Relation {
  Link link = Link::overlaps;
  Term term;                         ///< the partner
  std::vector<PhaseQuery> sequence;  ///< at most one: it is the partner, as a whole, and `term` is unused
  friend bool operator==(const Relation&, const Relation&) = default;
};

/// "(A -> B)": places of a sequence taken as one segment, from the begin of the first to the end of the last.
struct Group {
  std::size_t places = 1;                  ///< number of places, ending at the element it belongs to
  bool marked = false;                     ///< `@`: this segment is the answer
  std::vector<Condition> conditions = {};  ///< on duration, begin and end of the whole
  std::vector<Relation> relations = {};    ///< of the whole
  friend bool operator==(const Group&, const Group&) = default;
};

/// One place of a sequence: a segment and its required relations.
struct Element {
  Term term;
  std::vector<Relation> relations;
  std::vector<Group> groups = {};  ///< groups that end here, inner ones first
  friend bool operator==(const Element&, const Element&) = default;
};

/// The gap between two elements. Without bounds: they are neighbours on their tier. With a bound: the time from the end
/// of the first to the begin of the second, on the same tier, is in [least, most].
struct Interval {
  std::optional<Milliseconds> least;
  std::optional<Milliseconds> most;

  bool direct() const noexcept { return !least && !most; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// A whole query: one element, or a sequence of them. At most one term or group is marked, including those of partners.
/// Sequences are not nested: (A -> B) -> C is A -> B -> C.
struct PhaseQuery {
  std::vector<Element> elements;  ///< at least one
  std::vector<Interval> gaps;     ///< one fewer than elements
  friend bool operator==(const PhaseQuery&, const PhaseQuery&) = default;
};

/// The number of segments in an answer, as Segment::parts (find.h) lists them: every place, each followed by its
/// partners in relations, then those of the groups that end there; a partner that is a sequence is replaced by its
/// parts.
std::size_t part_count(const PhaseQuery& query) noexcept;
std::size_t part_count(const Relation& relation) noexcept;
/// Index of the first part of a place.
std::size_t part_of_place(const PhaseQuery& query, std::size_t place) noexcept;
/// The marked parts: several for a group; none if nothing is marked.
std::vector<std::size_t> marked_parts(const PhaseQuery& query);
/// Whether the query or something in it is marked.
bool is_marked(const PhaseQuery& query) noexcept;
bool is_marked(const Relation& relation) noexcept;

/// Calls `use(term)` for each part, in order.
template <typename Use>
void for_parts(const PhaseQuery& query, Use&& use) {
  const auto partners = [&](const std::vector<Relation>& relations) {
    for (const Relation& relation : relations) {
      if (relation.sequence.empty()) {
        use(relation.term);
      } else {
        for_parts(relation.sequence.front(), use);
      }
    }
  };
  for (const Element& element : query.elements) {
    use(element.term);
    partners(element.relations);
    for (const Group& group : element.groups) partners(group.relations);
  }
}

/// The query as text that parses to an equal tree.
std::string to_string(const PhaseQuery& query);
std::string to_string(const Expression& expression);
std::string to_string(const Condition& condition);
/// "->", "->[..500ms]", "->[100ms..500ms]".
std::string to_string(const Interval& gap);

/// The words of the language. These functions are the only place that defines their spelling.
std::string_view word_of(Field field) noexcept;
std::string_view word_of(Compare compare) noexcept;
std::string_view word_of(Link link) noexcept;
std::string_view word_of(PhaseKind kind) noexcept;
std::string_view word_of(Hand hand) noexcept;
std::string_view word_of(Hands hands) noexcept;

}  // namespace signweave
