#pragma once

#include <cstddef>
#include <functional>

namespace signweave {

/// For tests: how often `call` allocates, in any thread. Counted by the operators new of the test program, which
/// allocation_test.cpp replaces.
std::size_t allocations_in(const std::function<void()>& call);

}  // namespace signweave
