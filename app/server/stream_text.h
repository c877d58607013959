#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/server/control_message.h"
#include "app/wire/fault.h"
#include "signweave/live/player.h"

namespace signweave::server {

// JSON messages of a stream's server, one line each; docs/stream.md shows all of them.

/// What a header contains in addition to the player's own.
struct HeaderContext {
  std::string_view database;
  std::string_view character = {};  ///< the character whose joints they are; empty: the recording's
  std::optional<Pace> pace{};       ///< nullopt: for frames that exist already
  std::size_t batch = 1;
};
/// {"type": "header", …}: describes the frames.
std::string header_text(const StreamHeader& header, const HeaderContext& context);
/// {"type": "ok", …}; `frame` is the next frame's number.
std::string ok_text(std::string_view id, std::uint64_t frame);
/// {"type": "score", …}; its score is null if there is none. `frame` is the next frame's number.
std::string score_text(std::string_view id, const std::optional<ShownScore>& live, std::uint64_t frame);
std::string error_text(ErrorCode code, std::string_view message, std::string_view id);
/// The same; for unknown glosses it lists the ones that were probably meant.
std::string error_text(const Error& error, std::string_view id);
/// {"type": "place" | "rest" | "end" | "seek" | "notice", …}
std::string event_text(const PlayerEvent& event);

}  // namespace signweave::server
