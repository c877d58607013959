#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/text_reader.h"

/// The lines of ASF and AMC files. Internal to formats/asf.
namespace signweave::asf {

/// Lengths and angles beyond this are not measurements, and would overflow the arithmetic.
inline constexpr double kLargestNumber = 1e9;

/// One line after another as words, separated by white space, commas and parentheses. `#` begins a comment. Lines
/// without words are skipped.
class Lines {
 public:
  /// The reader must outlive it.
  explicit Lines(TextReader& reader) : reader_(reader) {}

  /// Advances to the next line that has words; false at the end of the file.
  bool next();
  /// Makes the next call of `next` stay at this line.
  void back() noexcept { again_ = true; }

  /// The words of the line, valid until the next call of `next`; empty before the first.
  std::span<const std::string_view> words() const noexcept { return words_; }
  std::string_view first() const noexcept { return words_.empty() ? std::string_view() : words_.front(); }
  /// True if the line begins a section: its first word begins with a colon.
  bool is_keyword() const noexcept { return first().starts_with(':'); }
  /// The words after the first as `count` numbers within ±kLargestNumber; `what` names them in errors ("direction").
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

/// A word as a finite number within ±kLargestNumber; values too small for a double are 0. Otherwise fails as `lines`
/// does, with `what` for what was expected.
double number_of(std::string_view word, const Lines& lines, std::string_view what);

/// The value of a word of at most 18 digits and nothing else; otherwise nullopt.
std::optional<std::int64_t> whole_number(std::string_view word) noexcept;

/// True if two words are equal, ignoring ASCII case.
bool same_word(std::string_view a, std::string_view b) noexcept;

/// "'word'", made printable for a message.
std::string in_quotes(std::string_view word);

/// "; did you mean A or B?", or an empty string; too long a list is not compared.
std::string did_you_mean_bone(std::string_view wanted, std::span<const std::string> known);

}  // namespace signweave::asf
