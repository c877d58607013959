#include "signweave/nonmanual/mouthing/mouthing.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

// How long the captured mouth takes to become the authored one, and back. (ours)
constexpr Milliseconds kMouthOnset{60};
constexpr Milliseconds kMouthOffset{80};

double natural_length(const Phone& phone) {
  return kSoundLength * relative_length(phone.viseme) * static_cast<double>(phone.length);
}

double natural_length(const std::vector<Phone>& phones, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += natural_length(phones[i]);
  return sum;
}

/// The number of phones in the syllables that fit, at least the first syllable.
std::size_t phones_that_fit(const std::vector<Phone>& phones, double length) {
  const std::vector<std::size_t> begins = syllables_of(phones);
  std::size_t fitting = 0;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const std::size_t end = i + 1 < begins.size() ? begins[i + 1] : phones.size();
    if (fitting > 0 && kMostCompressed * natural_length(phones, end) > length) break;
    fitting = end;
  }
  return fitting;
}

std::size_t last_vowel(const std::vector<Phone>& phones, std::size_t count) {
  for (std::size_t i = count; i > 0; --i) {
    if (phones[i - 1].nucleus) return i - 1;
  }
  return count - 1;
}

}  // namespace

FittedSounds fit_sounds(const std::vector<Phone>& phones, Milliseconds length) {
  FittedSounds result;
  if (phones.empty()) return result;
  const double span = std::max(1.0, count_of(length));
  result.phones = phones_that_fit(phones, span);
  const double natural = natural_length(phones, result.phones);
  const bool holds = natural < kHeldBelow * span;
  result.tempo = holds ? 1 : natural / span;
  const std::size_t held = last_vowel(phones, result.phones);
  double begin = 0;
  for (std::size_t i = 0; i < result.phones; ++i) {
    const double own = natural_length(phones[i]) / result.tempo;
    const double extra = holds && i == held ? span - natural : 0;
    const auto at = Milliseconds(std::llround(begin + own / 2));
    result.keys.push_back({.viseme = phones[i].viseme,
                           .at = at,
                           .held = Milliseconds(std::llround(begin + own / 2 + extra)) - at,
                           .strength = phones[i].strength});
    begin += own + extra;
  }
  return result;
}

TimedCurve mouthing_over(const std::string& text, const std::vector<Phone>& phones, TimeSpan strokes) {
  const TimeSpan span{strokes.begin - kMouthingBefore, strokes.end + kMouthingAfter};
  TimedCurve result{.curve = {.name = text,
                              .onset = kMouthOnset,
                              .offset = kMouthOffset,
                              .weights = {},
                              .head = {},
                              .mouth = fit_sounds(phones, span.duration()).keys,
                              .gaze = std::nullopt,
                              .merge = Merge::replace},
                    .at = {span.begin - kMouthOnset, span.end + kMouthOffset}};
  for (MouthKey& key : result.curve.mouth) key.at += kMouthOnset;
  return result;
}

}  // namespace signweave
