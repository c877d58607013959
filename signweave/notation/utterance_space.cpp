#include "signweave/notation/utterance_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::utterances {
namespace {

using enum UtteranceFault::Kind;

constexpr std::array kAims = {SpaceValue::from, SpaceValue::to, SpaceValue::at, SpaceValue::along, SpaceValue::past};

std::optional<SpaceValue> aim_of(const OptionToken& token) {
  const auto at = std::ranges::find_if(kAims, [&](SpaceValue value) { return token.is(name_of(value)); });
  return at == kAims.end() ? std::nullopt : std::optional(*at);
}

/// A token that begins with "@"; in quotes it is a name.
bool is_locus(const OptionToken& token) {
  return !token.quoted && token.text.starts_with('@');
}

class SpaceOptionReader {
 public:
  SpaceOptionReader(Cursor& cursor, const RawOption& raw, OptionsOf of, SpaceOptions& into)
      : cursor_(cursor), raw_(raw), of_(of), into_(into) {}
  bool read();

 private:
  void fault(std::string message) { cursor_.report(bad_option, raw_.at, std::move(message)); }
  const SpaceWord* word() const;
  bool may_stand(bool in_scope);
  void report_twice(SpaceValue value);
  bool in_range(const SpaceChange& change);
  bool give(SpaceValue value, const SpaceChange& change);
  void read_numbers(const SpaceNumbers& numbers);
  std::optional<LocusRef> locus_of(std::string_view text, WordSpan at);
  bool read_aim(std::span<const OptionToken> tokens, SpaceOptions& option);
  void read_aims();
  void read_setup();

