#include "app/server/http_target.h"

namespace signweave::server {
namespace {

int hex_digit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Calls `each` with the parts of `text` between separators.
template <typename Each>
bool for_parts(std::string_view text, char separator, const Each& each) {
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    if (!each(text.substr(begin, end - begin))) return false;
    if (end == std::string_view::npos) return true;
    begin = end + 1;
  }
}

}  // namespace

std::optional<std::string> percent_decoded(std::string_view text, bool plus) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = hex_digit(text[i + 1]);
      const int low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      out += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      out += plus && text[i] == '+' ? ' ' : text[i];
    }
  }
  return out;
}

std::optional<HttpTarget> parse_target(std::string_view target) {
  if (!target.starts_with('/')) return std::nullopt;
  target = target.substr(0, target.find('#'));
  const std::size_t mark = target.find('?');
  HttpTarget result;
  const std::string_view path = target.substr(1, mark == std::string_view::npos ? mark : mark - 1);
  const bool good_path = for_parts(path, '/', [&](std::string_view part) {
    const std::optional<std::string> segment = percent_decoded(part, false);
    if (!segment || segment->find('\0') != std::string::npos) return false;
    if (!segment->empty()) result.path.push_back(*segment);
    return true;
  });
  if (!good_path) return std::nullopt;
  if (path.empty() || path.ends_with('/')) result.path.emplace_back();
  if (mark == std::string_view::npos) return result;
  const bool good_query = for_parts(target.substr(mark + 1), '&', [&](std::string_view part) {
    if (part.empty()) return true;
    const std::size_t equals = part.find('=');
    std::optional<std::string> name = percent_decoded(part.substr(0, equals), true);
    std::optional<std::string> value =
        percent_decoded(equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1), true);
    if (!name || !value) return false;
    result.query.insert_or_assign(*std::move(name), *std::move(value));
    return true;
  });
  if (!good_query) return std::nullopt;
  return result;
}

}  // namespace signweave::server
