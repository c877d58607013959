#include "signweave/query/parse_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "signweave/core/text.h"

namespace signweave {
namespace {

Milliseconds time_in(const QueryLexer& in, std::string_view word, std::size_t offset) {
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
    in.fail(offset, fmt::format("'{}' is not a time; write one such as 300ms or 1.5s", printable(word)));
  }
  if (unit == 0) in.fail(offset, fmt::format("the time {} lacks a unit; write {}ms or {}s", word, word, word));
  while (part.ends_with('0')) part.pop_back();
  const std::size_t decimals = milliseconds ? 0 : 3;
  if (part.size() > decimals) in.fail(offset, "times are whole milliseconds; round this one");
  part.resize(decimals, '0');
  const std::string all = std::string(whole) + part;
  if (all.size() > 15) in.fail(offset, "a time of more than 15 digits; write a smaller one");
  const std::int64_t count = std::stoll(all);
  return Milliseconds(negative ? -count : count);
}

}  // namespace

Milliseconds parse_time(QueryLexer& in, const QueryToken& token) {
  std::string word = token.text;
  const bool number =
      token.kind == QueryToken::Kind::word && word.find_first_not_of("+-.0123456789") == std::string::npos;
  if (number && in.peek().kind == QueryToken::Kind::word && (in.peek().text == "ms" || in.peek().text == "s")) {
    word += in.take().text;
  }
  return time_in(in, word, token.begin);
}

Interval parse_gap(QueryLexer& in) {
  const std::string_view inside = in.bracketed();
  const std::size_t dots = inside.find("..");
  if (dots == std::string_view::npos) {
    in.fail(in.offset_of(inside), "a gap has two bounds, one of which may be omitted; write ->[..500ms]");
  }
  const auto bound = [&](std::string_view part) -> std::optional<Milliseconds> {
    const std::string_view word = trimmed(part);
    if (word.empty()) return std::nullopt;
    const Milliseconds result = time_in(in, word, in.offset_of(word));
    if (result < 0ms) {
      in.fail(in.offset_of(word), "a gap cannot be negative; use overlaps for segments that overlap");
    }
    return result;
  };
  const Interval result{bound(inside.substr(0, dots)), bound(inside.substr(dots + 2))};
  if (result.direct()) {
    in.fail(in.offset_of(inside), "a gap without bounds; write -> for neighbours, ->[0ms..] for any later segment");
  }
  if (result.least && result.most && *result.least > *result.most) {
    in.fail(in.offset_of(inside), "the gap's first bound is above its second; swap them");
  }
  return result;
}

}  // namespace signweave
