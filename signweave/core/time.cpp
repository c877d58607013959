#include "signweave/core/time.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace signweave {
namespace {

FrameRate reduced(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t divisor = std::gcd(numerator, denominator);
  return {numerator / divisor, denominator / divisor};
}

/// A decimal number as digits · 10^-decimals, exact; empty if it has more than 17 significant digits or is not a
/// number.
struct Decimal {
  std::int64_t digits = 0;
  int decimals = 0;
};

std::optional<Decimal> parse_decimal(std::string_view text) {
  Decimal result;
  std::size_t i = 0;
  if (i < text.size() && text[i] == '+') ++i;
  bool any = false;
  bool point = false;
  for (; i < text.size(); ++i) {
    if (text[i] == '.' && !point) {
      point = true;
    } else if (text[i] >= '0' && text[i] <= '9') {
      if (result.digits > 9'999'999'999'999'999) return std::nullopt;
      result.digits = result.digits * 10 + (text[i] - '0');
      if (point) ++result.decimals;
      any = true;
    } else {
      break;
    }
  }
  if (!any) return std::nullopt;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && text[i] == '+') ++i;
    int exponent = 0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), exponent);
    if (error != std::errc() || end != text.data() + text.size() || std::abs(exponent) > 30) return std::nullopt;
    result.decimals -= exponent;
  } else if (i != text.size()) {
    return std::nullopt;
  }
  while (result.decimals > 0 && result.digits != 0 && result.digits % 10 == 0 && result.decimals > 15) {
    result.digits /= 10;
    --result.decimals;
  }
  return result;
}

constexpr std::array kWholeRates = {
    FrameRate{10, 1},  FrameRate{12, 1},  FrameRate{15, 1},  FrameRate{16, 1},  FrameRate{20, 1},  FrameRate{24, 1},
    FrameRate{25, 1},  FrameRate{30, 1},  FrameRate{48, 1},  FrameRate{50, 1},  FrameRate{60, 1},  FrameRate{72, 1},
    FrameRate{75, 1},  FrameRate{90, 1},  FrameRate{96, 1},  FrameRate{100, 1}, FrameRate{120, 1}, FrameRate{125, 1},
    FrameRate{144, 1}, FrameRate{150, 1}, FrameRate{180, 1}, FrameRate{200, 1}, FrameRate{240, 1}, FrameRate{250, 1},
    FrameRate{300, 1}, FrameRate{360, 1}, FrameRate{400, 1}, FrameRate{480, 1}, FrameRate{500, 1}, FrameRate{600, 1},
    FrameRate{960, 1}, FrameRate{1000, 1}};

constexpr std::array kNtscRates = {FrameRate{24000, 1001}, FrameRate{30000, 1001}, FrameRate{48000, 1001},
                                   FrameRate{60000, 1001}, FrameRate{120000, 1001}};

/// NTSC rates as users write them.
constexpr std::array kDecimalRates = {FrameRate{2997, 125}, FrameRate{2997, 100}, FrameRate{2997, 50}};

/// The rate whose frame time is nearest to `seconds`; empty if all differ by more than `most`.
std::optional<FrameRate> nearest(std::span<const FrameRate> rates, double seconds, double most) {
  std::optional<FrameRate> result;
  for (const FrameRate& rate : rates) {
    const double off = std::abs(rate.frame_time().count() - seconds);
    if (off > most) continue;
    most = off;
    result = rate;
  }
  return result;
}

}  // namespace

