#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "signweave/core/error.h"

namespace signweave {

/// Words and numbers from a text file, with FILE:LINE in every failure. Reads through a window of fixed size, so a file
/// never lies in memory whole. Line ends are LF, CRLF or CR; a byte order mark at the start is passed over.
///
/// A view returned by one call is valid until the next call. Not for several threads.
class TextReader {
 public:
  /// Opens a file. Throws Error{not_found} or Error{io} where it cannot be read.
  explicit TextReader(const std::filesystem::path& path);
  /// Reads borrowed text, which must outlive the reader; `name` stands for the file in errors.
  TextReader(std::string name, std::string_view text);
  ~TextReader();
  TextReader(const TextReader&) = delete;
  TextReader& operator=(const TextReader&) = delete;

  /// The next word (between white space, across lines); empty at the end of the text.
  /// Throws Error{bad_input} for a word longer than 64 KiB, or one that holds a NUL byte (a binary file).
  std::string_view word();
  /// The next word, not consumed.
  std::string_view peek();
  /// The rest of this line without white space at its ends, consumed with the line's end. At most 64 KiB.
  std::string_view rest_of_line();
  /// The next word as a finite number; `what` says what was expected ("an offset").
  double number(std::string_view what);
  /// The next word must be this one.
  void expect(std::string_view expected);

  /// Numbers one after the other, as read by `plain_numbers`.
  struct NumberRun {
    std::size_t count = 0;
    std::size_t first_line = 0;  ///< the line of the first; `line()` is that of the last
  };
  /// Fills `numbers` with the next words, as long as they are plain numbers from -`most` to `most`, read as `number`
  /// reads them; fast. Stops before any other word, and before some that lie at the window's edge, so no number at all
  /// says nothing: go on with `number`.
  NumberRun plain_numbers(std::span<double> numbers, double most);

  /// The line, from 1, of the word returned last.
  std::size_t line() const noexcept { return line_; }
  const std::string& name() const noexcept { return name_; }
  /// Bytes of the whole file, 0 where the system does not tell (a pipe).
  std::size_t total_bytes() const noexcept { return total_bytes_; }
  /// Bytes consumed so far: for a progress bar.
  std::size_t bytes_read() const noexcept { return consumed_; }

  /// Throws Error{bad_input, "NAME:LINE: what"}.
  [[noreturn]] void fail(std::string_view what, Remedies remedies = {}) const;
  Notice notice(std::string_view text) const;

 private:
  bool fill();
  int look();
  void consume(std::size_t bytes) noexcept;
  void step_over(char c) noexcept;

  std::string name_;
  int file_ = -1;  ///< the descriptor; none where the text is borrowed
  std::unique_ptr<char[]> window_;
  std::size_t window_size_ = 0;
  std::string_view text_;  ///< what is left of the window, or of the borrowed text
  std::size_t total_bytes_ = 0;
  std::size_t consumed_ = 0;
  std::size_t current_line_ = 1;
  std::size_t line_ = 1;
  bool after_return_ = false;  ///< the last character was a CR, so an LF belongs to the same line end
  std::string_view word_;      ///< into the window, or into `joined_`
  std::string joined_;         ///< a word or line that did not lie in one window
  bool peeked_ = false;
};

}  // namespace signweave
