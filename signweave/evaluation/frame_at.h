#pragma once

#include <cstddef>
#include <cstdint>

/// Inside this module only.
namespace signweave {

/// A frame as an index into lists of all frames; it must not be negative.
constexpr std::size_t at(std::int64_t frame) noexcept {
  return static_cast<std::size_t>(frame);
}

}  // namespace signweave
