#include "signweave/formats/gltf/rate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace signweave::gltf {
namespace {

using AllTimes = std::span<const std::shared_ptr<KeyTimes>>;

/// The rates that are tried for keys, ascending.
constexpr FrameRate kKeyRates[] = {{10, 1},       {12, 1},  {15, 1},  {20, 1},  {24000, 1001},  {24, 1},  {25, 1},
                                   {30000, 1001}, {30, 1},  {48, 1},  {50, 1},  {60000, 1001},  {60, 1},  {72, 1},
                                   {75, 1},       {90, 1},  {96, 1},  {100, 1}, {120000, 1001}, {120, 1}, {125, 1},
                                   {144, 1},      {150, 1}, {180, 1}, {200, 1}, {240, 1},       {250, 1}, {300, 1},
                                   {360, 1},      {400, 1}, {480, 1}, {500, 1}, {600, 1},       {960, 1}, {1000, 1}};

constexpr FrameRate kRateOfOneKey{30, 1};
constexpr FrameRate kRateOfUnevenKeys{120, 1};
constexpr double kKeySlack = 1e-3;      // of a frame, in addition to the precision of a float
constexpr double kRoundedSlack = 0.06;  // of a frame: 0.033 s for a thirtieth

/// The distance in frames within which a key counts as being at a frame.
double key_slack(float seconds, double hertz, double slack) {
  const double step = static_cast<double>(std::nextafter(seconds, std::numeric_limits<float>::infinity())) -
                      static_cast<double>(seconds);
  return std::min(slack + step * hertz, 0.25);
}

/// The largest distance of a key from its frame; nullopt if any key is too far from its frame to be meant for it.
std::optional<double> farthest_key(AllTimes all, double start, double hertz, double slack) {
  double farthest = 0;
  for (const auto& times : all) {
    for (const float seconds : times->seconds) {
      const double frame = (static_cast<double>(seconds) - start) * hertz;
      const double off = std::abs(frame - std::round(frame));
      if (off > key_slack(seconds, hertz, slack)) return std::nullopt;
      farthest = std::max(farthest, off);
    }
  }
  return farthest;
}

bool keys_stand(AllTimes all, double start, double hertz, double slack) {
  return farthest_key(all, start, hertz, slack).has_value();
}

double span_of_keys(const KeyTimes& times) {
  return static_cast<double>(times.seconds.back()) - static_cast<double>(times.seconds.front());
}

/// The list with the most keys, which represents the density of all.
const KeyTimes& fullest(AllTimes all) {
  return **std::ranges::max_element(all, {}, [](const auto& times) { return times->seconds.size(); });
}

bool every_second_frame(const KeyTimes& times, double hertz) {
  return 2 * static_cast<double>(times.seconds.size()) >= span_of_keys(times) * hertz + 1;
}

bool every_frame(const KeyTimes& times, double hertz) {
  return std::abs(span_of_keys(times) * hertz - static_cast<double>(times.seconds.size() - 1)) < 0.5;
}

/// The lowest standard rate that fits the keys. A few keys fit both 29.97 and 30: the nearer one is taken.
std::optional<FrameRate> standard_rate(AllTimes all, double start, KeyHabits habits) {
  std::optional<FrameRate> found;
  double nearest = 0;
  const double least = habits.key_a_frame ? 0.0 : habits.smooth ? 59.0 : 23.0;
  for (const FrameRate& rate : kKeyRates) {
    const double hertz = rate.hertz();
    if (found && hertz > 1.002 * found->hertz()) break;
    if (habits.key_a_frame && !every_frame(fullest(all), hertz)) continue;
    if (!every_second_frame(fullest(all), hertz) && hertz < least) continue;
    const std::optional<double> off = farthest_key(all, start, hertz, kKeySlack);
    if (!off || (found && *off >= nearest)) continue;
    found = rate;
    nearest = *off;
  }
  return found;
}

/// The fraction of the smallest denominator in [low, high], both positive.
std::optional<FrameRate> simplest_between(double low, double high) {
  for (std::int64_t denominator = 1; denominator <= 1001; ++denominator) {
    const double numerator = std::ceil(low * static_cast<double>(denominator));
    if (numerator > high * static_cast<double>(denominator) || numerator < 1) continue;
    const auto whole = static_cast<std::int64_t>(numerator);
    const std::int64_t divisor = std::gcd(whole, denominator);
    return FrameRate{whole / divisor, denominator / divisor};
  }
  return std::nullopt;
}

/// A non-standard rate for evenly spaced keys.
std::optional<FrameRate> rate_of_even_keys(AllTimes all, double start) {
  const KeyTimes& times = fullest(all);
  const double span = span_of_keys(times);
  const auto steps = static_cast<double>(times.seconds.size() - 1);
  const double hertz = steps / span;
  if (!(hertz >= 0.01 && hertz <= 10'000)) return std::nullopt;
  const double off = std::min(key_slack(times.seconds.back(), hertz, kKeySlack) / steps, 1e-3);
  const std::optional<FrameRate> rate = simplest_between(hertz * (1 - off), hertz * (1 + off));
  return rate && keys_stand(all, start, rate->hertz(), kKeySlack) ? rate : std::nullopt;
}

FrameRate rate_of_uneven_keys(AllTimes all, double start) {
  const KeyTimes& times = fullest(all);
  for (const FrameRate& rate : kKeyRates) {
    if (every_second_frame(times, rate.hertz()) && keys_stand(all, start, rate.hertz(), kRoundedSlack)) return rate;
  }
  const double hertz = static_cast<double>(times.seconds.size() - 1) / span_of_keys(times);
  if (hertz <= kRateOfUnevenKeys.hertz()) return kRateOfUnevenKeys;
  return *std::ranges::min_element(kKeyRates, {},
                                   [&](const FrameRate& rate) { return std::abs(rate.hertz() - hertz); });
}

}  // namespace

Timing timing_of(AllTimes times, KeyHabits habits, std::optional<FrameRate> given) {
  Timing timing{.rate = given.value_or(kRateOfOneKey), .start = std::numeric_limits<double>::infinity()};
  double end = 0;
  for (const auto& one : times) {
    timing.start = std::min(timing.start, static_cast<double>(one->seconds.front()));
    end = std::max(end, static_cast<double>(one->seconds.back()));
  }
  if (times.empty()) timing.start = 0;
  std::vector<std::shared_ptr<KeyTimes>> lists;
  std::ranges::copy_if(times, std::back_inserter(lists), [](const auto& one) { return one->seconds.size() > 1; });
  if (lists.empty()) {
    timing.known_from_keys = false;
    if (!(end > timing.start)) return timing;
    lists.assign(times.begin(), times.end());
  }
  if (!given) {
    std::optional<FrameRate> found = standard_rate(lists, timing.start, habits);
    if (!found && timing.known_from_keys) found = rate_of_even_keys(lists, timing.start);
    timing.even = found.has_value();
    timing.rate = found                    ? *found
                  : timing.known_from_keys ? rate_of_uneven_keys(lists, timing.start)
                                           : kRateOfUnevenKeys;
  } else {
    timing.even = keys_stand(lists, timing.start, given->hertz(), kKeySlack);
  }
  const double hertz = timing.rate.hertz();
  const double last = (end - timing.start) * hertz;
  timing.frames = static_cast<std::int64_t>(std::ceil(last - key_slack(static_cast<float>(end), hertz, kKeySlack))) + 1;
  timing.frames = std::max<std::int64_t>(timing.frames, 1);
  return timing;
}

void place_keys(KeyTimes& times, const Timing& timing) {
  const double hertz = timing.rate.hertz();
  times.frames.clear();
  times.frames.reserve(times.seconds.size());
  times.one_a_frame = static_cast<std::int64_t>(times.seconds.size()) == timing.frames;
  for (const float seconds : times.seconds) {
    const double frame = (static_cast<double>(seconds) - timing.start) * hertz;
    const double nearest = std::round(frame);
    const bool on_it = std::abs(frame - nearest) <= key_slack(seconds, hertz, kKeySlack);
    times.one_a_frame = times.one_a_frame && on_it && nearest == static_cast<double>(times.frames.size());
    times.frames.push_back(on_it ? nearest : frame);
  }
}

}  // namespace signweave::gltf
