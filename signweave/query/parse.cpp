#include "signweave/query/parse.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <array>

#include "signweave/core/text.h"
#include "signweave/query/lexer.h"
#include "signweave/query/parse_movement.h"
#include "signweave/query/regex.h"
#include "signweave/query/scopes.h"

namespace signweave {
namespace {

using Kind = QueryToken::Kind;

constexpr int kDeepest = 200;
constexpr std::size_t kMostPlaces = 64;
constexpr int kMostVariables = 64;
constexpr int kMostRegexes = 64;  ///< each remembers one byte per label of the database while it is answered

constexpr std::array kFields = {Field::gloss,    Field::phase, Field::hand, Field::recording, Field::tier,
                                Field::duration, Field::begin, Field::end,  Field::unit,      Field::signer};
constexpr std::array kLinks = {Link::parent, Link::child,  Link::ancestor, Link::descendant, Link::overlaps,
                               Link::during, Link::starts, Link::ends,     Link::equals};
constexpr std::array kCompares = {Compare::equal,      Compare::not_equal, Compare::matches,      Compare::less,
                                  Compare::less_equal, Compare::greater,   Compare::greater_equal};
constexpr std::array kPhaseKinds = {PhaseKind::preparation, PhaseKind::stroke, PhaseKind::retraction, PhaseKind::hold,
                                    PhaseKind::other};
constexpr std::array kHands = {Hand::both, Hand::right, Hand::left};

template <typename Values>
auto value_of(const Values& values, std::string_view word) {
  const auto at = std::find_if(values.begin(), values.end(), [&](auto value) { return word_of(value) == word; });
  return at == values.end() ? std::nullopt : std::optional(*at);
}

template <typename Values>
std::vector<std::string> words_of(const Values& values) {
  std::vector<std::string> result;
  for (const auto value : values) result.emplace_back(word_of(value));
  return result;
}

bool is_time(Field field) noexcept {
  return field >= Field::duration && field <= Field::end;
}

bool is_relation(Link link) noexcept {
  return link >= Link::overlaps;
}

/// How many like(…) are joined by `&` alone.
int outermost_examples(const Expression& expression) noexcept {
  if (expression.kind == Expression::Kind::condition) return expression.condition.field == Field::like ? 1 : 0;
  if (expression.kind != Expression::Kind::all) return 0;
  int result = 0;
  for (const Expression& operand : expression.operands) result += outermost_examples(operand);
  return result;
}

/// How many conditions on variables are joined by `&` alone.
int outermost_variables(const Expression& expression) noexcept {
  if (expression.kind == Expression::Kind::condition) {
    return std::holds_alternative<QueryVariable>(expression.condition.value) ? 1 : 0;
  }
  if (expression.kind != Expression::Kind::all) return 0;
  int result = 0;
  for (const Expression& operand : expression.operands) result += outermost_variables(operand);
  return result;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : in_(text) {}

  PhaseQuery query() {
    if (in_.peek().kind == Kind::end) {
      in_.fail(in_.peek().begin, "the query is empty; write a condition such as gloss = \"VANNES\"");
    }
    PhaseQuery result;
    std::size_t last = in_.peek().begin;
    result.elements.push_back(element());
    while (in_.next_is("->")) {
      const std::size_t arrow = in_.take().begin;
      result.gaps.push_back(in_.next_is("[") ? gap() : Interval());
      last = in_.peek().begin;
      result.elements.push_back(element());
      check_neighbours(result.elements[result.elements.size() - 2], result.elements.back(), arrow);
      if (result.elements.size() > kMostPlaces) {
        in_.fail(last, fmt::format("a sequence of more than {} places; ask for a shorter one", kMostPlaces));
      }
    }
    expect_end();
    return result;
  }

 private:
  Element element() {
    Element result{term(), {}};
    while (in_.peek().kind == Kind::word) {
      const std::optional<Link> link = value_of(kLinks, in_.peek().text);
      if (!link || !is_relation(*link)) break;
      in_.take();
      result.relations.push_back({*link, term()});
      if (ranked_in_term_) in_.fail(example_, "like(…) orders what is before a relation; move it there");
      if (result.relations.size() > kMostPlaces) {
        in_.fail(in_.peek().begin, fmt::format("more than {} relations of one segment; ask in parts", kMostPlaces));
      }
    }
    return result;
  }

  Term term() {
    Term result;
    const std::size_t begin = in_.peek().begin;
    if (in_.accept("@")) {
      if (marked_) in_.fail(begin, "a second @; mark one part only as the answer");
      marked_ = result.marked = true;
    }
    const int before = examples_;
    const int variables_before = variables_;
    result.expression = expression();
    if (outermost_variables(result.expression) != variables_ - variables_before) {
      in_.fail(variable_, "a variable is joined to the conditions of a place with & only, outside of |, ! and links");
    }
    check_tiers(result.expression, begin);
    ranked_in_term_ = examples_ > before;
    if (outermost_examples(result.expression) != examples_ - before) {
      in_.fail(example_,
               "like(…) is no condition, it orders the answers; join it to the conditions of a place with &, "
               "outside of |, ! and links");
    }
    return result;
  }

  Interval gap() {
    const std::string_view inside = in_.bracketed();
    const std::size_t dots = inside.find("..");
    if (dots == std::string_view::npos) {
      in_.fail(in_.offset_of(inside), "a gap has two bounds, one of them may be left out; write ->[..500ms]");
    }
    const auto bound = [&](std::string_view part) -> std::optional<Milliseconds> {
      const std::string_view word = trimmed(part);
      if (word.empty()) return std::nullopt;
      const Milliseconds result = time(word, in_.offset_of(word));
      if (result < 0ms)
        in_.fail(in_.offset_of(word), "a gap is never negative; use overlaps for segments that overlap");
      return result;
    };
    const Interval result{bound(inside.substr(0, dots)), bound(inside.substr(dots + 2))};
    if (result.direct()) {
      in_.fail(in_.offset_of(inside), "a gap without bounds; write -> for neighbours, ->[0ms..] for any later segment");
    }
    if (result.least && result.most && *result.least > *result.most) {
      in_.fail(in_.offset_of(inside), "the gap's first bound is above its second; swap them");
    }
    return result;
  }

  Expression expression() { return joined(Expression::Kind::any, "|"); }

  /// Operands of `|`, which are operands of `&`, which are single.
  Expression joined(Expression::Kind kind, std::string_view symbol) {
    const auto operand = [&] { return kind == Expression::Kind::any ? joined(Expression::Kind::all, "&") : single(); };
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
    if (++depth_ > kDeepest)
      in_.fail(next.begin, fmt::format("more than {} levels of nesting; ask in parts", kDeepest));
    Expression result;
    if (in_.accept("!")) {
      result.kind = Expression::Kind::negation;
      result.operands.push_back(single());
    } else if (in_.next_is("(")) {
      result = parenthesised();
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
    --depth_;
    return result;
  }

  Expression parenthesised() {
    const std::size_t begin = in_.take().begin;
    const bool marked = in_.next_is("@");
    if (!marked) {
      Expression result = expression();
      if (in_.accept(")")) return result;
      const QueryToken& next = in_.peek();
      const std::optional<Link> link = next.kind == Kind::word ? value_of(kLinks, next.text) : std::nullopt;
      if (!in_.next_is("->") && !(link && is_relation(*link))) {
        in_.expect(")", fmt::format("close the parenthesis of column {}, or join conditions with & or |", begin + 1));
      }
    }
    in_.fail(begin,
             "a sequence or relation in parentheses is not supported yet; write it without them (relations bind before "
             "->), or as a condition: overlaps(…)",
             ErrorCode::unsupported);
  }

  Expression word() {
    const QueryToken name = in_.take();
    Expression result;
    const std::optional<Link> link = value_of(kLinks, name.text);
    if (link) {
      result.kind = Expression::Kind::link;
      result.link = *link;
      in_.expect("(", fmt::format("write a condition in parentheses: {}(gloss = \"VANNES\")", name.text));
      result.operands.push_back(inside_link());
      return result;
    }
    const std::optional<Field> field = value_of(kFields, name.text);
    if (name.text == "like") {
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

  Expression inside_link() {
    const std::size_t begin = in_.peek().begin;
    Expression result = expression();
    in_.expect(")", "close the parenthesis, or join conditions with & or |");
    check_tiers(result, begin);
    return result;
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
    const std::string_view allowed = is_time(field) ? "= != < <= > >=" : field == Field::hand ? "= !=" : "= != =~";
    if (!found || (is_time(field) ? *found == Compare::matches : *found > Compare::matches) ||
        (field == Field::hand && *found == Compare::matches)) {
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
      const std::string_view hint = token.kind == Kind::regex  ? "a regular expression stands after =~"
                                    : is_time(condition.field) ? "write a time such as 300ms or 1.5s"
                                                               : "write a text in double quotes";
      in_.fail(token.begin, fmt::format("expected a value after '{}', found {}; {}", word_of(condition.compare),
                                        QueryLexer::shown(token), hint));
    }
    in_.take();
    if (is_time(condition.field)) {
      condition.value = time(token);
    } else if (condition.field == Field::phase) {
      condition.value = named(kPhaseKinds, token, "phase");
    } else if (condition.field == Field::hand) {
      condition.value = named(kHands, token, "hand");
    } else {
      condition.value = token.text;
    }
  }

  template <typename Values>
  typename Values::value_type named(const Values& values, const QueryToken& token, std::string_view what) {
    const auto found = value_of(values, fold_case(token.text));
    if (!found) {
      in_.fail(token.begin, fmt::format("no {} is called {}; use one of {}", what, QueryLexer::shown(token),
                                        fmt::join(words_of(values), ", ")));
    }
    return *found;
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
      in_.fail(token.begin, fmt::format("regular expression: {}; mend it (RE2 syntax)", printable(compiled->error())));
    }
    return result;
  }

  /// "300ms", "1.5s", or number and unit as two words.
  Milliseconds time(const QueryToken& token) {
    std::string word = token.text;
    const bool number = token.kind == Kind::word && word.find_first_not_of("+-.0123456789") == std::string::npos;
    if (number && in_.peek().kind == Kind::word && (in_.peek().text == "ms" || in_.peek().text == "s")) {
      word += in_.take().text;
    }
    return time(word, token.begin);
  }

  Milliseconds time(std::string_view word, std::size_t offset) {
    const bool milliseconds = word.ends_with("ms");
    std::string_view digits = word.substr(0, word.size() - (milliseconds ? 2 : word.ends_with("s") ? 1 : 0));
    const std::size_t unit = word.size() - digits.size();
    digits = trimmed(digits);
    const bool negative = digits.starts_with('-');
    if (negative) digits.remove_prefix(1);
    const std::string_view whole = digits.substr(0, digits.find('.'));
    std::string part(digits.substr(std::min(whole.size() + 1, digits.size())));
    const bool point = whole.size() < digits.size();
    if (whole.empty() || (std::string(whole) + part).find_first_not_of("0123456789") != std::string::npos ||
        point == part.empty()) {
      in_.fail(offset, fmt::format("'{}' is no time; write one such as 300ms or 1.5s", printable(word)));
    }
    if (unit == 0) in_.fail(offset, fmt::format("the time {} lacks a unit; write {}ms or {}s", word, word, word));
    while (part.ends_with('0')) part.pop_back();
    const std::size_t decimals = milliseconds ? 0 : 3;
    if (part.size() > decimals) in_.fail(offset, "times are whole milliseconds; round this one");
    part.resize(decimals, '0');
    const std::string all = std::string(whole) + part;
    if (all.size() > 15) in_.fail(offset, "a time of more than 15 digits; write a smaller one");
    const std::int64_t count = std::stoll(all);
    return Milliseconds(negative ? -count : count);
  }

  /// A sign and a phase lie on different tiers and so are never neighbours: say it rather than answer nothing.
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
               "a sequence of a sign and a phase, which lie on different tiers; add a phase condition to both "
               "sides or to neither");
    }
  }

