#include "signweave/query/parse_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/query/keywords.h"

namespace signweave {
namespace {

constexpr std::array kHeights = {Height::below_waist, Height::waist, Height::chest,    Height::shoulder,
                                 Height::chin,        Height::mouth, Height::forehead, Height::above_head};
constexpr std::array kAcross = {Across::left, Across::centre, Across::right};
constexpr std::array kReaches = {Reach::near, Reach::far};
constexpr std::array kFacings = {Facing::up, Facing::down, Facing::left, Facing::right, Facing::forward, Facing::back};
constexpr std::array kContacts = {Contact::hands, Contact::head, Contact::torso};

struct UnitName {
  std::string_view word;
  Unit unit;
  double per;  ///< number of these per `unit`
};
constexpr std::array kUnits = {
    UnitName{"m", Unit::metres, 1},
    UnitName{"cm", Unit::metres, 100},
    UnitName{"mm", Unit::metres, 1000},
    UnitName{"sw", Unit::shoulder_widths, 1},
    UnitName{"m/s", Unit::metres_per_second, 1},
    UnitName{"cm/s", Unit::metres_per_second, 100},
    UnitName{"mm/s", Unit::metres_per_second, 1000},
    UnitName{"m/s2", Unit::metres_per_second_squared, 1},
    UnitName{"cm/s2", Unit::metres_per_second_squared, 100},
    UnitName{"deg", Unit::degrees, 1},
    UnitName{"rad", Unit::degrees, std::numbers::pi / 180},
    UnitName{"\xC2\xB0", Unit::degrees, 1},
    UnitName{"m/s^2", Unit::metres_per_second_squared, 1},
    UnitName{"cm/s^2", Unit::metres_per_second_squared, 100},
    UnitName{"m/s\xC2\xB2", Unit::metres_per_second_squared, 1},
    UnitName{"cm/s\xC2\xB2", Unit::metres_per_second_squared, 100},
};
constexpr std::size_t kUnitsShown = 11;  ///< the rest are alternative spellings

AllowedValue allowed_for(ValueKind kind) {
  const std::vector<Unit> lengths = {Unit::shoulder_widths, Unit::metres, Unit::none};
  switch (kind) {
    case ValueKind::speed:
      return {{Unit::metres_per_second}, "1.5 m/s", {}, ""};
    case ValueKind::acceleration:
      return {{Unit::metres_per_second_squared}, "20 m/s2", {}, ""};
    case ValueKind::length:
      return {lengths, "10 cm or 0.3 (shoulder widths)", {}, ""};
    case ValueKind::height:
      return {lengths, "0.3 (shoulder widths)", words_of(kHeights), "= != < <= > >="};
    case ValueKind::across:
      return {lengths, "0.3 (shoulder widths to the signer's left)", words_of(kAcross), "= !="};
    case ValueKind::reach:
      return {lengths, "0.8 (shoulder widths)", words_of(kReaches), "= !="};
    case ValueKind::share:
      return {{Unit::none}, "0.5", {}, ""};
    case ValueKind::angle:
      return {{Unit::degrees}, "15 deg", {}, ""};
    case ValueKind::facing:
      return {{}, "", words_of(kFacings), "= !="};
    case ValueKind::contact:
      return {{}, "", words_of(kContacts), "="};
  }
  return {};
}

/// "write 1.5 m/s", "write one of up, down", or both.
std::string what_to_write(const AllowedValue& allowed) {
  if (allowed.number.empty()) return fmt::format("use one of {}", fmt::join(allowed.names, ", "));
  if (allowed.names.empty()) return fmt::format("write a number such as {}", allowed.number);
  return fmt::format("write a number such as {}, or one of {}", allowed.number, fmt::join(allowed.names, ", "));
}

bool looks_like_number(std::string_view word) noexcept {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  return !word.empty() && (word.front() == '.' || (word.front() >= '0' && word.front() <= '9'));
}

/// A relation may follow a bare number: "… > 0.5 during phase = stroke".
bool is_relation(std::string_view word) noexcept {
  constexpr std::array kRelations = {Link::overlaps, Link::during, Link::starts, Link::ends, Link::equals};
  return value_of(kRelations, word).has_value();
}
std::vector<std::string> shown_units() {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < kUnitsShown; ++i) result.emplace_back(kUnits[i].word);
  return result;
}

Amount parse_amount(QueryLexer& in, const QueryToken& token, const AllowedValue& allowed) {
  if (allowed.number.empty()) {
    in.fail(token.begin, fmt::format("'{}' is a number; {}", printable(token.text), what_to_write(allowed)));
  }
  std::string_view text = token.text;
  if (text.starts_with('+')) text.remove_prefix(1);
  const std::size_t digits =
      std::min(text.find_first_not_of("0123456789.", text.starts_with('-') ? 1 : 0), text.size());
  constexpr std::size_t kMostDigits = 40;
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + digits, value, std::chars_format::fixed);
  if (end.ec != std::errc() || end.ptr != text.data() + digits || digits > kMostDigits) {
    in.fail(token.begin, fmt::format("'{}' is not a number; {}", printable(token.text), what_to_write(allowed)));
  }
  std::string word(text.substr(digits));
  std::size_t at = token.begin;
  if (word.empty() && in.peek().kind == QueryToken::Kind::word) {
    const QueryToken& next = in.peek();
    in.join_slash();
    if (!is_relation(next.text)) {
      at = next.begin;
      word = in.take().text;
    }
  }
  const auto unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitName& row) { return row.word == word; });
  if (!word.empty() && unit == kUnits.end()) {
    in.fail(at, fmt::format("no unit is called '{}'{}; {}", printable(word), did_you_mean(word, shown_units()),
                            what_to_write(allowed)));
  }
  const Unit meant = word.empty() ? Unit::none : unit->unit;
  if (std::find(allowed.units.begin(), allowed.units.end(), meant) == allowed.units.end()) {
    in.fail(word.empty() ? token.begin : at,
            word.empty()
                ? fmt::format("the number {} lacks a unit; {}", printable(token.text), what_to_write(allowed))
                : fmt::format("'{}' is not a unit of this quantity; {}", printable(word), what_to_write(allowed)));
  }
  const double result = word.empty() ? value : value / unit->per;
  constexpr double kMost = 1e6;
  if (std::abs(result) > kMost) in.fail(token.begin, "a number above one million; write a smaller one");
  const bool bare_length = meant == Unit::none && allowed.units.size() > 1;
  return {result, bare_length ? Unit::shoulder_widths : meant};
}

}  // namespace

