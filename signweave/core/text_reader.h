#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "signweave/core/error.h"

namespace signweave {

/// Reads words and numbers from a text file; every error gives FILE:LINE. Uses a window of fixed size, so a file is
/// never in memory as a whole. Line ends are LF, CRLF or CR; a byte order mark at the start is skipped.
///
/// A view returned by one call is valid until the next call. Not thread-safe.
class TextReader {
 public:
  /// Opens a file. Throws Error{not_found} or Error{io} if it cannot be read.
  explicit TextReader(const std::filesystem::path& path);
  /// Reads borrowed text, which must outlive the reader; `name` is used for the file in errors.
  TextReader(std::string name, std::string_view text);
  ~TextReader();
  TextReader(const TextReader&) = delete;
  TextReader& operator=(const TextReader&) = delete;

  /// The next word (delimited by white space, across lines); empty at the end of the text. Throws Error{bad_input} for
  /// a word longer than 64 KiB, or one that contains a NUL byte (a binary file).
  std::string_view word();
  /// The next word, without consuming it.
  std::string_view peek();
  /// The rest of the line, trimmed, which is consumed together with the line end. At most 64 KiB.
  std::string_view rest_of_line();
  /// The next word as a finite number; `what` describes what is expected ("an offset") in an error.
  double number(std::string_view what);
  /// Consumes the next word. Throws Error{bad_input} if it is not `expected`.
  void expect(std::string_view expected);

  /// A run of consecutive numbers, as read by `plain_numbers`.
  struct NumberRun {
    std::size_t count = 0;
    std::size_t first_line = 0;  ///< the line of the first number; `line()` is that of the last
  };
  /// Fills `numbers` with the next words as long as they are plain numbers from -`most` to `most`; fast, with the same
  /// results as `number`. Stops before any other word and sometimes at the window's edge, so a count of 0 does not
  /// imply that no number follows: continue with `number`.
  NumberRun plain_numbers(std::span<double> numbers, double most);

  /// The line, counted from 1, of the word returned last.
  std::size_t line() const noexcept { return line_; }
  const std::string& name() const noexcept { return name_; }
  /// The size of the file in bytes; 0 if the system does not report it (a pipe).
  std::size_t total_bytes() const noexcept { return total_bytes_; }
  /// The number of bytes consumed so far, for a progress bar.
  std::size_t bytes_read() const noexcept { return consumed_; }

  /// Throws Error{bad_input, "NAME:LINE: what"}.
  [[noreturn]] void fail(std::string_view what, Remedies remedies = {}) const;
  Notice notice(std::string_view text) const;

 private:
  bool fill();
  int peek_char();
  void consume(std::size_t bytes) noexcept;
  void step_over(char c) noexcept;

  std::string name_;
  int file_ = -1;  ///< the descriptor; -1 if the text is borrowed
  std::unique_ptr<char[]> window_;
  std::size_t window_size_ = 0;
  std::string_view text_;  ///< the unread rest of the window or of the borrowed text
  std::size_t total_bytes_ = 0;
  std::size_t consumed_ = 0;
  std::size_t current_line_ = 1;
  std::size_t line_ = 1;
  bool after_return_ = false;  ///< the last character was a CR, so an LF belongs to the same line end
  std::string_view word_;      ///< points into the window or into `joined_`
  std::string joined_;         ///< a word or line that crosses the window's edge
  bool peeked_ = false;
};

}  // namespace signweave
