#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "signweave/core/text.h"
#include "signweave/formats/fbx/tree.h"

namespace signweave::fbx {
namespace {

bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_word(char c) noexcept {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '|' ||
         c == '-' || c == '+' || c == '.' || c == '#' || c == '*';
}
bool is_in_array(char c) noexcept {
  return is_blank(c) || c == ',' || (is_word(c) && c != '*' && c != '|' && c != '_');
}

class TextTreeReader {
 public:
  explicit TextTreeReader(const Source& source) : source_(source), text_(source.bytes) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
  }

  Record root() {
    Record root;
    while (skip_blanks(), at_ < text_.size()) {
      Record record = read(0, {});
      if (matters(0, record.name, {})) root.children.push_back(std::move(record));
    }
    return root;
  }

 private:
  char look() const noexcept { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_comment() noexcept {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  void skip_blanks() noexcept {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == ';') skip_comment();
      if (at_ == text_.size() || !is_blank(text_[at_])) return;
    }
  }
  void skip_blanks_of_line() noexcept {
    while (look() == ' ' || look() == '\t' || look() == '\r') ++at_;
  }

  std::string_view word() noexcept {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void count_one() {
    if (++values_ > kMostValues)
      source_.fail(at_, "more than 4 million values besides meshes; this is not an animation");
  }

  Value quoted() {
    const std::size_t begin = ++at_;
    const std::size_t end = text_.find_first_of("\"\n", begin);
    if (end == std::string_view::npos || text_[end] == '\n') source_.fail(begin, "a text without its closing quote");
    at_ = end + 1;
    Value value;
    value.kind = Value::Kind::text;
    value.bytes = text_.substr(begin, end - begin);
    return value;
  }

  Value plain() {
    const std::size_t begin = at_;
    const std::string_view token = word();
    Value value;
    if (token.empty()) {
      source_.fail(begin, fmt::format("expected a value, found '{}'", printable(text_.substr(begin, 1))));
    }
    const bool starts_like_number =
        token[0] == '-' || token[0] == '+' || token[0] == '.' || (token[0] >= '0' && token[0] <= '9');
    if (!starts_like_number) {  // T, W, Y: flags of records that do not concern bones
      value.kind = Value::Kind::text;
      value.bytes = token;
      return value;
    }
    const std::string_view digits = token[0] == '+' ? token.substr(1) : token;
    const char* const end = digits.data() + digits.size();
    const auto as_whole = std::from_chars(digits.data(), end, value.whole);
    if (as_whole.ec == std::errc() && as_whole.ptr == end) return value;
    value.kind = Value::Kind::real;
    value.real = 0;
    const auto as_real = std::from_chars(digits.data(), end, value.real);
    if (as_real.ec != std::errc() || as_real.ptr != end) {
      source_.fail(begin, fmt::format("expected a number, found '{}'", printable(token)));
    }
    return value;
  }

  /// *COUNT { a: NUMBERS }
  Value array() {
    const std::size_t place = at_++;
    Value value;
    value.kind = Value::Kind::array;
    value.type = 't';
    const std::string_view digits = word();
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value.count);
    if (error != std::errc() || end != digits.data() + digits.size()) {
      source_.fail(place, "expected '*' and how many numbers follow");
    }
    skip_blanks();
    expect('{', "after the count of an array");
    skip_blanks();
    if (look() == 'a') {
      ++at_;
      skip_blanks();
      expect(':', "after the 'a' of an array");
      const std::size_t begin = at_;
      while (at_ < text_.size() && is_in_array(text_[at_])) ++at_;
      value.bytes = text_.substr(begin, at_ - begin);
    }
    if (look() != '}') source_.fail(at_, "an array holds numbers, then '}'");
    ++at_;
    return value;
  }

  void expect(char c, std::string_view where) {
    if (look() != c) {
      source_.fail(at_, at_ < text_.size() ? fmt::format("expected '{}' {}", c, where)
                                           : fmt::format("the file ends, expected '{}' {}", c, where));
    }
    ++at_;
  }

  void read_values(Record& record) {
    skip_blanks_of_line();
    if (look() == '\n' || look() == ';' || look() == '{' || look() == '}' || at_ >= text_.size()) return;
    for (;;) {
      count_one();
      record.values.push_back(look() == '"' ? quoted() : look() == '*' ? array() : plain());
      const std::size_t after = at_;
      skip_blanks();
      if (look() != ',') {
        at_ = after;
        return;
      }
      ++at_;
      skip_blanks();
    }
  }

  Record read(int depth, std::string_view around) {
    Record record;
    record.place = at_;
    record.name = word();
    if (record.name.empty()) {
      source_.fail(at_, fmt::format("expected the name of a record, found '{}'", printable(text_.substr(at_, 1))));
    }
    if (look() != ':') source_.fail(at_, fmt::format("expected ':' after '{}'", printable(record.name)));
    ++at_;
    count_one();
    read_values(record);
    const std::size_t after = at_;
    skip_blanks();
    if (look() != '{') {
      at_ = after;
      return record;
    }
    const std::size_t open = at_++;
    if (!matters(depth, record.name, around)) {
      skip_block(open);
      return record;
    }
    if (depth >= kMostDepth) source_.fail(open, "records nested deeper than 32; export it again");
    for (;;) {
      skip_blanks();
      if (at_ >= text_.size()) unclosed(open, record.name);
      if (look() == '}') break;
      Record child = read(depth + 1, record.name);
      if (matters(depth + 1, child.name, record.name)) record.children.push_back(std::move(child));
    }
    ++at_;
    return record;
  }

  [[noreturn]] void unclosed(std::size_t open, std::string_view name) {
    source_.fail(open, fmt::format("the '{{' of {} is never closed; a '}}' or the rest of the file is missing",
                                   printable(name)));
  }

  /// Skips past the '}' that closes the preceding '{'.
  void skip_block(std::size_t open) {
    for (int depth = 1; depth > 0; ++at_) {
      skip_blanks();
      const char c = look();
      if (at_ >= text_.size()) unclosed(open, "a record");
      if (c == '{') ++depth;
      if (c == '}') --depth;
      if (c == '"') {
        at_ = text_.find('"', at_ + 1);
        if (at_ == std::string_view::npos) {
          at_ = text_.size();
          unclosed(open, "a record");
        }
      }
    }
  }

  const Source& source_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t values_ = 0;
};

}  // namespace

Record read_text_tree(const Source& source) {
  return TextTreeReader(source).root();
}

}  // namespace signweave::fbx
