#include "signweave/core/text_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::size_t kWindow = std::size_t{1} << 18;
constexpr std::size_t kLongestWord = std::size_t{1} << 16;

enum class Kind : unsigned char { letter, blank, nul };

constexpr std::array<Kind, 256> kKinds = [] {
  std::array<Kind, 256> kinds{};
  kinds[0] = Kind::nul;
  kinds[' '] = Kind::blank;
  for (std::size_t c = '\t'; c <= '\r'; ++c) kinds[c] = Kind::blank;
  return kinds;
}();

Kind kind_of(char c) noexcept {
  return kKinds[static_cast<unsigned char>(c)];
}

/// True if a number that does not fit a double is too small rather than too large.
bool underflows(std::string_view text) noexcept {
  long long power = 0;  // the power of ten of the first nonzero digit
  bool point = false;
  bool digits = false;
  std::size_t i = 0;
  for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
    if (text[i] == '.') {
      point = true;
    } else if (text[i] >= '0' && text[i] <= '9') {
      digits = digits || text[i] != '0';
      if (digits && !point) ++power;
      if (!digits && point) --power;
    }
  }
  if (i < text.size()) {
    ++i;
    const bool negative = i < text.size() && text[i] == '-';
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    long long exponent = 0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), exponent);
    if (error == std::errc::result_out_of_range) return negative;
    power += negative ? -exponent : exponent;
  }
  return power < 0;
}

}  // namespace

TextReader::TextReader(const std::filesystem::path& path) : name_(path.string()) {
  file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) {
    const ErrorCode code = errno == ENOENT ? ErrorCode::not_found : ErrorCode::io;
    throw Error(code, fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
  }
  struct ::stat about {};
  if (::fstat(file_, &about) == 0) {
    if (S_ISDIR(about.st_mode)) {
      ::close(file_);
      throw Error(ErrorCode::bad_input, name_ + ": is a folder, expected a file");
    }
    if (S_ISREG(about.st_mode)) total_bytes_ = static_cast<std::size_t>(about.st_size);
  }
  // No larger than the file, so that small files cost little. One extra byte: the read that fills the window then also
  // detects the end of the file.
  window_size_ = total_bytes_ == 0 ? kWindow : std::min(kWindow, total_bytes_ + 1);
  window_ = std::make_unique_for_overwrite<char[]>(window_size_);
  fill();
  if (text_.starts_with("\xEF\xBB\xBF")) consume(3);
}

TextReader::TextReader(std::string name, std::string_view text)
    : name_(std::move(name)), text_(text), total_bytes_(text.size()) {
  if (text_.starts_with("\xEF\xBB\xBF")) consume(3);
}

TextReader::~TextReader() {
  if (file_ >= 0) ::close(file_);
}

bool TextReader::fill() {
  if (file_ < 0) return false;
  ssize_t got = 0;
  do {
    got = ::read(file_, window_.get(), window_size_);
  } while (got < 0 && errno == EINTR);
  if (got < 0) {
    const std::string reason = std::strerror(errno);
    ::close(file_);
    file_ = -1;
    throw Error(ErrorCode::io, fmt::format("{}: cannot be read: {}", name_, reason));
  }
  text_ = {window_.get(), static_cast<std::size_t>(got)};
  return got > 0;
}

int TextReader::peek_char() {
  if (text_.empty() && !fill()) return -1;
  return static_cast<unsigned char>(text_.front());
}

void TextReader::consume(std::size_t bytes) noexcept {
  text_.remove_prefix(bytes);
  consumed_ += bytes;
}

/// Counts lines. A CR counts at once, and an LF after it does not count again.
void TextReader::step_over(char c) noexcept {
  if (c == '\r' || (c == '\n' && !after_return_)) ++current_line_;
  after_return_ = c == '\r';
}

