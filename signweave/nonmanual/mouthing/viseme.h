#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "signweave/core/time.h"

namespace signweave {

/// The shape of the mouth in a sound: the fifteen visemes of Oculus' set, and two for the front rounded vowels of
/// French, German and Dutch, which that set does not have.
enum class Viseme : std::uint8_t {
  silence,
  pp,  ///< p b m
  ff,  ///< f v
  th,  ///< θ ð
  dd,  ///< t d
  kk,  ///< k ɡ x ʁ
  ch,  ///< ʃ ʒ tʃ dʒ
  ss,  ///< s z
  nn,  ///< n l ɲ ŋ
  rr,  ///< ɹ r ɾ
  aa,  ///< a ɑ æ ʌ
  e,   ///< e ɛ ə
  i,   ///< i ɪ j
  o,   ///< o ɔ
  u,   ///< u ʊ w
  y,   ///< y ʏ ɥ
  oe,  ///< ø œ
};
inline constexpr std::size_t kVisemeCount = 17;
/// "PP", "aa", "U", "OE", …; "sil" for silence.
std::string_view name_of(Viseme viseme) noexcept;
std::optional<Viseme> viseme_named(std::string_view name) noexcept;
bool is_vowel(Viseme viseme) noexcept;

/// The weights that visemes set; each stands for one ARKit track, or for the same one on both sides.
enum class MouthWeight : std::uint8_t {
  jaw_open,
  press,
  roll_upper,
  roll_lower,
  upper_up,
  lower_down,
  tongue_out,
  spread,
  funnel,
  pucker,
  smile,
};
inline constexpr std::size_t kMouthWeightCount = 11;
using MouthWeights = std::array<float, kMouthWeightCount>;  ///< [MouthWeight], each in [0, 1]

/// The weight that a track shows: "mouthPressLeft" → press; nullopt for one that visemes do not set.
std::optional<MouthWeight> mouth_weight_of(std::string_view track) noexcept;
/// The tracks that visemes set.
std::span<const std::string_view> viseme_tracks() noexcept;

/// The face at the middle of a sound. (ours)
const MouthWeights& shape_of(Viseme viseme) noexcept;
/// The duration of a sound relative to an open vowel. The values of TalkingHead 1.7 for French; those of TH, CH, Y and
/// OE are ours.
double relative_length(Viseme viseme) noexcept;

/// The distance between the lips; 1 for a relaxed mouth, whose lips are taken to be 1 mm apart. 0 when they touch.
/// (ours)
float lip_gap(const MouthWeights& weights) noexcept;

/// One sound of a mouthing, as the mouth shows it.
struct MouthKey {
  Viseme viseme = Viseme::silence;
  Milliseconds at{0};    ///< from the begin of the curve
  Milliseconds held{0};  ///< how long the shape is held from there
  float strength = 1;    ///< how far the shape is made, from 0 to 1
  friend bool operator==(const MouthKey&, const MouthKey&) = default;
};

/// The share of each viseme in the mouth at one moment; their sum is at most 1.
using VisemeShares = std::array<float, kVisemeCount>;
/// Coarticulation by dominance functions (Cohen and Massaro 1993): each sound pulls the mouth towards its shape, less
/// with growing distance in time. Far from every sound the mouth is neutral. `keys` are in order of time, `at` is in
/// milliseconds from the begin of the curve.
VisemeShares viseme_shares(std::span<const MouthKey> keys, double at) noexcept;

/// How far the lips are forced together at a frame of the curve, counted from 0: 1 at the frame nearest to each of
/// p, b and m, whatever the speed, and 0 at the sounds next to it if those are at other frames.
float closure_at(std::span<const MouthKey> keys, std::int64_t frame, FrameRate rate) noexcept;
/// The value of a weight that the lips' closure, from 0 to 1, leaves of `value`.
float closed(MouthWeight weight, float value, float closure) noexcept;

}  // namespace signweave
