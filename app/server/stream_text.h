#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/calls/fault_json.h"
#include "app/server/control_message.h"
#include "signweave/live/player.h"

namespace signweave::server {

// What a stream's server says in JSON, one line each; docs/stream.md shows every one.

/// What a header tells beside the player's own.
struct HeaderContext {
  std::string_view database;
  std::string_view character = {};  ///< whose joints they are; empty: the recording's
  std::optional<Pace> pace{};       ///< none: of frames that are there already
  std::size_t batch = 1;
};
/// {"type": "header", …}: what the frames are of.
std::string header_text(const StreamHeader& header, const HeaderContext& context);
/// {"type": "ok", …}; `frame` is the next frame's number.
std::string ok_text(std::string_view id, std::uint64_t frame);
/// {"type": "score", …}; without one, its score is null. `frame` is the next frame's number.
std::string score_text(std::string_view id, const std::optional<ShownScore>& live, std::uint64_t frame);
std::string error_text(ErrorCode code, std::string_view message, std::string_view id);
/// The same; of glosses that are not there it lists those that were probably meant.
std::string error_text(const Error& error, std::string_view id);
/// {"type": "place" | "rest" | "end" | "seek" | "notice", …}
std::string event_text(const PlayerEvent& event);

}  // namespace signweave::server