std::string_view TextReader::word() {
  if (peeked_) {
    peeked_ = false;
    return word_;
  }
  do {
    std::size_t blanks = 0;
    for (; blanks < text_.size() && kind_of(text_[blanks]) == Kind::blank; ++blanks) {
      step_over(text_[blanks]);
    }
    consume(blanks);
  } while (text_.empty() && fill());
  line_ = current_line_;
  after_return_ = false;

  // Nearly every word is complete in the window and returned from there; only a word at its edge is assembled.
  word_ = {};
  bool joined = false;
  while (!text_.empty()) {
    std::size_t size = 0;
    while (size < text_.size() && kind_of(text_[size]) == Kind::letter) ++size;
    if (size < text_.size() && text_[size] == '\0') fail("a NUL byte: this is not a text file");
    if (size + (joined ? joined_.size() : 0) > kLongestWord) {
      fail("a word of more than 64 KiB: this is not a file of the expected kind");
    }
    const std::string_view part = text_.substr(0, size);
    const bool whole = size < text_.size() || file_ < 0;
    if (whole && !joined) {
      word_ = part;
    } else {
      if (!joined) joined_.clear();
      joined_ += part;
      word_ = joined_;
      joined = true;
    }
    consume(size);
    if (whole || !fill()) break;
  }
  return word_;
}

std::string_view TextReader::peek() {
  if (!peeked_) {
    word();
    peeked_ = true;
  }
  return word_;
}

std::string_view TextReader::rest_of_line() {
  std::string line = peeked_ ? std::string(word_) : std::string();
  if (!peeked_) line_ = current_line_;
  peeked_ = false;
  // Nearly every line ends in the window. Any other line, and the line end, is read letter by letter.
  const std::size_t plain = std::min(text_.size(), kLongestWord - std::min(kLongestWord, line.size()));
  std::size_t size = 0;
  while (size < plain && text_[size] != '\n' && text_[size] != '\r' && text_[size] != '\0') ++size;
  line += text_.substr(0, size);
  consume(size);
  int c = peek_char();
  for (; c >= 0 && c != '\n' && c != '\r'; c = peek_char()) {
    if (c == 0) fail("a NUL byte: this is not a text file");
    if (line.size() == kLongestWord) fail("a line of more than 64 KiB where a name was expected");
    line += static_cast<char>(c);
    consume(1);
  }
  if (c >= 0) {
    step_over(static_cast<char>(c));
    consume(1);
    if (c == '\r' && peek_char() == '\n') consume(1);
    after_return_ = false;
  }
  joined_ = trimmed(line);
  word_ = joined_;
  return word_;
}

double TextReader::number(std::string_view what) {
  std::string_view text = word();
  if (text.empty()) fail(fmt::format("the file ends here, expected {}", what));
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) {
    // A number too small for a double counts as 0; one too large is as bad as infinity.
    if (underflows(text)) return 0.0;
    fail(fmt::format("'{}' is too large, expected {}", printable(word_), what));
  }
  if (error != std::errc() || end != text.data() + text.size()) {
    const bool comma = error == std::errc() && *end == ',';
    fail(fmt::format("expected {}, found '{}'{}", what, printable(word_), comma ? "; write a decimal point" : ""));
  }
  if (!std::isfinite(value)) {
    fail(fmt::format("expected {}, found '{}', which is not a finite number", what, printable(word_)));
  }
  return value;
}

void TextReader::expect(std::string_view expected) {
  const std::string_view found = word();
  if (found == expected) return;
  if (found.empty()) fail(fmt::format("the file ends here, expected {}", expected));
  fail(fmt::format("expected {}, found '{}'", expected, printable(found)));
}

void TextReader::fail(std::string_view what, Remedies remedies) const {
  throw Error(ErrorCode::bad_input, fmt::format("{}:{}: {}", name_, line_, what), std::move(remedies));
}

Notice TextReader::notice(std::string_view text) const {
  return {fmt::format("{}:{}", name_, line_), std::string(text)};
}

}  // namespace signweave
