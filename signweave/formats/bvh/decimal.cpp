#include "signweave/formats/bvh/decimal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>

#include "signweave/formats/bvh/space.h"

namespace signweave::bvh {
namespace {

/// A double in fixed notation has at most 309 characters before the point; at most about 60 are requested after it.
constexpr std::size_t kLongest = 512;
constexpr std::array<double, 16> kPowers = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
constexpr std::array<std::uint64_t, 16> kWholePowers = [] {
  std::array<std::uint64_t, 16> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 10 * powers[i - 1];
  return powers;
}();
constexpr std::array<char, 200> kPairs = [] {
  std::array<char, 200> pairs{};
  for (std::size_t i = 0; i < 100; ++i) {
    pairs[2 * i] = static_cast<char>('0' + i / 10);
    pairs[2 * i + 1] = static_cast<char>('0' + i % 10);
  }
  return pairs;
}();

/// `value` in units of its last decimal, rounded as the exact value of the double is; nullopt if that cannot be
/// determined here. The product with an exact power of ten is rounded once, and never across a half, which is itself a
/// double: only if it equals one may the exact value lie on either side.
std::optional<std::uint64_t> in_last_places(double value, int decimals) noexcept {
  if (decimals >= static_cast<int>(kPowers.size())) return std::nullopt;
  const double scaled = value * kPowers[static_cast<std::size_t>(decimals)];
  if (!(scaled < 1e15)) return std::nullopt;
  const auto whole = static_cast<std::int64_t>(scaled);
  const double rest = scaled - static_cast<double>(whole);
  if (rest == 0.5) return std::nullopt;
  return static_cast<std::uint64_t>(whole + (rest > 0.5 ? 1 : 0));
}

/// The last `count` digits of `number`, with zeros in front.
void print_digits(char* at, std::uint64_t number, std::size_t count) noexcept {
  while (count >= 2) {
    count -= 2;
    std::memcpy(at + count, &kPairs[2 * (number % 100)], 2);
    number /= 100;
  }
  if (count == 1) *at = static_cast<char>('0' + number % 10);
}

char* print_whole(char* at, std::uint64_t number) noexcept {
  std::size_t count = 1;
  while (count < kWholePowers.size() && number >= kWholePowers[count]) ++count;
  print_digits(at, number, count);
  return at + count;
}

/// Prints `places` in units of the last of `decimals` decimals, without trailing zeros.
char* print_places(char* at, std::uint64_t places, std::size_t decimals, bool negative) noexcept {
  if (negative && places != 0) *at++ = '-';
  const std::uint64_t whole = places / kWholePowers[decimals];
  const std::uint64_t rest = places % kWholePowers[decimals];
  at = print_whole(at, whole);
  if (rest == 0) return at;
  *at++ = '.';
  print_digits(at, rest, decimals);
  at += decimals;
  while (at[-1] == '0') --at;
  return at;
}

/// The same for any number.
char* print_any(char* at, double value, int decimals) {
  const auto [end, size] = fmt::format_to_n(at, kLongest - 1, "{:.{}f}", value, decimals);
  char* last = end;
  if (decimals > 0) {
    while (last[-1] == '0') --last;
    if (last[-1] == '.') --last;
  }
  if (std::string_view(at, static_cast<std::size_t>(last - at)) == "-0") *(last = at)++ = '0';
  return last;
}

/// ⌊log10⌋ of a positive number; just below a power of ten it may return that power's exponent.
int magnitude(double value) noexcept {
  if (!(value >= 1e-14 && value < 1e14)) return static_cast<int>(std::floor(std::log10(value)));
  int power = 0;
  while (value >= kPowers[static_cast<std::size_t>(power) + 1]) ++power;
  while (value * kPowers[static_cast<std::size_t>(-std::min(power, 0))] < 1) --power;
  return power;
}

}  // namespace

char* DecimalText::room() {
  if (text_.size() < size_ + kLongest) text_.resize(2 * size_ + 8 * kLongest);
  return text_.data() + size_;
}

void DecimalText::fixed(double value, int decimals) {
  char* const at = room();
  const std::optional<std::uint64_t> places = in_last_places(std::abs(value), decimals);
  char* const end = places ? print_places(at, *places, static_cast<std::size_t>(decimals), value < 0)
                           : print_any(at, value, decimals);
  size_ += static_cast<std::size_t>(end - at);
}

void DecimalText::length(float metres, double unit) {
  const double value = static_cast<double>(metres) / unit;
  if (value == 0) return letter('0');
  // Nine significant digits identify every float.
  const double size = std::abs(value);
  const int last = std::max(4, 8 - magnitude(size));
  char* const at = room();
  for (int decimals = std::max(4, last - 5); decimals < last; ++decimals) {
    const std::optional<std::uint64_t> places = in_last_places(size, decimals);
    char* end = nullptr;
    double read = 0;
    if (places) {  // the text means places / 10^decimals, and both are exact
      read = static_cast<double>(static_cast<std::int64_t>(*places)) / kPowers[static_cast<std::size_t>(decimals)];
      if (value < 0) read = -read;
    } else {
      end = print_any(at, value, decimals);
      std::from_chars(at, end, read);
    }
    if (to_metres(static_cast<float>(read), unit) != metres) continue;
    if (places) end = print_places(at, *places, static_cast<std::size_t>(decimals), value < 0);
    size_ += static_cast<std::size_t>(end - at);
    return;
  }
  // The float nearest to it is the one in the file, if it came from a file; nine digits of another nearby number may
  // identify its neighbour.
  const auto nearest = static_cast<float>(value);
  fixed(std::isfinite(nearest) ? static_cast<double>(nearest) : value, last);
}

}  // namespace signweave::bvh
