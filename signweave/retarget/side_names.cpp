#include "signweave/retarget/side_names.h"

#include <array>

namespace signweave {
namespace {

bool is_lower(char c) noexcept {
  return c >= 'a' && c <= 'z';
}
bool is_letter(char c) noexcept {
  return is_lower(c) || (c >= 'A' && c <= 'Z');
}
bool separates(char c) noexcept {
  return c == '_' || c == '.' || c == '-' || c == ' ' || c == ':';
}

struct Sides {
  std::string_view left;
  std::string_view right;
};
constexpr std::array kWords = {Sides{"Left", "Right"}, Sides{"left", "right"}, Sides{"LEFT", "RIGHT"}};
constexpr std::array kLetters = {Sides{"l", "r"}, Sides{"L", "R"}};

/// The name with the first `word` that stands as a word of its own replaced.
std::optional<std::string> with_replaced(std::string_view name, std::string_view word, std::string_view by,
                                         bool stands_alone) {
  for (std::size_t at = name.find(word); at != std::string_view::npos; at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const char before = at > 0 ? name[at - 1] : '_';
    const char after = end < name.size() ? name[end] : '_';
    const bool begins = stands_alone ? separates(before) : !is_lower(word.front()) || !is_letter(before);
    const bool ends = stands_alone ? separates(after) : !is_lower(after);
    if (begins && ends) return std::string(name.substr(0, at)).append(by).append(name.substr(end));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> other_side(std::string_view name) {
  const auto exchanged = [&](const Sides& sides, bool stands_alone) {
    auto other = with_replaced(name, sides.left, sides.right, stands_alone);
    return other ? other : with_replaced(name, sides.right, sides.left, stands_alone);
  };
  for (const Sides& sides : kWords) {
    if (auto other = exchanged(sides, false)) return other;
  }
  for (const Sides& sides : kLetters) {
    if (auto other = exchanged(sides, true)) return other;
  }
  return std::nullopt;
}

}  // namespace signweave