std::optional<SnappedRate> snap_frame_time(std::string_view text) {
  double seconds = 0;
  std::string_view unsigned_text = text;
  if (!unsigned_text.empty() && unsigned_text.front() == '+') unsigned_text.remove_prefix(1);
  const auto [end, error] = std::from_chars(unsigned_text.data(), unsigned_text.data() + unsigned_text.size(), seconds);
  if (error != std::errc() || end != unsigned_text.data() + unsigned_text.size()) return std::nullopt;
  if (!std::isfinite(seconds) || seconds < 1e-6 || seconds > 1e4) return std::nullopt;

  const std::optional<Decimal> decimal = parse_decimal(text);
  // Without exact decimals the last printed digit is unknown: use a double's own precision instead.
  const double half_place =
      decimal ? 0.5 * std::pow(10.0, -decimal->decimals) : seconds * std::numeric_limits<double>::epsilon();
  // A rounded frame time covers an interval of rates, which may contain several standard rates: "0.02" may be 48 or 50,
  // so the nearest one is taken; "0.0167" may be 60 or 59.94, so whole rates come first. The interval must also be
  // narrow enough to be meaningful: "0.03" identifies no rate.
  const double last_place = half_place * 1.02 + 1e-15;
  const double wide = std::min(last_place, 0.025 * seconds);
  const double narrow = std::min(last_place, 0.005 * seconds);
  std::optional<FrameRate> rate = nearest(kWholeRates, seconds, wide);
  if (!rate) rate = nearest(kNtscRates, seconds, wide);
  // Some programs truncate instead of rounding ("0.0166"), and some use "23.976" literally.
  if (!rate && decimal) rate = nearest(kWholeRates, seconds + half_place, narrow);
  if (!rate) rate = nearest(kDecimalRates, seconds, narrow);
  if (rate) return SnappedRate{*rate, rate->frame_time().count() != seconds};

  if (decimal && decimal->digits > 0 && decimal->decimals >= 0 && decimal->decimals <= 18) {
    std::int64_t numerator = 1;
    for (int i = 0; i < decimal->decimals; ++i) numerator *= 10;
    return SnappedRate{reduced(numerator, decimal->digits), false};
  }
  // Too long for an exact fraction: use the nearest fraction over 10^12.
  const double scaled = std::round(seconds * 1e12);
  if (scaled < 1.0 || scaled > 9e18) return std::nullopt;
  return SnappedRate{reduced(1'000'000'000'000, static_cast<std::int64_t>(scaled)), false};
}

std::optional<FrameRate> parse_frame_rate(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::optional<Decimal> top = parse_decimal(text.substr(0, slash));
  if (!top || top->digits == 0 || top->decimals > 12 || top->decimals < 0) return std::nullopt;
  std::int64_t denominator = 1;
  for (int i = 0; i < top->decimals; ++i) denominator *= 10;
  FrameRate rate = reduced(top->digits, denominator);
  if (slash != std::string_view::npos) {
    const std::optional<Decimal> bottom = parse_decimal(text.substr(slash + 1));
    if (!bottom || bottom->decimals != 0 || bottom->digits == 0 || top->decimals != 0) return std::nullopt;
    rate = reduced(top->digits, bottom->digits);
  } else {
    for (const FrameRate& standard : kNtscRates) {  // "29.97" means 30000/1001
      if (std::abs(standard.hertz() - rate.hertz()) < 0.006) rate = standard;
    }
  }
  if (rate.hertz() < 1e-4 || rate.hertz() > 1e6) return std::nullopt;
  return rate;
}

std::string to_string(FrameRate rate) {
  if (rate.denominator == 1) return fmt::format("{}", rate.numerator);
  if (rate.denominator == 1001) return fmt::format("{}/{}", rate.numerator, rate.denominator);
  return fmt::format("{:.9g}", rate.hertz());
}

FrameRange frames_of(TimeSpan span, const FrameClock& clock) noexcept {
  const auto nearest = [&](Milliseconds time) {
    const double frame = std::round(clock.frame_at(time));
    return static_cast<std::int64_t>(std::clamp(frame, -4e15, 4e15));
  };
  return {nearest(span.begin), nearest(span.end)};
}

TimeSpan span_of(FrameRange frames, const FrameClock& clock) noexcept {
  const auto at = [&](std::int64_t frame) {
    return Milliseconds(std::llround(clock.time_of(static_cast<double>(frame)).count() * 1000.0));
  };
  return {at(frames.begin), at(frames.end)};
}

FrameRange clamp(FrameRange range, std::int64_t frames) noexcept {
  const std::int64_t begin = std::clamp<std::int64_t>(range.begin, 0, frames);
  return {begin, std::clamp<std::int64_t>(range.end, begin, frames)};
}

}  // namespace signweave
