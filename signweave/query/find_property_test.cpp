#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <re2/re2.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "signweave/core/text.h"
#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"
#include "signweave/query/queries_for_tests.h"

namespace signweave {
namespace {

/// Up to three recordings of at most 40 ms, so that bounds often coincide. Labels A, B, C and occasionally an empty
/// one.
SegmentTable random_table(std::mt19937& random) {
  const auto below = [&](unsigned most) { return random() % most; };
  const auto label = [&] { return std::string(below(6) == 0 ? "" : below(3) == 0 ? "B " : below(2) == 0 ? "C" : "A"); };
  TestCorpus corpus;
  const unsigned recordings = below(4);
  for (unsigned r = 0; r < recordings; ++r) {
    corpus.recording(fmt::format("r{}", r)).tier("Sentence").tier("Mouth").tier("Gloss", "Sentence").tier("Left");
    corpus.tier("Phase", "Gloss").tier("LeftPhase", "Left");
    std::vector<std::pair<std::string, TimeSpan>> sentences;
    const bool faulty = below(5) == 0;
    const auto spans = [&](unsigned longest, unsigned gap, bool may_overlap) {
      std::vector<TimeSpan> result;
      for (unsigned at = below(5); at < 40;) {
        const unsigned end = at + below(longest);
        result.push_back({Milliseconds(at), Milliseconds(end)});
        at = (may_overlap && below(3) == 0 ? (at + end) / 2 : end) + (end == at ? 1 : 0) + below(gap);
      }
      return result;
    };
    for (const TimeSpan span : spans(20, 3, false)) {
      sentences.emplace_back(corpus.annotation_on("Sentence", label(), span), span);
    }
    for (const TimeSpan span : spans(8, 5, faulty)) corpus.annotation_on("Mouth", label(), span);
    for (const char* tier : {"Gloss", "Left"}) {
      const bool left = std::string(tier) == "Left";
      for (const TimeSpan span : spans(9, 4, faulty)) {
        const std::string gloss = label();
        std::string parent;
        for (const auto& [id, sentence] : sentences) {
          if (!left && sentence.contains(span)) parent = id;
        }
        if (gloss.empty()) {
          corpus.annotation_on(tier, gloss, span, parent);
          continue;
        }
        std::vector<TestCorpus::PhaseToBe> phases;
        for (Milliseconds at = span.begin; below(4) != 0 && at < span.end;) {
          at = std::min(span.end, at + Milliseconds(1 + below(5)));
          phases.push_back({static_cast<PhaseKind>(below(5)), at});
        }
        corpus.sign(tier, gloss, span, phases, left ? Hand::left : Hand::right, parent, left ? "LeftPhase" : "Phase");
      }
    }
    corpus.annotation_on("Phase", "s", {50ms, 55ms});
  }
  return corpus.table();
}

/// Reference implementation of docs/query.md: tries every row and multiplies every expression out. Slow and simple.
class Oracle {
 public:
  explicit Oracle(const SegmentTable& table) : table_(table) {}

  std::set<std::vector<RowId>> answers(const PhaseQuery& query) {
    std::set<std::vector<RowId>> result;
    for (const Found& found : all(query)) {
      if (is_marked(query)) {
        result.insert(found.marked.begin(), found.marked.end());
      } else {
        result.insert(found.places);
      }
    }
    return result;
  }

 private:
  struct Literal {
    const Expression* expression;
    bool positive;
  };
  using Alternative = std::vector<Literal>;

  /// One assignment of rows to the places of a query, and the marked rows it gives.
  struct Found {
    std::vector<RowId> places;
    std::set<std::vector<RowId>> marked;
  };

  const std::vector<Found>& all(const PhaseQuery& query) const {
    const auto known = found_.find(&query);
    if (known != found_.end()) return known->second;
    std::vector<Found> result;
    std::vector<RowId> places;
    search(query, places, result);
    return found_[&query] = std::move(result);
  }

  void search(const PhaseQuery& query, std::vector<RowId>& places, std::vector<Found>& result) const {
    if (places.size() == query.elements.size()) return keep(query, places, result);
    for (RowId row = 0; row < table_.size(); ++row) {
      if (table_.kind(row) == RowKind::unit) continue;  // no query here uses them
      if (!places.empty() && !may_follow(places.back(), row, query.gaps[places.size() - 1])) continue;
      if (!answers(query.elements[places.size()].term.expression, row, false)) continue;
      places.push_back(row);
      search(query, places, result);
      places.pop_back();
    }
  }

  TimeSpan span_of(const std::vector<RowId>& rows) const {
    return {row(rows.front()).span.begin, row(rows.back()).span.end};
  }