AllowedValue allowed_for(const MovementTerm& term) {
  AllowedValue allowed = allowed_for(value_kind(term));
  if (term.quantity == Quantity::enters) return {{}, "", std::move(allowed.names), "="};
  return allowed;
}

ParsedValue parse_value(QueryLexer& in, const MovementTerm& term, const AllowedValue& allowed, Compare compare) {
  in.join_slash();
  const QueryToken token = in.peek();
  if (token.kind != QueryToken::Kind::word && token.kind != QueryToken::Kind::text) {
    in.fail(token.begin, fmt::format("expected a value after '{}', found {}; {}", word_of(compare),
                                     QueryLexer::shown(token), what_to_write(allowed)));
  }
  in.take();
  if (token.kind == QueryToken::Kind::word && looks_like_number(token.text))
    return {parse_amount(in, token, allowed), token.text};
  const std::string word = fold_case(token.text);
  const auto named = [&](const auto& values) -> std::optional<decltype(Condition::value)> {
    if (const auto one = value_of(values, word)) return *one;
    return std::nullopt;
  };
  std::optional<decltype(Condition::value)> found;
  switch (value_kind(term)) {
    case ValueKind::height:
      found = named(kHeights);
      break;
    case ValueKind::across:
      found = word == "center" ? Across::centre : named(kAcross);
      break;
    case ValueKind::reach:
      found = named(kReaches);
      break;
    case ValueKind::facing:
      found = named(kFacings);
      break;
    case ValueKind::contact:
      found = named(kContacts);
      break;
    case ValueKind::speed:
    case ValueKind::acceleration:
    case ValueKind::length:
    case ValueKind::share:
    case ValueKind::angle:
      break;
  }
  if (found) return {*std::move(found), token.text};
  in.fail(token.begin, fmt::format("{} is not a value of '{}'{}; {}", QueryLexer::shown(token), to_string(term),
                                   did_you_mean(token.text, allowed.names), what_to_write(allowed)));
}

void parse_zone(QueryLexer& in, Condition& condition) {
  in.expect(",", "");
  const QueryToken token = in.take();
  const std::string word = fold_case(token.text);
  std::vector<std::string> names = words_of(kHeights);
  for (const std::string& name : words_of(kAcross)) names.push_back(name);
  for (const std::string& name : words_of(kReaches)) names.push_back(name);
  if (const auto height = value_of(kHeights, word)) {
    condition.value = *height;
    condition.movement.component = Component::height;
  } else if (const auto across = value_of(kAcross, word == "center" ? "centre" : word)) {
    condition.value = *across;
    condition.movement.component = Component::x;
  } else if (const auto reach = value_of(kReaches, word)) {
    condition.value = *reach;
    condition.movement.component = Component::forward;
  } else {
    in.fail(token.begin, fmt::format("expected a zone, found {}{}; use one of {}", QueryLexer::shown(token),
                                     did_you_mean(token.text, names), fmt::join(names, ", ")));
  }
  condition.compare = Compare::equal;
  in.expect(")", "close the parenthesis after the zone");
}

}  // namespace signweave
