#pragma once

#include <cstddef>

namespace signweave {

/// Asks the processor to load these bytes into its cache ahead of their use. The address need not be valid: nothing is
/// read.
inline void prefetch(const void* from, std::size_t bytes) noexcept {
  constexpr std::size_t kLine = 64;
  const char* const begin = static_cast<const char*>(from);
  for (std::size_t at = 0; at < bytes; at += kLine) __builtin_prefetch(begin + at);
}

}  // namespace signweave