  void keep(const PhaseQuery& query, const std::vector<RowId>& places, std::vector<Found>& result) const {
    Found found{places, {}};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Element& element = query.elements[i];
      if (element.term.marked) found.marked.insert({places[i]});
      for (const Relation& relation : element.relations) {
        if (!has_partner({places[i]}, relation, found.marked)) return;
      }
      for (const Group& group : element.groups) {
        const auto last = places.begin() + static_cast<std::ptrdiff_t>(i) + 1;
        const std::vector<RowId> whole(last - static_cast<std::ptrdiff_t>(group.places), last);
        const TimeSpan span = span_of(whole);
        for (const Condition& condition : group.conditions) {
          const bool begin = condition.field == Field::begin;
          const Milliseconds time = begin                           ? span.begin
                                    : condition.field == Field::end ? span.end
                                                                    : span.end - span.begin;
          if (!compare(time, condition)) return;
        }
        if (group.marked) found.marked.insert(whole);
        for (const Relation& relation : group.relations) {
          if (!has_partner(whole, relation, found.marked)) return;
        }
      }
    }
    result.push_back(std::move(found));
  }

  bool has_partner(const std::vector<RowId>& of, const Relation& relation, std::set<std::vector<RowId>>& marked) const {
    if (!relation.sequence.empty()) return has_sequence(of, relation.link, relation.sequence.front(), marked);
    bool any = false;
    for (RowId other = 0; other < table_.size(); ++other) {
      if (std::find(of.begin(), of.end(), other) != of.end() || row(other).recording != row(of.front()).recording)
        continue;
      if (!spans_stand_in(span_of(of), relation.link, row(other).span)) continue;
      if (!answers(relation.term.expression, other, false)) continue;
      any = true;
      if (relation.term.marked) marked.insert({other});
    }
    return any;
  }

  bool has_sequence(const std::vector<RowId>& of, Link link, const PhaseQuery& sequence,
                    std::set<std::vector<RowId>>& marked) const {
    bool any = false;
    const auto apart = [&](RowId other) { return std::find(of.begin(), of.end(), other) == of.end(); };
    for (const Found& other : all(sequence)) {
      if (row(other.places.front()).recording != row(of.front()).recording) continue;
      if (!std::all_of(other.places.begin(), other.places.end(), apart)) continue;
      if (!spans_stand_in(span_of(of), link, span_of(other.places))) continue;
      any = true;
      marked.insert(other.marked.begin(), other.marked.end());
    }
    return any;
  }

  SegmentRow row(RowId id) const { return table_.row(id); }

  bool same_group(RowId a, RowId b) const {
    if (row(a).kind == RowKind::unit || row(b).kind == RowKind::unit) return false;  // no query here uses units
    if (row(a).recording != row(b).recording || row(a).tier != row(b).tier || row(a).extra != row(b).extra)
      return false;
    return a != b;
  }

  bool may_follow(RowId a, RowId b, const Interval& gap) const {
    if (!same_group(a, b) || b < a) return false;
    if (!gap.direct()) {
      const Milliseconds between = row(b).span.begin - row(a).span.end;
      return between >= gap.least.value_or(0ms) && (!gap.most || between <= *gap.most);
    }
    if (row(a).extra) return direct_signs(row(a).parent, row(b).parent);
    if (row(a).kind == RowKind::sign) return direct_signs(a, b);
    return b == a + 1;
  }

  bool direct_signs(RowId a, RowId b) const {
    if (row(b).kind != RowKind::sign) return false;
    for (RowId between = a + 1; between < b; ++between) {
      if (row(between).kind == RowKind::sign) return false;
    }
    return true;
  }

  bool stand_in(RowId a, Link link, RowId b) const {
    return a != b && row(a).recording == row(b).recording && spans_stand_in(row(a).span, link, row(b).span);
  }

  static bool spans_stand_in(TimeSpan one, Link link, TimeSpan other) {
    switch (link) {
      case Link::overlaps:
        return std::max(one.begin, other.begin) < std::min(one.end, other.end) ||
               (one.begin < other.end && other.begin < one.end);
      case Link::during:
        return other.begin <= one.begin && one.end <= other.end;
      case Link::starts:
        return one.begin == other.begin;
      case Link::ends:
        return one.end == other.end;
      default:
        return one.begin == other.begin && one.end == other.end;
    }
  }

  std::vector<Alternative> alternatives(const Expression& expression) const {
    if (expression.kind == Expression::Kind::any) {
      std::vector<Alternative> result;
      for (const Expression& operand : expression.operands) {
        for (Alternative& each : alternatives(operand)) result.push_back(std::move(each));
      }
      return result;
    }
    if (expression.kind == Expression::Kind::all) {
      std::vector<Alternative> result = {{}};
      for (const Expression& operand : expression.operands) {
        std::vector<Alternative> product;
        for (const Alternative& left : result) {
          for (const Alternative& right : alternatives(operand)) {
            product.push_back(left);
            product.back().insert(product.back().end(), right.begin(), right.end());
          }
        }
        result = std::move(product);
      }
      return result;
    }
    if (expression.kind == Expression::Kind::negation) return {{{&expression.operands[0], false}}};
    return {{{&expression, true}}};
  }

