// The fast path of TextReader: runs of plain numbers, which motion files contain by the million. Anything that is not
// plain is left to TextReader::number, which handles every oddity and has all messages. Faster than fast_float over
// real files: decision 232.

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "signweave/core/text_reader.h"

namespace signweave {
namespace {

constexpr std::size_t kInspected = 16;    ///< characters of a word that are inspected at once
constexpr std::size_t kMargin = 32;       ///< bytes from a word's start that must be readable
constexpr std::ptrdiff_t kLongest = 256;  ///< longer words are not measured numbers

constexpr bool is_blank(char c) noexcept {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The powers of ten that a double represents exactly.
constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                            1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::array<std::uint64_t, 9> kWholePowers = {1,       10,        100,        1'000,      10'000,
                                                       100'000, 1'000'000, 10'000'000, 100'000'000};

/// Loads the bytes at `text`, the first into the lowest eight bits.
std::uint64_t eight_bytes(const char* text) noexcept {
  std::uint64_t bytes = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&bytes, text, sizeof bytes);
  } else {
    for (std::size_t i = 8; i-- > 0;) bytes = bytes << 8 | static_cast<unsigned char>(text[i]);
  }
  return bytes;
}

/// Bit i is set if character i of the sixteen at `text` is not a digit; the bits above are set, too.
std::uint32_t not_digits(const char* text) noexcept {
#if defined(__SSE2__)
  __m128i letters;
  std::memcpy(&letters, text, sizeof letters);
  // '0' to '9' become the ten smallest signed bytes.
  const __m128i moved = _mm_add_epi8(letters, _mm_set1_epi8(static_cast<char>(0x80 - '0')));
  const __m128i others = _mm_cmpgt_epi8(moved, _mm_set1_epi8(static_cast<char>(-128 + 9)));
  return static_cast<std::uint32_t>(_mm_movemask_epi8(others)) | 0xFFFF0000u;
#else
  const auto bits_of = [](std::uint64_t bytes) {
    // '0' to '9' become 0 to 9. The sum has a byte's highest bit if its lower seven exceed 9, and carries nothing over.
    const std::uint64_t moved = bytes ^ 0x3030303030303030u;
    const std::uint64_t others = (((moved & 0x7F7F7F7F7F7F7F7Fu) + 0x7676767676767676u) | moved) & 0x8080808080808080u;
    return static_cast<std::uint32_t>(((others >> 7) * 0x0102040810204080u) >> 56);  // byte i gives bit i
  };
  return bits_of(eight_bytes(text)) | bits_of(eight_bytes(text + 8)) << 8 | 0xFFFF0000u;
#endif
}

/// The number spelled by the first `count` (at most 8) of eight bytes, all digits: combines pairs, then fours, then all
/// eight.
std::uint64_t number_of(std::uint64_t bytes, unsigned count) noexcept {
  std::uint64_t digits = bytes ^ 0x3030303030303030u;
  digits = count == 0 ? 0 : digits << (64 - 8 * count);  // missing digits become leading zeros
  digits = (digits & 0x00FF00FF00FF00FFu) * 10 + ((digits >> 8) & 0x00FF00FF00FF00FFu);
  digits = (digits & 0x0000FFFF0000FFFFu) * 100 + ((digits >> 16) & 0x0000FFFF0000FFFFu);
  return (digits & 0xFFFFFFFFu) * 10'000 + (digits >> 32);
}

struct Scanned {
  double value = 0;
  const char* end = nullptr;  ///< null if the word is not a plain number
};

/// Parses an exponent such as "e-06" at `text` and adds it to `power`. Returns its end, or null.
const char* read_exponent(const char* text, int& power) noexcept {
  ++text;
  const bool negative = *text == '-';
  if (*text == '-' || *text == '+') ++text;
  int exponent = 0;
  int digits = 0;
  for (; *text >= '0' && *text <= '9' && digits < 3; ++text, ++digits) exponent = 10 * exponent + (*text - '0');
  power += negative ? -exponent : exponent;
  return digits == 0 ? nullptr : text;
}

/// Parses a number of at most eight digits before and eight after its point, correctly rounded: its digits are a whole
/// number below 2^53 and its power of ten is exact, so one division (or multiplication) rounds once. kMargin bytes must
/// be readable.
Scanned scan_short(const char* word) noexcept {
  const bool negative = *word == '-';
  const unsigned sign = negative ? 1 : 0;
  const std::uint32_t others = not_digits(word) & ~std::uint32_t{1};
  if (!negative && static_cast<unsigned char>(*word - '0') > 9) return {};
  const auto point = static_cast<unsigned>(std::countr_zero(others));
  if (point > 8) return {};
  std::uint64_t bytes = eight_bytes(word);
  bytes = negative ? (bytes & ~std::uint64_t{0xFF}) | std::uint64_t{'0'} : bytes;
  std::uint64_t mantissa = number_of(bytes, point);
  unsigned end = point;
  unsigned decimals = 0;
  if (word[point] == '.') {
    end = static_cast<unsigned>(std::countr_zero(others & (others - 1)));
    decimals = end - point - 1;
    if (end >= kInspected || decimals > 8) return {};
    mantissa = mantissa * kWholePowers[decimals] + number_of(eight_bytes(word + point + 1), decimals);
  }
  if (point - sign + decimals == 0) return {};
  const char* after = word + end;
  double value = static_cast<double>(static_cast<std::int64_t>(mantissa));
  if (*after != 'e' && *after != 'E') {
    value /= kPowers[decimals];
  } else {
    int power = -static_cast<int>(decimals);
    after = read_exponent(after, power);
    if (after == nullptr || power < -22 || power > 22) return {};
    value = power < 0 ? value / kPowers[static_cast<std::size_t>(-power)]
                      : value * kPowers[static_cast<std::size_t>(power)];
  }
  return {negative ? -value : value, after};
}

/// Parses any other number that the standard library reads completely.
Scanned scan_any(const char* word, const char* end) noexcept {
  Scanned scanned;
  const auto [after, error] = std::from_chars(word, end, scanned.value);
  if (error == std::errc() && after != end && after - word < kLongest) scanned.end = after;
  return scanned;
}

}  // namespace

TextReader::NumberRun TextReader::plain_numbers(std::span<double> numbers, double most) {
  NumberRun run;
  if (peeked_ || text_.size() <= kMargin) return run;
  const char* const begin = text_.data();
  const char* const end = begin + text_.size();
  const char* const last = end - kMargin;  // words that start here or later are not inspected
  const char* at = begin;
  std::size_t line = current_line_;
  bool after_return = after_return_;
  while (run.count < numbers.size()) {
    for (; at < last && is_blank(*at); ++at) {
      if (*at == '\r' || (*at == '\n' && !after_return)) ++line;
      after_return = *at == '\r';
    }
    if (at >= last) break;
    Scanned scanned = scan_short(at);
    if (scanned.end == nullptr) scanned = scan_any(at, end);
    if (scanned.end == nullptr || !is_blank(*scanned.end) || !(std::abs(scanned.value) <= most)) break;
    if (run.count == 0) run.first_line = line;
    numbers[run.count++] = scanned.value;
    line_ = line;
    after_return = false;
    at = scanned.end;
  }
  current_line_ = line;
  after_return_ = after_return;
  consume(static_cast<std::size_t>(at - begin));
  return run;
}

}  // namespace signweave
