#pragma once

#include <string>
#include <vector>

#include "signweave/nonmanual/curve.h"
#include "signweave/nonmanual/mouthing/phone.h"

/// Mouthings: the sounds of a word fitted to a sign.
namespace signweave {

// A mouthing begins a little before the stroke of its sign and ends a little after it. (ours)
inline constexpr Milliseconds kMouthingBefore{60};
inline constexpr Milliseconds kMouthingAfter{40};
/// The mean time of a sound at the usual speed of espeak-ng, measured in "bonjour".
inline constexpr double kSoundLength = 65;  ///< milliseconds, for an open vowel
/// A mouthing is compressed to this share of its natural length before syllables are left out. (ours)
inline constexpr double kMostCompressed = 0.6;
/// A mouthing shorter than this share of its span holds its last vowel instead of being slow throughout. (ours)
inline constexpr double kHeldBelow = 0.7;

/// Sounds in time.
struct FittedSounds {
  std::vector<MouthKey> keys;  ///< from the begin of the span
  std::size_t phones = 0;      ///< the number shown: the first ones
  double tempo = 1;            ///< natural length / length shown, without the held vowel; above 1: faster
};

/// Fits sounds to a span of some length. Longer sounds are compressed to at most kMostCompressed, then the last
/// syllables are left out (the first is always shown); sounds that are a little shorter are slowed down, and of much
/// shorter ones the last vowel is held.
FittedSounds fit_sounds(const std::vector<Phone>& phones, Milliseconds length);

/// The mouthing of a text over the strokes of its signs; the mouth opens from the captured face before the first
/// sound and returns to it after the last one. Without phones its curve has no sounds.
TimedCurve mouthing_over(const std::string& text, const std::vector<Phone>& phones, TimeSpan strokes);

}  // namespace signweave