  struct About {
    bool phase = false;
    bool gloss = false;
    bool link = false;
    std::set<std::string> tiers;
  };

  void look_at(const Expression& expression, About& about) const {
    if (expression.kind == Expression::Kind::link) {
      about.link = about.link || expression.link <= Link::descendant;
      return;
    }
    if (expression.kind == Expression::Kind::condition) {
      const Field field = expression.condition.field;
      about.phase = about.phase || field == Field::phase;
      about.gloss = about.gloss || field == Field::gloss || field == Field::hand;
      if (field == Field::tier) about.tiers.insert(expression.condition.tier);
    }
    for (const Expression& operand : expression.operands) look_at(operand, about);
  }

  void tiers_in_order(const Expression& expression, std::vector<std::string>& tiers) const {
    if (expression.kind == Expression::Kind::link) return;
    if (expression.kind == Expression::Kind::condition && expression.condition.field == Field::tier) {
      tiers.push_back(expression.condition.tier);
    }
    for (const Expression& operand : expression.operands) tiers_in_order(operand, tiers);
  }

  bool answers(const Expression& expression, RowId id, bool linked) const {
    std::vector<std::string> order;
    tiers_in_order(expression, order);
    for (const Alternative& alternative : alternatives(expression)) {
      About about;
      for (const Literal& literal : alternative) look_at(*literal.expression, about);
      const auto first =
          std::find_if(order.begin(), order.end(), [&](auto& tier) { return about.tiers.contains(tier); });
      const SegmentRow& it = row(id);
      const bool fits = it.kind == RowKind::unit ? false
                        : about.phase            ? it.kind == RowKind::phase
                        : about.gloss            ? it.kind == RowKind::sign
                        : first != order.end()   ? !it.extra && table_.tier_at(it.tier) == *first
                        : about.link || linked   ? true
                                                 : it.kind == RowKind::sign;
      if (fits && std::all_of(alternative.begin(), alternative.end(), [&](const Literal& literal) {
            return is_true(*literal.expression, id) == literal.positive;
          })) {
        return true;
      }
    }
    return false;
  }

  bool is_true(const Expression& expression, RowId id) const {
    const auto each = [&](const Expression& operand) { return is_true(operand, id); };
    switch (expression.kind) {
      case Expression::Kind::condition:
        return is_true(expression.condition, id);
      case Expression::Kind::all:
        return std::all_of(expression.operands.begin(), expression.operands.end(), each);
      case Expression::Kind::any:
        return std::any_of(expression.operands.begin(), expression.operands.end(), each);
      case Expression::Kind::negation:
        return !each(expression.operands[0]);
      case Expression::Kind::link:
        break;
    }
    if (!expression.sequence.empty()) {
      std::set<std::vector<RowId>> marked;
      return has_sequence({id}, expression.link, expression.sequence.front(), marked);
    }
    const Expression& inner = expression.operands[0];
    for (RowId other = 0; other < table_.size(); ++other) {
      bool fits = false;
      if (expression.link == Link::parent) fits = row(id).parent == other;
      if (expression.link == Link::child) fits = row(other).parent == id;
      if (expression.link == Link::ancestor) fits = is_above(other, id);
      if (expression.link == Link::descendant) fits = is_above(id, other);
      if (expression.link >= Link::overlaps) fits = stand_in(id, expression.link, other);
      if (fits && answers(inner, other, expression.link <= Link::descendant)) return true;
    }
    return false;
  }

  bool is_above(RowId above, RowId below) const {
    for (RowId at = row(below).parent; at != kNoRow; at = row(at).parent) {
      if (at == above) return true;
    }
    return false;
  }

  bool is_true(const Condition& condition, RowId id) const {
    const SegmentRow& it = row(id);
    switch (condition.field) {
      case Field::gloss:
        return (it.kind == RowKind::sign || it.kind == RowKind::phase) &&
               fits(condition, table_.text_at(it.kind == RowKind::sign ? it.label : row(it.parent).label));
      case Field::phase:
        return it.kind == RowKind::phase &&
               (std::get<PhaseKind>(condition.value) == it.phase) == (condition.compare == Compare::equal);
      case Field::hand:
        return it.kind != RowKind::annotation &&
               (std::get<Hand>(condition.value) == it.hand) == (condition.compare == Compare::equal);
      case Field::recording:
        return fits(condition, table_.recording_at(it.recording));
      case Field::tier:
        return on_tier(condition, id);
      case Field::duration:
        return compare(it.span.end - it.span.begin, condition);
      case Field::begin:
        return compare(it.span.begin, condition);
      case Field::end:
        return compare(it.span.end, condition);
      case Field::movement:  // no movement is known here
      case Field::hands:
        return false;
      case Field::like:
        return true;
      case Field::unit:  // not used here either
      case Field::signer:
        return false;
    }
    return false;
  }

