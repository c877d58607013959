#include "signweave/score/junction_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::bad_input, what);
}

/// Parses all of `text` as a number; none if it is not one.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

const TransitionMethod* method_in(std::string_view part) {
  if (const TransitionMethod* method = find_transition_method(part)) return method;
  std::vector<std::string> known;
  for (const TransitionMethod& method : transition_methods()) known.emplace_back(method.name);
  refuse(fmt::format("'{}' is not a method ({}), duration (450ms) or tempo (x1.5){}", printable(part),
                     fmt::join(known, ", "), did_you_mean(part, known)));
}

Milliseconds duration_in(std::string_view part) {
  if (!part.ends_with("ms")) {
    refuse(fmt::format("'{}': a duration needs its unit, as in 450ms", printable(part)));
  }
  const auto ms = number_in<std::int64_t>(part.substr(0, part.size() - 2));
  if (!ms || *ms > kLongestTransition.count()) {
    refuse(fmt::format("'{}' is not a duration of 0ms to {}ms", printable(part), kLongestTransition.count()));
  }
  return Milliseconds(*ms);
}

double tempo_in(std::string_view part) {
  const auto tempo = number_in<double>(part.substr(1));
  if (!tempo || !(*tempo >= kSlowestTempo && *tempo <= kFastestTempo)) {
    refuse(fmt::format("'{}' is not a tempo from x{} to x{}", printable(part), kSlowestTempo, kFastestTempo));
  }
  return *tempo;
}

void add(std::string_view part, JunctionChoice& choice) {
  const auto once = [&](bool is_new, std::string_view what) {
    if (!is_new) refuse(fmt::format("'{}': there is a {} already", printable(part), what));
  };
  if (part.empty()) refuse("a part is empty: expected a method, a duration (450ms) or a tempo (x1.5)");
  const bool is_tempo = part.size() > 1 && part[0] == 'x' && (is_digit(part[1]) || part[1] == '.' || part[1] == '-');
  if (is_digit(part[0])) {
    once(!choice.duration, "duration");
    choice.duration = duration_in(part);
  } else if (is_tempo) {
    once(!choice.tempo, "tempo");
    choice.tempo = tempo_in(part);
  } else {
    const TransitionMethod* const method = method_in(part);
    once(choice.method == nullptr, "method");
    choice.method = method;
  }
}

}  // namespace

NumberedJunction parse_junction(std::string_view text) {
  const std::size_t sign = text.find('=');
  if (sign == text.npos) {
    refuse(fmt::format("'{}': expected N=PART[,PART…], such as 2=hermite,450ms,x1.5", printable(text)));
  }
  const std::string_view number = trimmed(text.substr(0, sign));
  const auto counted = number_in<std::size_t>(number);
  if (!counted || *counted == 0) {
    refuse(fmt::format("'{}': '{}' is not a junction; they are numbered from 1", printable(text), printable(number)));
  }
  NumberedJunction one{.number = *counted, .choice = {}};
  for (std::size_t begin = sign + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    add(trimmed(text.substr(begin, end - begin)), one.choice);
    begin = end + 1;
  }
  return one;
}

JunctionChoices parse_junctions(std::span<const std::string> texts) {
  JunctionChoices choices;
  for (const std::string& text : texts) {
    const NumberedJunction one = parse_junction(text);
    if (!choices.emplace(one.number, one.choice).second) {
      refuse(fmt::format("junction {0} is named twice; combine its parts: {0}=PART,PART", one.number));
    }
  }
  return choices;
}

std::string to_string(const JunctionChoice& choice) {
  std::vector<std::string> parts;
  if (choice.method != nullptr) parts.emplace_back(choice.method->name);
  if (choice.duration) parts.push_back(fmt::format("{}ms", choice.duration->count()));
  if (choice.tempo) parts.push_back(fmt::format("x{}", *choice.tempo));
  return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace signweave
