#pragma once

#include <cstddef>
#include <cstdint>

/// Internal to this module.
namespace signweave {

/// Converts a frame number, which must not be negative, to an index.
constexpr std::size_t at(std::int64_t frame) noexcept {
  return static_cast<std::size_t>(frame);
}

}  // namespace signweave
