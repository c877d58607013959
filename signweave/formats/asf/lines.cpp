#include "signweave/formats/asf/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "signweave/core/text.h"

namespace signweave::asf {
namespace {

constexpr std::size_t kMostCompared = 1000;     ///< names
constexpr std::size_t kLongestCompared = 64;    ///< bytes
constexpr std::size_t kMostDigitsOfFrame = 18;  ///< so that a frame number does not overflow

constexpr bool parts_words(char c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r') || c == ',' || c == '(' || c == ')';
}

/// True for a number outside the range of a double that is too small, not too large.
bool is_nearly_zero(std::string_view text) noexcept {
  long double value = 1;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return std::abs(value) < 1;
}

}  // namespace

bool Lines::next() {
  if (again_) {
    again_ = false;
    return !words_.empty();
  }
  words_.clear();
  while (words_.empty() && !reader_.peek().empty()) {
    std::string_view text = reader_.rest_of_line();
    text = text.substr(0, text.find('#'));
    while (!text.empty()) {
      std::size_t size = 0;
      while (size < text.size() && !parts_words(text[size])) ++size;
      if (size > 0) words_.push_back(text.substr(0, size));
      while (size < text.size() && parts_words(text[size])) ++size;
      text.remove_prefix(size);
    }
  }
  return !words_.empty();
}

std::vector<double> Lines::numbers(std::size_t count, std::string_view what) const {
  const std::size_t found = words_.empty() ? 0 : words_.size() - 1;
  if (found != count) {
    fail(fmt::format("expected {} number{} of {}, found {}", count, count == 1 ? "" : "s", what, found));
  }
  std::vector<double> result;
  for (std::size_t i = 1; i < words_.size(); ++i) {
    result.push_back(number_of(words_[i], *this, fmt::format("a number of {}", what)));
  }
  return result;
}

void Lines::fail_at(std::size_t line, std::string_view what, Remedies remedies) const {
  throw Error(ErrorCode::bad_input, fmt::format("{}:{}: {}", reader_.name(), line, what), std::move(remedies));
}

double number_of(std::string_view word, const Lines& lines, std::string_view what) {
  std::string_view text = word;
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) {
    lines.fail(fmt::format("expected {}, found {}", what, in_quotes(word)));
  }
  if (error == std::errc::result_out_of_range) {
    if (is_nearly_zero(text)) return 0;
    lines.fail(fmt::format("{} is too large, expected {}", in_quotes(word), what));
  }
  if (!std::isfinite(value)) {
    lines.fail(fmt::format("expected {}, found {}, which is not a finite number", what, in_quotes(word)));
  }
  if (std::abs(value) > kLargestNumber) {
    lines.fail(fmt::format("{:g} is too large for {}; values beyond {:g} are not accepted as measurements", value, what,
                           kLargestNumber));
  }
  return value;
}

std::optional<std::int64_t> whole_number(std::string_view word) noexcept {
  const bool digits = std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (word.empty() || word.size() > kMostDigitsOfFrame || !digits) return std::nullopt;
  std::int64_t value = 0;
  std::from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

bool same_word(std::string_view a, std::string_view b) noexcept {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::string in_quotes(std::string_view word) {
  return fmt::format("'{}'", printable(word));
}

std::string did_you_mean_bone(std::string_view wanted, std::span<const std::string> known) {
  if (wanted.size() > kLongestCompared || known.size() > kMostCompared) return {};
  std::vector<std::string> names;
  for (const std::string& name : known) {
    if (name.size() <= kLongestCompared && printable(name) == name) names.push_back(name);
  }
  return did_you_mean(wanted, names);
}

}  // namespace signweave::asf