  bool on_tier(const Condition& condition, RowId id) const {
    const SegmentRow& it = row(id);
    if (!it.extra && table_.tier_at(it.tier) == condition.tier) return fits(condition, table_.text_at(it.label));
    for (RowId other = 0; other < table_.size(); ++other) {
      if (row(other).extra || table_.tier_at(row(other).tier) != condition.tier) continue;
      if (stand_in(id, Link::overlaps, other) && fits(condition, table_.text_at(row(other).label))) return true;
    }
    return false;
  }

  static bool fits(const Condition& condition, std::string_view label) {
    if (const Regex* regex = std::get_if<Regex>(&condition.value)) {
      RE2::Options options;
      options.set_case_sensitive(!regex->ignore_case);
      return RE2::FullMatch(label, RE2(regex->pattern, options));
    }
    return (match_form(std::get<std::string>(condition.value)) == label) == (condition.compare == Compare::equal);
  }

  static bool compare(Milliseconds time, const Condition& condition) {
    const std::string_view word = word_of(condition.compare);
    const Milliseconds value = std::get<Milliseconds>(condition.value);
    return (word.find('<') != word.npos && time < value) || (word.find('>') != word.npos && time > value) ||
           (word != "!=" && word.find('=') != word.npos && time == value) || (word == "!=" && time != value);
  }

  const SegmentTable& table_;
  mutable std::map<const PhaseQuery*, std::vector<Found>> found_;
};

std::vector<RowId> key_of(const Segment& segment, const PhaseQuery& query) {
  if (segment.parts.empty()) return {segment.row};
  std::vector<std::size_t> parts = marked_parts(query);
  for (std::size_t i = 0; i < query.elements.size() && !is_marked(query); ++i) parts.push_back(part_of_place(query, i));
  std::vector<RowId> result;
  for (const std::size_t part : parts) result.push_back(segment.parts[part].row);
  return result;
}

RC_GTEST_PROP(FindProperty, AnswersAreThoseOfAnExhaustiveSearch, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  for (int i = 0; i < 30; ++i) {
    const SegmentTable table = random_table(random);
    // Converts to text and back, so that the parser's checks hold for the query.
    const PhaseQuery query = parse(to_string(random_query(random)));
    RC_LOG() << to_string(query) << '\n';
    const std::vector<Segment> found = find(query, table);
    std::set<std::vector<RowId>> keys;
    for (const Segment& segment : found) {
      RC_ASSERT(keys.insert(key_of(segment, query)).second);
    }
    RC_ASSERT(keys == Oracle(table).answers(query));
    const auto before = [&](const Segment& a, const Segment& b) {
      const auto key = [&](const Segment& one) {
        return std::tuple(table.find_recording(one.recording), one.span.begin, one.span.end);
      };
      return key(a) < key(b);
    };
    RC_ASSERT(std::is_sorted(found.begin(), found.end(), before));
    const std::size_t limit = random() % 5;
    const std::vector<Segment> some = find(query, table, {.limit = limit, .deadline = {}});
    RC_ASSERT(some == std::vector<Segment>(found.begin(),
                                           found.begin() + static_cast<std::ptrdiff_t>(std::min(limit, found.size()))));
  }
}

TEST(FindProperty, RandomQueriesHaveEnoughAnswers) {
  std::mt19937 random(1);
  int answered = 0;
  int sequences = 0;
  int groups = 0;
  int partners = 0;
  for (int i = 0; i < 4'000; ++i) {
    const SegmentTable table = random_table(random);
    const PhaseQuery query = parse(to_string(random_query(random)));
    if (find(query, table, {.limit = 1, .deadline = {}}).empty()) continue;
    ++answered;
    sequences += query.elements.size() > 1 ? 1 : 0;
    for (const Element& element : query.elements) {
      groups += element.groups.empty() ? 0 : 1;
      partners += !element.relations.empty() && !element.relations[0].sequence.empty() ? 1 : 0;
    }
  }
  EXPECT_GT(answered, 1'200);
  EXPECT_GT(sequences, 200);
  EXPECT_GT(groups, 25);
  EXPECT_GT(partners, 25);
}

}  // namespace
}  // namespace signweave
