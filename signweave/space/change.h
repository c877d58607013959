#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "signweave/space/locus.h"

namespace signweave {

/// How a sign is changed in space: where it is aimed, and how its strokes are moved, turned, scaled, timed and
/// repeated. The default changes nothing.
struct SpaceChange {
  // Where the sign goes. At most one of `at`, `along` and from/to is given.
  std::optional<LocusRef> from;  ///< of a verb: its subject or source
  std::optional<LocusRef> to;    ///< of a verb: its object or goal
  std::optional<LocusRef> at;    ///< a pointing sign points at it, another sign is made there
  std::vector<LocusRef> along;   ///< the hand goes along these with its captured handshape; empty, or at least two
  std::optional<LocusRef> past;  ///< the hand goes past it as captured
  bool keeps_turn = false;       ///< `along`, `past`: the hand keeps its orientation, instead of turning with its path

  // Changes of the stroke as captured, about the palm at the stroke's first frame, in the axes left, up, forward.
  std::array<float, 3> move{};          ///< centimetres
  std::array<float, 3> turn{};          ///< degrees about the axes left, up, forward; forward first, then left, up
  std::array<float, 3> scale{1, 1, 1};  ///< along the axes, applied before `turn`
  float size = 1;                       ///< of the whole movement, about the middle of its path
  float speed = 1;                      ///< of the strokes
  std::size_t repetitions = 1;          ///< times that the stroke is signed
  bool outward = false;                 ///< repetitions shrink and are shifted outward: a plural
  bool mirrored = false;                ///< left and right are exchanged

  friend bool operator==(const SpaceChange&, const SpaceChange&) = default;
};

bool changes_nothing(const SpaceChange& change) noexcept;

// Limits, and the values of names in the notation. (ours)
inline constexpr float kMostMove = 200;  ///< centimetres
inline constexpr float kLeastScale = 0.1f;
inline constexpr float kMostScale = 5;
inline constexpr float kSlowestSign = 0.25f;
inline constexpr float kFastestSign = 4;
inline constexpr std::size_t kMostRepetitions = 10;
inline constexpr std::size_t kMostAlong = 32;
inline constexpr float kBig = 1.3f, kSmall = 0.75f;   ///< `size`
inline constexpr float kSlow = 0.75f, kFast = 1.33f;  ///< `speed`
/// Repetitions of a plural; their sizes are 1, 0.8, 0.7 and so on (repetitions shrink: Liddell & Johnson 1989).
inline constexpr std::size_t kPluralRepetitions = 3;

/// Throws Error{bad_input} for values outside their limits, and for changes that exclude each other.
void check(const SpaceChange& change);

}  // namespace signweave
