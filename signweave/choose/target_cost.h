#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/database/database.h"

namespace signweave {

/// What speaks against a candidate by itself, and where it would stand.
enum class TargetTerm : std::uint8_t {
  left = 0,         ///< 1 where another gloss stood before it in its recording than is to stand before it now
  right = 1,        ///< the same of the gloss after it
  phases = 2,       ///< 1 without annotated phases: its stroke holds its own transitions
  preparation = 3,  ///< 1 without preparation, where a transition to it must be made
  retraction = 4,   ///< 1 without retraction, where a transition from it must be made
  outlier = 5,      ///< how far beyond kOutlier deviations it lies from the gloss's other tokens, 4 at most
  defects = 6,      ///< of its frames: the sum of cost_of(DefectKind), each kind once
};
inline constexpr std::size_t kTargetTerms = 7;
std::string_view name_of(TargetTerm term) noexcept;

using TargetTerms = std::array<float, kTargetTerms>;

/// In the unit of the joins, where one that somebody chose blindly costs 1. (ours)
inline constexpr TargetTerms kTargetWeights = {0.1f, 0.1f, 0.4f, 0.2f, 0.2f, 0.2f, 1.0f};

/// Robust deviations (1.4826 times the median absolute one) that are still usual.
inline constexpr float kOutlier = 3;
/// So many known tokens tell what is usual.
inline constexpr std::size_t kFewestTokens = 5;

/// 4 for numbers that are none down to 0 for what was mended when it was stored. (ours)
float cost_of(DefectKind kind) noexcept;

/// Of the defects that overlap some frames of a recording.
float defect_cost(std::span<const Defect> defects, FrameRange frames) noexcept;

/// How far each of the tokens of one gloss lies beyond kOutlier robust deviations from their median, in the term in
/// which it lies farthest: logarithm of the strokes' duration, of the hands' path, distance of hands' places at the
/// strokes' begin and end from the middle of all. 0 for all where fewer than kFewestTokens are known. Null: not known.
std::vector<float> outliers_of(std::span<const SignJoin* const> tokens);

}  // namespace signweave
