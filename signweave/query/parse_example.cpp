#include "signweave/query/parse_example.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/query/parse_point.h"

namespace signweave {
namespace {

/// "1200..3400", in milliseconds unless a unit is given.
TimeSpan parse_span(QueryLexer& in) {
  const std::size_t begin = in.peek().begin;
  std::string text;
  while (in.peek().kind == QueryToken::Kind::word) text += in.take().text;
  const std::size_t dots = text.find("..");
  constexpr std::string_view kWrite = "write its begin and end in milliseconds, such as 1200..3400";
  if (dots == std::string::npos) in.fail(begin, fmt::format("'{}' is not a time span; {}", printable(text), kWrite));
  const auto bound = [&](std::string_view part) {
    std::string_view digits = part;
    std::int64_t times = 1;
    if (digits.ends_with("ms")) {
      digits.remove_suffix(2);
    } else if (digits.ends_with("s")) {
      digits.remove_suffix(1);
      times = 1000;
    }
    double value = 0;
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
    const double count = value * static_cast<double>(times);
    if (digits.empty() || end.ec != std::errc() || end.ptr != digits.data() + digits.size() || std::abs(count) > 1e12 ||
        std::abs(count - std::round(count)) > 1e-6) {
      in.fail(begin, fmt::format("'{}' is not a time in whole milliseconds; {}", printable(part), kWrite));
    }
    return Milliseconds(static_cast<std::int64_t>(std::round(count)));
  };
  const TimeSpan result{bound(std::string_view(text).substr(0, dots)), bound(std::string_view(text).substr(dots + 2))};
  if (result.end <= result.begin) in.fail(begin, "the example ends before it begins; swap the two times");
  return result;
}

}  // namespace

Condition parse_example(QueryLexer& in, const QueryToken& name) {
  Condition result;
  result.field = Field::like;
  Example example;
  in.expect("(", R"(name a span of a recording: like("meteo"@1200..3400))");
  const QueryToken recording = in.take();
  if (recording.kind != QueryToken::Kind::text && recording.kind != QueryToken::Kind::word) {
    in.fail(recording.begin, fmt::format("expected a recording's name, found {}; write like(\"meteo\"@1200..3400)",
                                         QueryLexer::shown(recording)));
  }
  example.recording = recording.text;
  in.expect("@", R"(give the begin and end: like("meteo"@1200..3400))");
  example.span = parse_span(in);
  while (in.accept(",")) {
    const std::size_t begin = in.peek().begin;
    const Point added = parse_point(in, true);
    if (std::find(example.points.begin(), example.points.end(), added) != example.points.end()) {
      in.fail(begin, fmt::format("'{}' is named twice; name it once", to_string(added)));
    }
    example.points.push_back(added);
  }
  in.expect(")", fmt::format("close the parenthesis of '{}', or name points after commas", name.text));
  result.value = std::move(example);
  return result;
}

}  // namespace signweave
