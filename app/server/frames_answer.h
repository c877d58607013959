#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "signweave/annotation/declarations.h"
#include "signweave/motion/motion.h"

namespace signweave::server {

/// What precedes the frames of an answer, in addition to what the motion itself contains.
struct FramesHead {
  std::string_view database;
  std::string recording;  ///< the recording whose signer it is
  Declarations declarations;
  std::string character;  ///< the character whose joints the motion has; empty: the recording's
  double origin_ms = 0;   ///< annotation time of frame 0
  nlohmann::ordered_json rig;
  nlohmann::json report = nullptr;  ///< about the result
};

/// The format `frames`: the length of a JSON text in four bytes, that text, and then binary messages as in a stream
/// (docs/stream.md), one after another.
std::string frames_text(const Motion& motion, const FramesHead& head);

}  // namespace signweave::server
