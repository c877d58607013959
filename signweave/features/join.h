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

/// What is compared where one sign ends and another begins: hands, fingers, arms and trunk at one frame, in
/// signer-centred space (the paper, section 4.2: position and direction at both ends).
struct JoinPoint {
  static constexpr std::size_t kPlace = 0;       ///< palms, left then right: shoulder widths
  static constexpr std::size_t kVelocity = 6;    ///< metres a second
  static constexpr std::size_t kDirection = 12;  ///< palm and finger direction of the left hand, then the right: unit
  static constexpr std::size_t kHandshape = 24;  ///< left, then right
  static constexpr std::size_t kArms = kHandshape + 2 * Handshape::kSize;  ///< elbows: shoulder widths
  static constexpr std::size_t kTrunk = kArms + 6;                         ///< lean, twist
  static constexpr std::size_t kSize = kTrunk + 4;

  /// What is known. Bits of a set; what is not known has the value 0.
  static constexpr std::uint8_t kHand = 1, kFingers = 2, kElbow = 4;  ///< of the left side; the right side's: << 3
  static constexpr std::uint8_t kTrunkKnown = 64;

  std::array<float, kSize> values{};
  std::uint8_t known = 0;  ///< 0: nothing was measured here
};

/// At the begin (the first frame) or the end (the last one) of a phase.
JoinPoint join_point(const PhaseFeatures& phase, bool at_begin) noexcept;

/// What a join is judged by. Stored on disk: never renumber.
enum class JoinTerm : std::uint8_t {
  place = 0,      ///< of the hands: squared distance, shoulder widths², both hands together
  velocity = 1,   ///< of the hands: squared difference, (m/s)²
  handshape = 2,  ///< squared distance (hand_motion.h), both hands together
  direction = 3,  ///< of palms and fingers: squared distance of the unit vectors, all four together
  arms = 4,       ///< of the elbows: squared distance, shoulder widths²
  trunk = 5,      ///< lean and twist: squared distance
  /// The way to go in the time there is: by how much the square of each hand's speed, straight, exceeds that of the
  /// fastest tenth of the corpus's transitions, in parts of the latter.
  speed = 6,
};
inline constexpr std::size_t kJoinTerms = 7;
std::string_view name_of(JoinTerm term) noexcept;

using JoinTerms = std::array<float, kJoinTerms>;

/// The terms of a join from `a`, the last stroke frame of one sign, to `b`, the first of the next, of a transition that
/// lasts so long (at least kShortestJoin counts). `limit` is JoinWeights::speed_limit. What is not known on both sides
/// is 0.
JoinTerms join_terms(const JoinPoint& a, const JoinPoint& b, Seconds transition, float limit) noexcept;
inline constexpr Seconds kShortestJoin{0.1};

/// What each term weighs, and how it is known. A join to a sign that somebody chose blindly costs 1 on average.
struct JoinWeights {
  JoinTerms weights{0.15f, 0.3f, 0.5f, 0.03f, 0.3f, 4.0f, 0.15f};  ///< by default about as much from each (ours)
  float speed_limit = 4;    ///< shoulder widths a second: what one in ten hands exceeds between recorded neighbours
  std::uint32_t pairs = 0;  ///< of recorded neighbours that it was learned on; 0: these are the defaults
  std::uint32_t comparisons = 0;  ///< with other tokens
  std::uint32_t folds = 0;        ///< of cross-validation by recording; 0: too few recordings, and the rate below is of
                                  ///< the very pairs that were learned on
  float wins = 0;          ///< in how many of the comparisons the recorded neighbour's join costs less, in [0, 1]
  float default_wins = 0;  ///< the same by the defaults
  friend bool operator==(const JoinWeights&, const JoinWeights&) = default;
};

/// The weighted sum.
float cost_of(const JoinTerms& terms, const JoinTerms& weights) noexcept;

/// One recorded join and another that might have been made instead.
struct JoinComparison {
  JoinTerms recorded{};
  JoinTerms other{};
  std::uint32_t recording = 0;  ///< of the recorded one
  std::uint32_t pair = 0;       ///< comparisons of one pair of neighbours, which count as much as one, stand together
};

/// Learns non-negative weights by which recorded joins cost less than others: logistic regression on the differences
/// (Bradley and Terry 1952), each term in parts of its mean over the others, drawn towards equal weights as if by
/// kPriorPairs pairs, or 1/4 to 256 times as many where that does better on recordings left out. Deterministic. `speed`
/// weighs its default at least. The defaults where there is no comparison.
JoinWeights learn_join_weights(std::span<const JoinComparison> comparisons, float speed_limit);
inline constexpr double kPriorPairs = 8;

/// True where two say the same, give or take what another compiler rounds otherwise.
bool nearly_same(const JoinWeights& a, const JoinWeights& b) noexcept;

/// As it is stored: f32 × 7 weights in the order of JoinTerm, f32 speed limit, u32 pairs, comparisons, folds, f32 wins,
/// default wins. `decode_join_weights` throws Error{corrupt} on numbers that `encode` cannot have written.
void encode(const JoinWeights& weights, ByteWriter& out);
JoinWeights decode_join_weights(ByteReader& in);

}  // namespace signweave
