#include "signweave/query/parse.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/query/keywords.h"
#include "signweave/query/lexer.h"
#include "signweave/query/parse_aim.h"
#include "signweave/query/parse_example.h"
#include "signweave/query/parse_movement.h"
#include "signweave/query/parse_time.h"
#include "signweave/query/regex.h"
#include "signweave/query/scopes.h"

namespace signweave {
namespace {

using Kind = QueryToken::Kind;

constexpr int kDeepest = 200;
constexpr std::size_t kMostPlaces = 64;
constexpr int kMostSequences = 16;
constexpr int kMostVariables = 64;
constexpr int kMostRegexes = 64;  ///< each stores one byte per label of the database while the query runs

bool is_time(Field field) noexcept {
  return field >= Field::duration && field <= Field::end;
}

/// Whether its values are names that are only equal or not.
bool is_hand(Field field) noexcept {
  return field == Field::hand || field == Field::hands;
}

bool is_relation(Link link) noexcept {
  return link >= Link::overlaps;
}

bool is_example(const Condition& condition) noexcept {
  return condition.field == Field::like;
}

bool has_variable(const Condition& condition) noexcept {
  return std::holds_alternative<QueryVariable>(condition.value);
}

/// The number of such conditions that are joined by `&` only.
int outermost(const Expression& expression, bool (*such)(const Condition&) noexcept) noexcept {
  if (expression.kind == Expression::Kind::condition) return such(expression.condition) ? 1 : 0;
  if (expression.kind != Expression::Kind::all) return 0;
  int result = 0;
  for (const Expression& operand : expression.operands) result += outermost(operand, such);
  return result;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : in_(text) {}

  PhaseQuery query() {
    if (in_.peek().kind == Kind::end) {
      in_.fail(in_.peek().begin, "the query is empty; write a condition such as gloss = \"VANNES\"");
    }
    PhaseQuery result = sequence();
    expect_end();
    return result;
  }

 private:
  PhaseQuery sequence() {
    PhaseQuery result = element();
    while (in_.next_is("->")) {
      const std::size_t arrow = in_.take().begin;
      result.gaps.push_back(in_.next_is("[") ? parse_gap(in_) : Interval());
      const std::size_t last = in_.peek().begin;
      PhaseQuery next = element();
      check_neighbours(result.elements.back(), next.elements.front(), arrow);
      std::ranges::move(next.elements, std::back_inserter(result.elements));
      std::ranges::move(next.gaps, std::back_inserter(result.gaps));
      if (result.elements.size() > kMostPlaces) {
        in_.fail(last, fmt::format("a sequence of more than {} places; shorten it", kMostPlaces));
      }
    }
    return result;
  }

  /// A part and its relations.
  PhaseQuery element() {
    ParsedPart result = part();
    Element& last = result.query.elements.back();
    while (const std::optional<Link> link = next_relation()) {
      in_.take();
      const int before = examples_;
      ParsedPart partner = part();
      if (examples_ > before) in_.fail(example_, "like(…) must be in the part before a relation; move it there");
      if (result.group && !result.own) last.groups.push_back({.places = result.query.elements.size()});
      result.own = true;
      std::vector<Relation>& relations = result.group ? last.groups.back().relations : last.relations;
      relations.push_back({.link = *link});
      if (is_term(partner.query)) {
        relations.back().term = std::move(partner.query.elements.front().term);
      } else {
        relations.back().sequence.push_back(std::move(partner.query));
        count_sequence();
      }
      if (relations.size() > kMostPlaces) {
        in_.fail(in_.peek().begin, fmt::format("more than {} relations of one segment; split the query", kMostPlaces));
      }
    }
    return std::move(result.query);
  }

  std::optional<Link> next_relation() const {
    if (in_.peek().kind != Kind::word) return std::nullopt;
    const std::optional<Link> link = value_of(kLinks, in_.peek().text);
    return link && is_relation(*link) ? link : std::nullopt;
  }

  static bool is_term(const PhaseQuery& query) noexcept {
    const Element& first = query.elements.front();
    return query.elements.size() == 1 && first.relations.empty() && first.groups.empty();
  }

  /// Whether the query is only an expression.
  static bool is_plain(const PhaseQuery& query) noexcept {
    return is_term(query) && !query.elements.front().term.marked;
  }
  /// A part between arrows and relations.
  struct ParsedPart {
    PhaseQuery query;
    bool group = false;  ///< a sequence or relation in parentheses
    bool own = false;    ///< its last group is this sequence or relation
  };

  ParsedPart part() {
    const std::size_t begin = in_.peek().begin;
    const bool marked = in_.accept("@");
    if (marked) mark(begin);
    const int examples = examples_;
    const int variables = variables_;
    std::optional<Expression> first;
    if (in_.next_is("(")) {
      ParsedPart result{.query = parenthesised(), .group = true};
      if (!is_plain(result.query)) {
        finish_group(result, marked);
        return result;
      }
      first = std::move(result.query.elements.front().term.expression);
    }
    ParsedPart result;
    result.query.elements.push_back({{expression(std::move(first)), marked}, {}});
    const Expression& whole = result.query.elements.front().term.expression;
    if (outermost(whole, has_variable) != variables_ - variables) {
      in_.fail(variable_, "join a variable to the conditions of a place with & only, outside |, ! and links");
    }
    check_tiers(whole, begin);
    if (outermost(whole, is_example) != examples_ - examples) {
      in_.fail(example_,
               "like(…) is not a condition but orders the answers; join it to the conditions of a place with &, "
               "outside |, ! and links");
    }
    return result;
  }

  void mark(std::size_t at) {
    if (marked_) in_.fail(at, "a second @; mark only one part as the answer");
    marked_ = true;
  }

  /// "& duration > 1s" after a sequence in parentheses.
  void finish_group(ParsedPart& part, bool marked) {
    Group group{.places = part.query.elements.size(), .marked = marked};
    while (in_.next_is("&") || in_.next_is("|")) {
      const std::size_t at = in_.peek().begin;
      const bool both = in_.take().text == "&";
      const QueryToken word = in_.peek();
      const std::optional<Field> field = word.kind == Kind::word ? value_of(kFields, word.text) : std::nullopt;
      if (!both || !field || !is_time(*field)) {
        in_.fail(at,
                 "a sequence or relation in parentheses is one segment, to which only & duration, begin and end "
                 "apply; write other conditions inside, and alternatives as separate queries");
      }
      in_.take();
      if (in_.next_is("("))
        in_.fail(word.begin, "a condition on the movement of a whole sequence; put it on one of its places, inside");
      group.conditions.push_back(condition(*field));
    }
    part.own = marked || !group.conditions.empty();
    if (part.own) part.query.elements.back().groups.push_back(std::move(group));
  }

  /// `first`: the part of it that is already parsed.
  Expression expression(std::optional<Expression> first = std::nullopt) {
    return joined(Expression::Kind::any, "|", first);
  }

  /// Operands of `|`, which are operands of `&`, which are single conditions.
  Expression joined(Expression::Kind kind, std::string_view symbol, std::optional<Expression>& read) {
    const auto operand = [&] {
      if (kind == Expression::Kind::any) return joined(Expression::Kind::all, "&", read);
      return read ? *std::exchange(read, std::nullopt) : single();
    };
    Expression first = operand();
    if (!in_.next_is(symbol)) return first;
    Expression result;
    result.kind = kind;
    result.operands.push_back(std::move(first));
    while (in_.accept(symbol)) result.operands.push_back(operand());
    return result;
  }

  Expression single() {
    const QueryToken& next = in_.peek();
    if (in_.next_is("(")) {
      const std::size_t begin = next.begin;
      PhaseQuery inside = parenthesised();
      if (is_plain(inside)) return std::move(inside.elements.front().term.expression);
      in_.fail(begin,
               "a sequence or relation in parentheses is a segment, not a condition; put it first in its part, "
               "or inside overlaps(…), during(…), starts(…), ends(…) or equals(…)");
    }
    Nesting nesting(*this, next.begin);
    Expression result;
    if (in_.accept("!")) {
      result.kind = Expression::Kind::negation;
      result.operands.push_back(single());
    } else if (next.kind == Kind::word) {
      result = word();
    } else if (in_.next_is("@")) {
      in_.fail(next.begin, "@ marks a whole part of a sequence or relation; put it before the part's first condition");
    } else if (next.kind == Kind::variable) {
      refuse_variable(next);
    } else {
      in_.fail(next.begin, fmt::format("expected a condition, found {}; write one such as gloss = \"VANNES\"",
                                       QueryLexer::shown(next)));
    }
    return result;
  }

  PhaseQuery parenthesised() {
    const std::size_t begin = in_.take().begin;
    Nesting nesting(*this, begin);
    PhaseQuery result = sequence();
    in_.expect(")", fmt::format("close the parenthesis of {}, or join conditions with & or |", in_.place_of(begin)));
    return result;
  }

  class Nesting {
   public:
    Nesting(Parser& parser, std::size_t at) : depth_(parser.depth_) {
      if (++depth_ > kDeepest) {
        parser.in_.fail(at, fmt::format("more than {} levels of nesting; split the query", kDeepest));
      }
    }
    ~Nesting() { --depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;

   private:
    int& depth_;
  };

  Expression word() {
    const QueryToken name = in_.take();
    Expression result;
    const std::optional<Link> link = value_of(kLinks, name.text);
    if (link) {
      result.kind = Expression::Kind::link;
      result.link = *link;
      in_.expect("(", fmt::format("write a condition in parentheses: {}(gloss = \"VANNES\")", name.text));
      inside_link(result);
      return result;
    }
    const std::optional<Field> field = value_of(kFields, name.text);
    if (begins_aim(in_, name)) {
      result.condition = parse_aim(in_, name);
    } else if (name.text == "like") {
      result.condition = example(name);
    } else if (is_quantity(name.text) && (!field || in_.next_is("("))) {
      result.condition = parse_movement(in_, name);
    } else if (field) {
      result.condition = condition(*field);
    } else {
      refuse_word(name);
    }
    return result;
  }

  Condition example(const QueryToken& name) {
    example_ = name.begin;
    if (++examples_ > 1) in_.fail(name.begin, "a second like(…); one example orders the answers");
    return parse_example(in_, name);
  }

  void inside_link(Expression& link) {
    const std::size_t begin = in_.peek().begin;
    const bool marked = marked_;
    PhaseQuery inside = sequence();
    in_.expect(")", "close the parenthesis, or join conditions with & or |");
    if (marked_ != marked) in_.fail(begin, "an @ inside a condition; @ marks a part of the query as the answer");
    if (is_plain(inside)) {
      link.operands.push_back(std::move(inside.elements.front().term.expression));
    } else if (is_relation(link.link)) {
      link.sequence.push_back(std::move(inside));
      count_sequence();
    } else {
      in_.fail(begin, "a sequence or relation has no parent or children; put the condition on one of its places");
    }
  }

  void count_sequence() {
    if (++sequences_ <= kMostSequences) return;
    in_.fail(in_.peek().begin, fmt::format("more than {} sequences in relations; split the query", kMostSequences));
  }

  void check_tiers(const Expression& expression, std::size_t begin) {
    const std::size_t count = tiers_named(expression).size();
    if (count > Scopes::kMostTiers) {
      in_.fail(begin, fmt::format("a condition on {} tiers; name at most {}", count, Scopes::kMostTiers));
    }
  }

  Condition condition(Field field) {
    Condition result;
    result.field = field;
    if (field == Field::unit) return result;
    if (field == Field::tier) {
      in_.expect("(", "name the tier: tier(\"Mouthing\") = \"pluie\"");
      const QueryToken name = in_.take();
      if (name.kind != Kind::text && name.kind != Kind::word) {
        in_.fail(name.begin, fmt::format("expected a tier's name, found {}; write tier(\"Mouthing\") = \"pluie\"",
                                         QueryLexer::shown(name)));
      }
      result.tier = name.text;
      in_.expect(")", "close the parenthesis after the tier's name");
    }
    result.compare = compare(field);
    value(result);
    return result;
  }

  Compare compare(Field field) {
    const QueryToken& next = in_.peek();
    const std::optional<Compare> found = next.kind == Kind::symbol ? value_of(kCompares, next.text) : std::nullopt;
    const std::string_view allowed = is_time(field) ? "= != < <= > >=" : is_hand(field) ? "= !=" : "= != =~";
    if (!found || (is_time(field) ? *found == Compare::matches : *found > Compare::matches) ||
        (is_hand(field) && *found == Compare::matches)) {
      in_.fail(next.begin, fmt::format("expected a comparison after '{}', found {}; use one of {}", word_of(field),
                                       QueryLexer::shown(next), allowed));
    }
    in_.take();
    return *found;
  }

  void value(Condition& condition) {
    const QueryToken token = in_.peek();
    if (token.kind == Kind::variable) {
      condition.value = variable(condition);
      return;
    }
    if (condition.compare == Compare::matches) {
      if (token.kind != Kind::regex) {
        in_.fail(token.begin, fmt::format("expected a regular expression after '=~', found {}; write it between "
                                          "slashes: gloss =~ /NUAGE.*/",
                                          QueryLexer::shown(token)));
      }
      condition.value = regex(in_.take());
      return;
    }
    if (token.kind != Kind::text && token.kind != Kind::word) {
      const std::string_view hint = token.kind == Kind::regex  ? "write a regular expression after =~"
                                    : is_time(condition.field) ? "write a time such as 300ms or 1.5s"
                                                               : "write a text in double quotes";
      in_.fail(token.begin, fmt::format("expected a value after '{}', found {}; {}", word_of(condition.compare),
                                        QueryLexer::shown(token), hint));
    }
    in_.take();
    if (is_time(condition.field)) {
      condition.value = parse_time(in_, token);
    } else if (condition.field == Field::phase) {
      condition.value = named(kPhaseKinds, token, "phase");
    } else if (condition.field == Field::hand) {
      refuse_value_of(kHandsClasses, token, "hands");
      condition.value = named(kHands, token, "hand");
    } else if (condition.field == Field::hands) {
      refuse_value_of(kHands, token, "hand");
      condition.value = named(kHandsClasses, token, "class of hands");
    } else {
      condition.value = token.text;
    }
  }

  template <typename Values>
  typename Values::value_type named(const Values& values, const QueryToken& token, std::string_view what) {
    const auto found = value_of(values, fold_case(token.text));
    if (!found) {
      const std::vector<std::string> words = words_of(values);
      const std::string near = did_you_mean(token.text, words);
      in_.fail(token.begin, fmt::format("no {} is called {}{}", what, QueryLexer::shown(token),
                                        near.empty() ? fmt::format("; use one of {}", fmt::join(words, ", ")) : near));
    }
    return *found;
  }

  /// `hand` and `hands` are easily confused.
  template <typename Values>
  void refuse_value_of(const Values& others, const QueryToken& token, std::string_view field) {
    if (const auto found = value_of(others, fold_case(token.text))) {
      in_.fail(token.begin, fmt::format("{} is a value of the field '{}'; did you mean {} = {}?",
                                        QueryLexer::shown(token), field, field, word_of(*found)));
    }
  }

  Regex regex(const QueryToken& token) {
    Regex result{token.text, token.flags == "i"};
    if (++regexes_ > kMostRegexes) {
      in_.fail(token.begin, fmt::format("more than {} regular expressions; join them with | inside one", kMostRegexes));
    }
    if (!token.flags.empty() && token.flags != "i") {
      in_.fail(token.begin, fmt::format("flags '{}' after the regular expression; the only one is i (ignore case)",
                                        printable(token.flags)));
    }
    if (const std::unique_ptr<RE2> compiled = compile(result); !compiled->ok()) {
      in_.fail(token.begin, fmt::format("regular expression: {}; fix it (RE2 syntax)", printable(compiled->error())));
    }
    return result;
  }

  /// A sign and a phase are on different tiers and therefore never neighbours: an error is better than an empty answer.
  void check_neighbours(const Element& before, const Element& after, std::size_t arrow) {
    const auto only_phases = [](const Element& element) {
      const Expression& expression = element.term.expression;
      return scopes_of(expression, tiers_named(expression)) == Scopes::phases();
    };
    const auto only_signs = [](const Element& element) {
      const Expression& expression = element.term.expression;
      const Scopes scopes = scopes_of(expression, tiers_named(expression));
      return scopes == Scopes::signs() || scopes == Scopes::plain();
    };
    if ((only_phases(before) && only_signs(after)) || (only_signs(before) && only_phases(after))) {
      in_.fail(arrow,
               "a sequence of a sign and a phase, which are on different tiers; add a phase condition to both "
               "sides or to neither");
    }
  }

  [[noreturn]] void refuse_word(const QueryToken& name) {
    std::vector<std::string> known = words_of(kFields);
    for (const Link link : kLinks) known.emplace_back(word_of(link));
    for (std::string& word : movement_words()) {
      if (std::find(known.begin(), known.end(), word) == known.end()) known.push_back(std::move(word));
    }
    std::string hint = did_you_mean(name.text, known);
    if (hint.empty()) hint = fmt::format("; for a sign write gloss = \"{}\"", printable(name.text));
    in_.fail(name.begin, fmt::format("no condition is called '{}'{}", printable(name.text), hint));
  }

  [[noreturn]] void refuse_variable(const QueryToken& token) {
    in_.fail(token.begin,
             fmt::format("'{}' stands alone; write gloss = {}, and a label that begins with $ in double quotes",
                         printable(token.text), printable(token.text)));
  }

  QueryVariable variable(const Condition& condition) {
    const QueryToken token = in_.take();
    if ((condition.field != Field::gloss && condition.field != Field::tier) || condition.compare > Compare::not_equal) {
      in_.fail(token.begin, fmt::format("a variable stands for a label; write gloss = {} or tier(\"Mouthing\") != {}",
                                        printable(token.text), printable(token.text)));
    }
    if (++variables_ > kMostVariables) {
      in_.fail(token.begin, fmt::format("more than {} conditions on variables; split the query", kMostVariables));
    }
    variable_ = token.begin;
    return {token.text.substr(1)};
  }

  void expect_end() {
    const QueryToken& next = in_.peek();
    if (next.kind == Kind::end) return;
    const bool closing = in_.next_is(")");
    if (in_.next_is(",")) {
      in_.fail(next.begin,
               "',' has no meaning here; put a text with such characters in double quotes, and "
               "conditions are joined with & or |");
    }
    in_.fail(next.begin, closing ? std::string("')' without '('; remove it")
                                 : fmt::format("expected & | -> or the end of the query, found {}; join conditions "
                                               "with &, | or ->",
                                               QueryLexer::shown(next)));
  }

  QueryLexer in_;
  int depth_ = 0;
  int regexes_ = 0;
  int sequences_ = 0;
  int examples_ = 0;
  int variables_ = 0;
  std::size_t variable_ = 0;  ///< offset of the last variable
  std::size_t example_ = 0;   ///< offset of the last like(…)
  bool marked_ = false;
};

}  // namespace

PhaseQuery parse(std::string_view text) {
  return Parser(text).query();
}

}  // namespace signweave
