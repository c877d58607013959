#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/database/database.h"

namespace signweave {

/// Costs of a candidate itself and of its context.
enum class TargetTerm : std::uint8_t {
  left = 0,         ///< 1 if the gloss before it in its recording differs from the requested one
  right = 1,        ///< the same for the gloss after it
  phases = 2,       ///< 1 without annotated phases: its stroke contains its transitions
  preparation = 3,  ///< 1 without preparation, if a transition to it must be generated
  retraction = 4,   ///< 1 without retraction, if a transition from it must be generated
  outlier = 5,      ///< distance beyond kOutlier deviations from the gloss's other tokens, at most 4
  defects = 6,      ///< defects of its frames: the sum of cost_of(DefectKind), each kind once
};
inline constexpr std::size_t kTargetTerms = 7;
std::string_view name_of(TargetTerm term) noexcept;

using TargetTerms = std::array<float, kTargetTerms>;

/// In the unit of join costs, in which a join to a randomly chosen token costs 1 on average. (ours)
inline constexpr TargetTerms kTargetWeights = {0.1f, 0.1f, 0.4f, 0.2f, 0.2f, 0.2f, 1.0f};

/// Robust deviations (1.4826 times the median absolute deviation) that are still normal.
inline constexpr float kOutlier = 3;
/// Minimum number of known tokens needed to detect outliers.
inline constexpr std::size_t kFewestTokens = 5;

/// From 4 for non-finite values down to 0 for defects that were repaired on import. (ours)
float cost_of(DefectKind kind) noexcept;

/// Total cost of the defects that overlap `frames` of a recording.
float defect_cost(std::span<const Defect> defects, FrameRange frames) noexcept;

/// How far each token of one gloss lies beyond kOutlier robust deviations from their median, in its most deviating
/// term: logarithm of the strokes' duration, logarithm of the hands' path, distance of the hands' positions at the
/// strokes' begin and end from the centre of all. 0 for all if fewer than kFewestTokens are known. A null token is
/// unknown.
std::vector<float> outliers_of(std::span<const SignJoin* const> tokens);

}  // namespace signweave
