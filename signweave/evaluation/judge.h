#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/evaluation/bootstrap.h"
#include "signweave/evaluation/evaluate.h"

namespace signweave {

/// The error of a method relative to another method: the error of the moving hand's wrist divided by the other's on the
/// same spans. Groups of spans have equal weight in a collection, collections in the total.
struct Judgement {
  std::string method;
  std::vector<Estimate> collections;  ///< [collection]
  Estimate all;

  /// Collections in which it is significantly worse: the whole interval is above 1.
  std::vector<std::size_t> worse_in() const;
  /// True if it may be the default: worse in no collection, and better overall.
  bool wins() const;
};

/// `collection_of` is [recording]. Intervals come from resampled recordings within collections, and for a collection of
/// one recording from its resampled spans.
Judgement judge(const MethodScores& method, const MethodScores& other, std::span<const EvaluatedSpan> spans,
                std::span<const std::size_t> collection_of, std::size_t collections, Bootstrap& bootstrap);

/// The method against which all others are judged.
inline constexpr std::string_view kReferenceMethod = "kriging";

}  // namespace signweave