  Cursor& cursor_;
  const RawOption& raw_;
  OptionsOf of_;
  SpaceOptions& into_;
};

/// A word that an expression has as its name is that expression.
const SpaceWord* SpaceOptionReader::word() const {
  const OptionToken& first = raw_.tokens.front();
  if (raw_.tokens.size() != 1 || first.quoted) return nullptr;
  const SpaceWord* const word = find_space_word(first.text);
  const auto& is_expression = cursor_.words().is_expression;
  return word != nullptr && is_expression && is_expression(first.text) ? nullptr : word;
}

/// Reports an option that cannot be where it is.
bool SpaceOptionReader::may_stand(bool in_scope) {
  if (of_ == OptionsOf::scope && !in_scope) {
    fault(fmt::format("this changes a single sign; put it directly behind the sign: A{{{}}}",
                      printable(joined(raw_.tokens))));
    return false;
  }
  if (raw_.extent) fault("a change in space has no end of its own; leave out the '..', or use a scope: {slow: A B}");
  return !raw_.extent;
}

void SpaceOptionReader::report_twice(SpaceValue value) {
  cursor_.report(repeated_option, raw_.at, fmt::format("'{}' is given twice; keep one", name_of(value)));
}

/// Reports values outside their limits.
bool SpaceOptionReader::in_range(const SpaceChange& change) {
  try {
    check(change);
  } catch (const Error& error) {
    fault(error.what());
    return false;
  }
  return true;
}

bool SpaceOptionReader::give(SpaceValue value, const SpaceChange& change) {
  if ((into_.given & bit_of(value)) != 0) {
    report_twice(value);
    return false;
  }
  into_.given = static_cast<std::uint16_t>(into_.given | bit_of(value));
  if (!is_spread(value)) into_.one_place_at = raw_.at;
  copy_value(value, change, into_.change);
  return true;
}

void SpaceOptionReader::read_numbers(const SpaceNumbers& numbers) {
  if (!may_stand(is_spread(numbers.value))) return;
  const std::optional<SpaceChange> change = change_of(numbers, raw_.tokens[1].text);
  if (!change) return fault(std::string(numbers.expected));
  if (in_range(*change)) give(numbers.value, *change);
}

/// The locus of a text without "@". Reports what is none.
std::optional<LocusRef> SpaceOptionReader::locus_of(std::string_view text, WordSpan at) {
  try {
    return read_locus(match_form(text));
  } catch (const Error& error) {
    cursor_.report(bad_locus, at, error.what());
    return std::nullopt;
  }
}

/// Reads a word and its loci, such as "from @self". False if it cannot be used; reports why.
bool SpaceOptionReader::read_aim(std::span<const OptionToken> tokens, SpaceOptions& option) {
  const SpaceValue value = *aim_of(tokens.front());
  if (tokens.size() < 2 || (tokens.size() > 2 && value != SpaceValue::along)) {
    fault(fmt::format("'{}' is followed by one locus: {} @left", name_of(value), name_of(value)));
    return false;
  }
  if ((option.given & bit_of(value)) != 0) {
    report_twice(value);
    return false;
  }
  option.given |= bit_of(value);
  SpaceChange& change = option.change;
  for (const OptionToken& token : tokens.subspan(1)) {
    std::optional<LocusRef> locus = locus_of(std::string_view(token.text).substr(1), token.at);
    if (!locus) return false;
    if (locus->kind == LocusRef::Kind::name && !is_built_in_locus(locus->name)) {
      option.uses.push_back({value, locus->name, token.at});
    }
    if (value == SpaceValue::along) {
      change.along.push_back(std::move(*locus));
    } else {
      auto& aim = value == SpaceValue::from ? change.from
                  : value == SpaceValue::to ? change.to
                  : value == SpaceValue::at ? change.at
                                            : change.past;
      aim = std::move(locus);
    }
  }
  return true;
}

/// Reads "from @self to @a", or one of the others.
void SpaceOptionReader::read_aims() {
  if (!may_stand(false)) return;
  const std::span<const OptionToken> tokens = raw_.tokens;
  SpaceOptions option;
  for (std::size_t begin = 0; begin < tokens.size();) {
    const std::optional<SpaceValue> value = aim_of(tokens[begin]);
    const bool verb = value == SpaceValue::from || value == SpaceValue::to;
    if (!value || (begin > 0 && !(verb && (tokens[0].is("from") || tokens[0].is("to"))))) {
      return fault("expected from @self to @left, at @left, past @left, or along @left @front @right");
    }
    std::size_t end = begin + 1;
    while (end < tokens.size() && is_locus(tokens[end])) ++end;
    if (!read_aim(tokens.subspan(begin, end - begin), option)) return;
    begin = end;
  }
  if (!in_range(option.change)) return;
  for (const SpaceValue value : kAims) {
    if ((option.given & bit_of(value)) != 0 && !give(value, option.change)) return;
  }
  std::ranges::move(option.uses, std::back_inserter(into_.uses));
}

/// Reads "@a = @left", with or without blanks.
void SpaceOptionReader::read_setup() {
  const std::string text = joined(raw_.tokens);
  const std::size_t sign = std::min(text.find('='), text.size());
  const std::string_view name = trimmed(std::string_view(text).substr(0, sign));
  const std::string_view is = trimmed(std::string_view(text).substr(std::min(sign + 1, text.size())));
  const bool quoted = std::ranges::any_of(raw_.tokens, &OptionToken::quoted);
  if (quoted || raw_.extent || !is.starts_with('@') || is.find(' ') != is.npos || name.find(' ') != name.npos) {
    return fault("a locus is set up by its name and where it is: @a = @left");
  }
  const std::optional<LocusRef> what = locus_of(name.substr(1), raw_.at);
  if (!what) return;
  if (what->kind != LocusRef::Kind::name) {
    return cursor_.report(bad_locus, raw_.at, "numbers need no name; set up a name: @a = @30/10");
  }
  if (is_built_in_locus(what->name)) {
    return cursor_.report(bad_locus, raw_.at,
                          fmt::format("'@{}' is always there; set up another name, such as @a", what->name));
  }
  if (std::optional<LocusRef> where = locus_of(is.substr(1), raw_.at)) {
    into_.loci.push_back({{what->name, std::move(*where)}, raw_.at});
  }
}

bool SpaceOptionReader::read() {
  const std::vector<OptionToken>& tokens = raw_.tokens;
  if (is_locus(tokens.front())) {
    read_setup();
  } else if (aim_of(tokens.front()) && tokens.size() > 1 && is_locus(tokens[1])) {
    read_aims();
  } else if (const SpaceWord* const found = word()) {
    if (may_stand(is_spread(found->value))) give(found->value, found->change);
  } else {
    if (tokens.size() != 2 || tokens[0].quoted || tokens[1].quoted) return false;
    const SpaceNumbers* const numbers = find_space_numbers(tokens[0].text, tokens[1].text);
    if (numbers == nullptr) return false;
    read_numbers(*numbers);
  }
  return true;
}

}  // namespace

bool may_have_colon(const RawOption& raw) {
  return !raw.tokens.empty() && aim_of(raw.tokens.front()) && aim_of(raw.tokens.back());
}

bool read_space_option(Cursor& cursor, const RawOption& raw, OptionsOf of, SpaceOptions& into) {
  return SpaceOptionReader(cursor, raw, of, into).read();
}

}  // namespace signweave::utterances