  [[noreturn]] void refuse_word(const QueryToken& name) {
    if (name.text == "signer") {
      in_.fail(name.begin, "conditions on the signer are not supported yet; use recording = \"…\"",
               ErrorCode::unsupported);
    }
    std::vector<std::string> known = words_of(kFields);
    for (const Link link : kLinks) known.emplace_back(word_of(link));
    for (std::string& word : movement_words()) {
      if (std::find(known.begin(), known.end(), word) == known.end()) known.push_back(std::move(word));
    }
    in_.fail(name.begin, fmt::format("no condition is called '{}'{}; use one of {}", printable(name.text),
                                     did_you_mean(name.text, known), fmt::join(known, ", ")));
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
      in_.fail(token.begin, fmt::format("more than {} conditions on variables; ask in parts", kMostVariables));
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
               "',' has no meaning here; a text with such characters stands in double quotes, and "
               "conditions are joined with & or |");
    }
    in_.fail(next.begin, closing ? std::string("')' without '('; take it away")
                                 : fmt::format("expected & | -> or the end of the query, found {}; join conditions "
                                               "with &, | or ->",
                                               QueryLexer::shown(next)));
  }

  QueryLexer in_;
  int depth_ = 0;
  int regexes_ = 0;
  int examples_ = 0;
  int variables_ = 0;
  std::size_t variable_ = 0;     ///< where the last one stands
  std::size_t example_ = 0;      ///< where the last like(…) begins
  bool ranked_in_term_ = false;  ///< the last term has one
  bool marked_ = false;
};

}  // namespace

PhaseQuery parse(std::string_view text) {
  return Parser(text).query();
}

}  // namespace signweave
