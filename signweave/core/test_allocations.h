#pragma once

#include <cstddef>
#include <functional>

namespace signweave {

/// For tests: what was allocated.
struct Allocated {
  std::size_t times = 0;
  std::size_t bytes = 0;
};

/// What `call` allocates, in any thread. Counted by the operators new of test_allocations.cpp, which replace those of
/// the whole test program; a module's tests get them by TEST_SOURCES. One call at a time.
Allocated allocated_in(const std::function<void()>& call);

/// How often it allocates.
inline std::size_t allocations_in(const std::function<void()>& call) {
  return allocated_in(call).times;
}

}  // namespace signweave
