#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/server/control_message.h"
#include "app/server/error_name.h"
#include "signweave/stream/player.h"

namespace signweave::server {

// What a stream's server says in JSON, one line each; docs/stream.md shows every one.

/// {"type": "header", …}: what the frames are of.
std::string header_text(const StreamHeader& header, std::string_view database, Pace pace, std::size_t batch);
/// {"type": "ok", …}; `frame` is the next frame's number.
std::string ok_text(std::string_view id, std::uint64_t frame);
std::string error_text(ErrorCode code, std::string_view message, std::string_view id);
/// {"type": "place" | "rest" | "end" | "seek" | "notice", …}
std::string event_text(const PlayerEvent& event);

}  // namespace signweave::server
