#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/text_reader.h"

/// The lines of ASF and AMC files. Part of formats/asf, not for others.
namespace signweave::asf {

/// Lengths and angles past this are no measurements, and would not survive the arithmetic.
inline constexpr double kLargestNumber = 1e9;

/// Line after line as words, between white space, commas and parentheses. `#` begins a comment. Lines without words
/// are passed over.
class Lines {
 public:
  /// The reader must outlive it.
  explicit Lines(TextReader& reader) : reader_(reader) {}

  /// Goes to the next line that holds words; false at the end of the file.
  bool next();
  /// The next call of `next` stays at this line.
  void back() noexcept { again_ = true; }

  /// The words of the line, borrowed until the next call of `next`; none before the first.
  std::span<const std::string_view> words() const noexcept { return words_; }
  std::string_view first() const noexcept { return words_.empty() ? std::string_view() : words_.front(); }
  /// True where the line begins a section: its first word begins with a colon.
  bool is_keyword() const noexcept { return first().starts_with(':'); }
  /// The words after the first as `count` numbers within ±kLargestNumber; `what` says what they are ("direction").
  std::vector<double> numbers(std::size_t count, std::string_view what) const;

  const TextReader& reader() const noexcept { return reader_; }
  std::size_t line() const noexcept { return reader_.line(); }
  /// Throws Error{bad_input, "FILE:LINE: what"}.
  [[noreturn]] void fail(std::string_view what, Remedies remedies = {}) const {
    reader_.fail(what, std::move(remedies));
  }
  [[noreturn]] void fail_at(std::size_t line, std::string_view what, Remedies remedies = {}) const;

 private:
  TextReader& reader_;
  std::vector<std::string_view> words_;
  bool again_ = false;
};

/// A word as a finite number within ±kLargestNumber; what is too small for a double is 0. Otherwise fails as `lines`
/// does, with `what` for what was expected.
double number_of(std::string_view word, const Lines& lines, std::string_view what);

/// A word of nothing but digits, or none; one past 10^18 is none either.
std::optional<std::int64_t> whole_number(std::string_view word) noexcept;

/// True where a word is this one; upper and lower case of ASCII are one.
bool same_word(std::string_view a, std::string_view b) noexcept;

/// "'word'", fit for a message.
std::string in_quotes(std::string_view word);

/// "; did you mean A or B?", or nothing; what is too much to compare is not compared.
std::string did_you_mean_bone(std::string_view wanted, std::span<const std::string> known);

}  // namespace signweave::asf
