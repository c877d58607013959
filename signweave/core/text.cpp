#include "signweave/core/text.h"

#include <fmt/format.h>
#include <utf8proc.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>

namespace signweave {
namespace {

struct Free {
  void operator()(utf8proc_uint8_t* text) const noexcept { std::free(text); }
};

std::string mapped(std::string_view text, int options) {
  utf8proc_uint8_t* result = nullptr;
  const auto* bytes = reinterpret_cast<const utf8proc_uint8_t*>(text.data());
  const utf8proc_ssize_t size = utf8proc_map(bytes, static_cast<utf8proc_ssize_t>(text.size()), &result,
                                             static_cast<utf8proc_option_t>(UTF8PROC_STABLE | options));
  const std::unique_ptr<utf8proc_uint8_t, Free> owner(result);
  if (size < 0) return std::string(text);  // not UTF-8: compared bytewise
  return {reinterpret_cast<const char*>(result), static_cast<std::size_t>(size)};
}

std::vector<utf8proc_int32_t> letters(std::string_view text) {
  std::vector<utf8proc_int32_t> result;
  const auto* at = reinterpret_cast<const utf8proc_uint8_t*>(text.data());
  auto left = static_cast<utf8proc_ssize_t>(text.size());
  while (left > 0) {
    utf8proc_int32_t letter = -1;
    utf8proc_ssize_t used = utf8proc_iterate(at, left, &letter);
    if (used < 1) {
      letter = *at;
      used = 1;
    }
    result.push_back(letter);
    at += used;
    left -= used;
  }
  return result;
}

/// Levenshtein distance in which a swap of two neighbours counts as one step.
std::size_t edit_distance(const std::vector<utf8proc_int32_t>& a, const std::vector<utf8proc_int32_t>& b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string match_form(std::string_view label) {
  const std::string_view inner = trimmed(label);
  if (std::all_of(inner.begin(), inner.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; })) {
    return std::string(inner);
  }
  return mapped(inner, UTF8PROC_COMPOSE);
}

bool is_utf8(std::string_view text) noexcept {
  const auto* at = reinterpret_cast<const utf8proc_uint8_t*>(text.data());
  auto left = static_cast<utf8proc_ssize_t>(text.size());
  while (left > 0) {
    // Checks many ASCII letters at once, since most text is ASCII.
    std::array<std::uint64_t, 4> many{};
    for (; left >= 32; at += 32, left -= 32) {
      std::memcpy(many.data(), at, sizeof many);
      if (((many[0] | many[1] | many[2] | many[3]) & 0x8080808080808080u) != 0) break;
    }
    for (; left > 0 && *at < 0x80; ++at) --left;
    if (left == 0) break;
    utf8proc_int32_t letter = -1;
    const utf8proc_ssize_t used = utf8proc_iterate(at, left, &letter);
    if (used < 1) return false;
    at += used;
    left -= used;
  }
  return true;
}

std::string fold_case(std::string_view text) {
  // ASCII is its own normal form, and most names are ASCII.
  const auto plain = [](char c) { return static_cast<unsigned char>(c - 1) < 0x7F; };
  if (std::all_of(text.begin(), text.end(), plain)) {
    std::string folded(text);
    for (char& c : folded) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return folded;
  }
  return mapped(text, UTF8PROC_COMPOSE | UTF8PROC_CASEFOLD);
}

std::string loose_form(std::string_view label) {
  const bool ascii = std::ranges::all_of(label, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  const std::string folded =
      ascii ? fold_case(label) : mapped(label, UTF8PROC_COMPAT | UTF8PROC_DECOMPOSE | UTF8PROC_CASEFOLD);
  std::string result;
  result.reserve(folded.size());
  for (std::size_t at = 0; at < folded.size();) {
    const std::string_view rest = std::string_view(folded).substr(at);
    utf8proc_int32_t letter = -1;
    utf8proc_ssize_t used = utf8proc_iterate(reinterpret_cast<const utf8proc_uint8_t*>(rest.data()),
                                             static_cast<utf8proc_ssize_t>(rest.size()), &letter);
    if (used < 1) used = 1, letter = 0xFFFD;  // not UTF-8: unchanged
    at += static_cast<std::size_t>(used);
    if (letter >= 0x300 && letter <= 0x36F) continue;
    if (letter == ' ' || (letter >= '\t' && letter <= '\r')) {
      if (!result.empty() && result.back() != ' ') result += ' ';
    } else if (letter == 0x153) {
      result += "oe";
    } else if (letter == 0xE6) {
      result += "ae";
    } else if (letter == 0x2019 || letter == 0x2018 || letter == 0x2BC || letter == 0x60 || letter == 0xB4) {
      result += '\'';
    } else {
      result += rest.substr(0, static_cast<std::size_t>(used));
    }
  }
  if (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

std::vector<std::string> near_matches(std::string_view wanted, std::span<const std::string> known, std::size_t most) {
  const std::vector<utf8proc_int32_t> target = letters(fold_case(match_form(wanted)));
  const std::size_t farthest = (target.size() + 1) / 3;  // for a single letter nothing is near
  if (target.empty()) return {};
  struct Near {
    std::size_t distance;
    std::string_view name;
  };
  std::vector<Near> near;
  for (const std::string& name : known) {
    const std::vector<utf8proc_int32_t> other = letters(fold_case(name));
    const std::size_t longer = std::max(other.size(), target.size());
    if (longer - std::min(other.size(), target.size()) > farthest || longer > 200) continue;
    const std::size_t distance = edit_distance(target, other);
    if (distance <= farthest) near.push_back({distance, name});
  }
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.name < b.name;
  });
  std::vector<std::string> result;
  for (const Near& one : near) {
    if (result.size() == most) break;
    if (result.empty() || result.back() != one.name) result.emplace_back(one.name);
  }
  return result;
}

std::string either_of(std::span<const std::string> names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) result += i + 1 == names.size() ? " or " : ", ";
    result += names[i];
  }
  return result;
}

std::string did_you_mean(std::string_view wanted, std::span<const std::string> known) {
  const std::vector<std::string> near = near_matches(wanted, known);
  return near.empty() ? std::string() : fmt::format("; did you mean {}?", either_of(near));
}

std::string printable(std::string_view text) {
  std::string result;
  std::size_t shown = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (++shown > 80 && (byte & 0xC0) != 0x80) return result + "…";
    if (byte < 0x20 || byte == 0x7F) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result;
}

std::string_view trimmed(std::string_view text) noexcept {
  constexpr std::string_view kBlank = " \t\r\n\v\f";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string size_text(std::uint64_t bytes) {
  constexpr double kKibi = 1024;
  const auto size = static_cast<double>(bytes);
  if (size < kKibi) return fmt::format("{} bytes", bytes);
  if (size < kKibi * kKibi) return fmt::format("{:.1f} KiB", size / kKibi);
  if (size < kKibi * kKibi * kKibi) return fmt::format("{:.1f} MiB", size / (kKibi * kKibi));
  return fmt::format("{:.2f} GiB", size / (kKibi * kKibi * kKibi));
}

}  // namespace signweave
