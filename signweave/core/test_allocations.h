#pragma once

#include <cstddef>
#include <functional>

namespace signweave {

/// For tests: a count of allocations.
struct Allocated {
  std::size_t times = 0;
  std::size_t bytes = 0;
};

/// Returns what `call` allocates in any thread. Counted by the operators new of test_allocations.cpp, which replace
/// those of the whole test program; a module's tests link them through TEST_SOURCES. Not reentrant: one call at a time.
Allocated allocated_in(const std::function<void()>& call);

/// The number of allocations of `call`.
inline std::size_t allocations_in(const std::function<void()>& call) {
  return allocated_in(call).times;
}

}  // namespace signweave
