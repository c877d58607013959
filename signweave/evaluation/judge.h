#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/evaluation/bootstrap.h"
#include "signweave/evaluation/evaluate.h"

namespace signweave {

/// How near a method comes to the captures beside another method: the error of the moving hand's wrist over the other's
/// on the same spans. Groups of spans weigh alike in a collection, collections in all.
struct Judgement {
  std::string method;
  std::vector<Estimate> collections;  ///< [collection]
  Estimate all;

  /// Collections in which it is worse by more than its interval leaves open.
  std::vector<std::size_t> worse_in() const;
  /// It may be the default: worse in no collection, and better over all.
  bool wins() const;
};

/// `collection_of` is [recording]. Intervals come from resampled recordings within collections, and of a collection of
/// one recording from its resampled spans.
Judgement judge(const MethodScores& method, const MethodScores& other, std::span<const EvaluatedSpan> spans,
                std::span<const std::size_t> collection_of, std::size_t collections, Bootstrap& bootstrap);

/// What every method that signs is judged beside.
inline constexpr std::string_view kJudgedBeside = "kriging";

}  // namespace signweave
