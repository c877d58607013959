#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace signweave {

/// A moment must not be earlier than another one plus some frames. Two of them tie two moments.
struct TimeConstraint {
  std::size_t from = 0;       ///< number of a moment
  std::size_t to = 0;         ///< number of a moment
  std::int64_t at_least = 0;  ///< output frames from `from` to `to`; may be negative
};

/// The earliest moments that satisfy some constraints.
struct Schedule {
  std::vector<std::int64_t> moments;       ///< [moment] output frames
  std::vector<std::size_t> contradiction;  ///< indices of constraints that form a cycle that cannot be satisfied
};

/// Finds the earliest moments, none of which is before `earliest`; so later moments never shift earlier ones, unless a
/// constraint ties them. Bellman–Ford over the difference constraints, in O(moments × constraints); linear if the
/// constraints are in the order of time. If they contradict each other, `contradiction` has a cycle of them, and the
/// moments are meaningless.
Schedule schedule(std::span<const std::int64_t> earliest, std::span<const TimeConstraint> constraints);

}  // namespace signweave
