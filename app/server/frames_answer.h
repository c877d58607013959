#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave::server {

/// What stands before the frames of an answer, beside what the motion itself tells.
struct FramesHead {
  std::string_view database;
  std::string recording;  ///< whose signer it is
  std::vector<std::pair<std::string, std::string>> declarations;
  std::string character;  ///< whose joints the motion has; empty: the recording's
  double origin_ms = 0;   ///< annotation time of frame 0
  nlohmann::ordered_json rig;
  nlohmann::json report = nullptr;  ///< of what was made
};

/// The format `frames`: four bytes with the length of a JSON text, that text, and then binary messages as a stream has
/// them (docs/stream.md), one after the other.
std::string frames_text(const Motion& motion, const FramesHead& head);

}  // namespace signweave::server
