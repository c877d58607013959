#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/features/phase_features.h"

namespace signweave {

/// The values compared at the join of two signs: hands, fingers, arms and trunk at one frame, in signer-centred space
/// (the paper, section 4.2: position and direction at both ends).
struct JoinPoint {
  static constexpr std::size_t kPlace = 0;       ///< palms, left then right: shoulder widths
  static constexpr std::size_t kVelocity = 6;    ///< metres a second
  static constexpr std::size_t kDirection = 12;  ///< palm and finger direction of the left hand, then the right: unit
  static constexpr std::size_t kHandshape = 24;  ///< left, then right
  static constexpr std::size_t kArms = kHandshape + 2 * Handshape::kSize;  ///< elbows: shoulder widths
  static constexpr std::size_t kTrunk = kArms + 6;                         ///< lean, twist
  static constexpr std::size_t kSize = kTrunk + 4;

  /// The known values, as a bit set. Unknown values are 0.
  static constexpr std::uint8_t kHand = 1, kFingers = 2,
                                kElbow = 4;  ///< for the left side; the right side's bits: << 3
  static constexpr std::uint8_t kTrunkKnown = 64;

  std::array<float, kSize> values{};
  std::uint8_t known = 0;  ///< 0: nothing was measured here
};

/// Returns the join point at the begin (the first frame) or the end (the last frame) of a phase.
JoinPoint join_point(const PhaseFeatures& phase, bool at_begin) noexcept;

/// The criteria by which a join is rated. Stored on disk: never renumber.
enum class JoinTerm : std::uint8_t {
  place = 0,      ///< of the hands: squared distance, shoulder widths², both hands together
  velocity = 1,   ///< of the hands: squared difference, (m/s)²
  handshape = 2,  ///< squared distance (hand_motion.h), both hands together
  direction = 3,  ///< of palms and fingers: squared distance of the unit vectors, all four together
  arms = 4,       ///< of the elbows: squared distance, shoulder widths²
  trunk = 5,      ///< lean and twist: squared distance
  /// Speed required by the distance and the duration: by how much the square of each hand's straight-line speed exceeds
  /// the square of `speed_limit`, as a fraction of the latter.
  speed = 6,
};
inline constexpr std::size_t kJoinTerms = 7;
std::string_view name_of(JoinTerm term) noexcept;

using JoinTerms = std::array<float, kJoinTerms>;

/// Returns the terms of a join from `a`, the last stroke frame of one sign, to `b`, the first of the next, for a
/// transition of the given duration (at least kShortestJoin). `limit` is JoinWeights::speed_limit. Terms that are not
/// known on both sides are 0.
JoinTerms join_terms(const JoinPoint& a, const JoinPoint& b, Seconds transition, float limit) noexcept;
inline constexpr Seconds kShortestJoin{0.1};

/// The weight of each term and how it was obtained. A join to a randomly chosen token costs 1 on average.
struct JoinWeights {
  JoinTerms weights{0.15f, 0.3f, 0.5f, 0.03f,
                    0.3f,  4.0f, 0.15f};  ///< defaults: each term contributes about equally (ours)
  float speed_limit = 4;    ///< shoulder widths a second: exceeded by one in ten hands between recorded neighbours
  std::uint32_t pairs = 0;  ///< number of recorded neighbours it was learned from; 0: these are the defaults
  std::uint32_t comparisons = 0;  ///< number of comparisons with other tokens
  std::uint32_t folds = 0;        ///< folds of the cross-validation by recording; 0: too few recordings, and `wins` is
                                  ///< measured on the training pairs
  float wins = 0;                 ///< fraction of the comparisons in which the recorded join costs less, in [0, 1]
  float default_wins = 0;         ///< the same for the default weights
  friend bool operator==(const JoinWeights&, const JoinWeights&) = default;
};

/// Returns the weighted sum of the terms.
float cost_of(const JoinTerms& terms, const JoinTerms& weights) noexcept;

/// One recorded join and an alternative to it.
struct JoinComparison {
  JoinTerms recorded{};
  JoinTerms other{};
  std::uint32_t recording = 0;  ///< recording of the recorded join
  std::uint32_t pair =
      0;  ///< pair of neighbours; comparisons of one pair are adjacent and together weigh as much as one
};

/// Learns non-negative weights under which recorded joins cost less than others: logistic regression on the differences
/// (Bradley and Terry 1952). Each term is scaled by its mean over the alternatives, and regularised towards equal
/// weights with the strength of kPriorPairs pairs, or 1/4 to 256 times that if it does better on recordings left out.
/// Deterministic. `speed` weighs at least its default. Returns the defaults if there are no comparisons.
JoinWeights learn_join_weights(std::span<const JoinComparison> comparisons, float speed_limit);
inline constexpr double kPriorPairs = 8;

/// Returns whether two sets of weights are equal up to rounding differences between compilers.
bool nearly_same(const JoinWeights& a, const JoinWeights& b) noexcept;

/// The stored form: f32 × 7 weights in the order of JoinTerm, f32 speed limit, u32 pairs, comparisons, folds, f32 wins,
/// default wins. `decode_join_weights` throws Error{corrupt} on values that `encode` cannot have written.
void encode(const JoinWeights& weights, ByteWriter& out);
JoinWeights decode_join_weights(ByteReader& in);

}  // namespace signweave
