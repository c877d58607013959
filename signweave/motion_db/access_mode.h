#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace signweave {

/// How a stored motion is divided into packets (the paper, section 4.1).
struct AccessMode {
  /// Stored on disk: never renumber.
  enum class Kind : std::uint8_t {
    full = 0,                ///< one packet with the whole motion
    by_frame = 1,            ///< ceil(n / p) packets with all joints and p frames each
    by_joint = 2,            ///< m packets with one joint and all frames each
    by_joint_and_frame = 3,  ///< m * ceil(n / p) packets with one joint and p frames each
  };
  Kind kind = Kind::by_frame;
  std::uint32_t frames_per_packet = 0;  ///< the paper's p; 0: a default for the skeleton; unused unless by frame

  friend bool operator==(AccessMode, AccessMode) = default;
};

/// Parses "full", "by_frame:64", "by_frame", "by_joint", "by_joint_and_frame:64". Empty for other text and p = 0.
std::optional<AccessMode> parse_access_mode(std::string_view text);
std::string to_string(AccessMode mode);

}  // namespace signweave
