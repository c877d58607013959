#pragma once

#include <cstddef>

namespace signweave {

/// Has the processor bring these bytes near, so that who reads or writes them soon does not wait for memory. They need
/// not be there: nothing is read.
inline void prefetch(const void* from, std::size_t bytes) noexcept {
  constexpr std::size_t kLine = 64;
  const char* const begin = static_cast<const char*>(from);
  for (std::size_t at = 0; at < bytes; at += kLine) __builtin_prefetch(begin + at);
}

}  // namespace signweave
