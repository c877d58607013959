#include "signweave/query/parse_aim.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "signweave/core/text.h"
#include "signweave/query/parse_point.h"
#include "signweave/query/parse_value.h"
#include "signweave/space/locus.h"

namespace signweave {
namespace {

using Kind = QueryToken::Kind;

/// "moves toward" and "points at".
struct Verb {
  std::string_view first;
  std::string_view second;
  Quantity quantity;
};
constexpr Verb kVerbs[] = {{"moves", "toward", Quantity::toward}, {"points", "at", Quantity::at}};

const Verb* verb_of(const QueryToken& token) noexcept {
  for (const Verb& verb : kVerbs) {
    if (token.kind == Kind::word && token.text == verb.first) return &verb;
  }
  return nullptr;
}

LocusRef parse_locus(QueryLexer& in, std::string_view write) {
  if (!in.next_is("@")) {
    in.fail(in.peek().begin,
            fmt::format("expected '@' and a locus, found {}; write {}", QueryLexer::shown(in.peek()), write));
  }
  const std::size_t begin = in.peek().begin;
  const std::string_view text = in.after_at();
  if (text.empty()) in.fail(begin, fmt::format("expected a locus directly after '@'; write {}", write));
  LocusRef locus;
  try {
    locus = read_locus(text);
  } catch (const Error& error) {
    in.fail(begin, error.what());
  }
  if (locus.kind != LocusRef::Kind::name || is_built_in_locus(locus.name)) return locus;
  std::vector<std::string> known;
  for (const std::string_view name : built_in_loci()) known.push_back(fmt::format("@{}", name));
  in.fail(begin,
          fmt::format("there is no locus '@{}'{}; use one of {}, or angles such as @30/10", printable(locus.name),
                      did_you_mean(fmt::format("@{}", locus.name), known), fmt::join(known, ", ")));
}

/// "within 20 deg".
Amount parse_tolerance(QueryLexer& in, const MovementTerm& term) {
  const Amount usual{tolerance_of(term.quantity), Unit::degrees};
  if (in.peek().kind != Kind::word || in.peek().text != "within") return usual;
  in.take();
  const QueryToken at = in.peek();
  if (at.kind != Kind::word) {
    in.fail(at.begin, fmt::format("expected an angle after 'within', found {}; write within {}", QueryLexer::shown(at),
                                  to_string(usual)));
  }
  const ParsedValue parsed = parse_value(in, term, allowed_for(term), Compare::less_equal);
  const Amount amount = std::get<Amount>(parsed.value);
  if (!(amount.value > 0 && amount.value <= 180)) {
    in.fail(at.begin, fmt::format("an angle of {}; give one above 0 deg, up to 180 deg", to_string(amount)));
  }
  return amount;
}

}  // namespace

bool begins_aim(const QueryLexer& in, const QueryToken& name) {
  if (verb_of(in.peek()) != nullptr) return true;
  const Verb* verb = verb_of(name);
  return verb != nullptr && in.peek().kind == Kind::word && fold_case(in.peek().text).starts_with(verb->second);
}

Condition parse_aim(QueryLexer& in, const QueryToken& name) {
  Condition result;
  result.field = Field::movement;
  result.compare = Compare::less_equal;
  MovementTerm& term = result.movement;
  const bool named = verb_of(in.peek()) != nullptr;
  term.point = named ? point_of(in, name) : Point::own_hand();
  const QueryToken first = named ? in.take() : name;
  const Verb& verb = *verb_of(first);
  term.quantity = verb.quantity;
  if (term.quantity == Quantity::at && term.point.kind == Point::Kind::part) {
    in.fail(name.begin, "'points at' is known for hands only; use hand, right_hand or left_hand");
  }
  const std::string write = fmt::format("{} {} @left", to_string(term.point), word_of(term.quantity));
  const QueryToken& second = in.peek();
  const bool is_verb = second.kind == Kind::word &&
                       (second.text == verb.second || (verb.quantity == Quantity::toward && second.text == "towards"));
  if (!is_verb) {
    in.fail(second.begin, fmt::format("expected '{}' after '{}', found {}; write {}", verb.second, verb.first,
                                      QueryLexer::shown(second), write));
  }
  in.take();
  term.locus = parse_locus(in, write);
  result.value = parse_tolerance(in, term);
  return result;
}

}  // namespace signweave
