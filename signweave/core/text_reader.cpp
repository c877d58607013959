#include "signweave/core/text_reader.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::size_t kWindow = std::size_t{1} << 18;
constexpr std::size_t kLongestWord = std::size_t{1} << 16;

bool is_blank(int c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

TextReader::TextReader(const std::filesystem::path& path) : name_(path.string()) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorCode::bad_input, name_ + ": is a folder, expected a file");
  }
  file_ = std::fopen(path.c_str(), "rb");
  if (file_ == nullptr) {
    const ErrorCode code = errno == ENOENT ? ErrorCode::not_found : ErrorCode::io;
    throw Error(code, fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
  }
  const auto size = std::filesystem::file_size(path, ignored);
  total_bytes_ = ignored ? 0 : size;
  window_.resize(kWindow);
  fill();
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
}

TextReader::TextReader(std::string name, std::string_view text)
    : name_(std::move(name)), text_(text), total_bytes_(text.size()) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
}

TextReader::~TextReader() {
  if (file_ != nullptr) std::fclose(file_);
}

bool TextReader::fill() {
  if (file_ == nullptr) return false;
  const std::size_t got = std::fread(window_.data(), 1, window_.size(), file_);
  if (got == 0 && std::ferror(file_) != 0) {
    throw Error(ErrorCode::io, fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
  }
  text_ = {window_.data(), got};
  return got > 0;
}

int TextReader::look() {
  if (text_.empty() && !fill()) return -1;
  return static_cast<unsigned char>(text_.front());
}

int TextReader::get() {
  const int c = look();
  if (c < 0) return c;
  text_.remove_prefix(1);
  ++consumed_;
  if (c == '\n' || (c == '\r' && look() != '\n')) ++current_line_;
  return c;
}

std::string_view TextReader::word() {
  if (peeked_) {
    peeked_ = false;
    return word_;
  }
  word_.clear();
  while (is_blank(look())) get();
  line_ = current_line_;
  for (int c = look(); c >= 0 && !is_blank(c); c = look()) {
    if (c == 0) fail("a NUL byte: this is not a text file");
    if (word_.size() == kLongestWord) fail("a word of more than 64 KiB: this is not a text file");
    word_ += static_cast<char>(c);
    get();
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
  // A peeked word may stand on a later line, so peeking and then reading a line is a bug of the caller's.
  std::string line = peeked_ ? word_ : std::string();
  peeked_ = false;
  if (line.empty()) line_ = current_line_;
  for (int c = look(); c >= 0 && c != '\n' && c != '\r'; c = look()) {
    if (c == 0) fail("a NUL byte: this is not a text file");
    if (line.size() == kLongestWord) fail("a line of more than 64 KiB where a name was expected");
    line += static_cast<char>(c);
    get();
  }
  if (get() == '\r' && look() == '\n') get();
  word_ = std::string(trimmed(line));
  return word_;
}

double TextReader::number(std::string_view what) {
  std::string_view text = word();
  if (text.empty()) fail(fmt::format("the file ends here, expected {}", what));
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) {
    // Too small for a double is as good as 0; too large is as bad as infinite.
    const bool tiny = text.find("e-") != text.npos || text.find("E-") != text.npos || text.starts_with("0.0") ||
                      text.starts_with("-0.0") || text.starts_with(".0");
    if (tiny) return 0.0;
    fail(fmt::format("'{}' is too large, expected {}", printable(word_), what));
  }
  if (error != std::errc() || end != text.data() + text.size()) {
    fail(fmt::format("expected {}, found '{}'", what, printable(word_)));
  }
  if (!std::isfinite(value))
    fail(fmt::format("expected {}, found '{}', which is no finite number", what, printable(word_)));
  return value;
}

void TextReader::expect(std::string_view expected) {
  const std::string_view found = word();
  if (found == expected) return;
  if (found.empty()) fail(fmt::format("the file ends here, expected {}", expected));
  fail(fmt::format("expected {}, found '{}'", expected, printable(found)));
}

void TextReader::fail(std::string_view what) const {
  throw Error(ErrorCode::bad_input, fmt::format("{}:{}: {}", name_, line_, what));
}

Notice TextReader::notice(std::string_view text) const {
  return {fmt::format("{}:{}", name_, line_), std::string(text)};
}

}  // namespace signweave
