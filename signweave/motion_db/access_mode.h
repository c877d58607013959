#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace signweave {

/// How a stored motion is cut into packets (the paper, section 4.1).
struct AccessMode {
  /// Stored on disk: never renumber.
  enum class Kind : std::uint8_t {
    full = 0,                ///< one packet: the whole motion
    by_frame = 1,            ///< ceil(n / p) packets: all joints, p frames each
    by_joint = 2,            ///< m packets: one joint, all frames
    by_joint_and_frame = 3,  ///< m * ceil(n / p) packets: one joint, p frames
  };
  Kind kind = Kind::by_frame;
  std::uint32_t frames_per_packet = 0;  ///< the paper's p; 0: a default fitted to the skeleton; unused without by_frame

  friend bool operator==(AccessMode, AccessMode) = default;
};

/// "full", "by_frame:64", "by_frame", "by_joint", "by_joint_and_frame:64". None for any other text, and for p = 0.
std::optional<AccessMode> parse_access_mode(std::string_view text);
std::string to_string(AccessMode mode);

}  // namespace signweave
