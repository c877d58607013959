#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/live/player.h"

namespace signweave::server {

/// When frames go out.
enum class Pace {
  live,  ///< each at its time
  fast,  ///< as soon as the client takes them; none while the signer rests
};

/// What an "open" asks for.
struct StreamOptions {
  PlayerOptions player;
  std::size_t batch = 1;  ///< frames of a message at most, 1 to 600
  Pace pace = Pace::live;
  std::string character;  ///< whose joints the frames have; empty: the recording's
};

enum class Control { open, sign, append, pause, resume, seek, tempo, loop, stop, score, ping };

/// A message from a stream's client: one JSON object, `{"type": "sign", "utterance": "DEMAIN MATIN", "id": 7}`.
struct ControlMessage {
  Control control = Control::ping;
  std::string id;  ///< as JSON, to be echoed; empty: none was given
  StreamOptions open;
  Utterance utterance;
  bool folds = false;  ///< glosses that differ in spelling only are taken for those that are there
  Milliseconds at{0};
  double tempo = 1;
  bool loop = false;
};

/// What is wrong with a control message.
struct ControlError : Error {
  ControlError(ErrorCode code, const std::string& text, std::string of) : Error(code, text), id(std::move(of)) {}
  std::string id;  ///< as JSON; empty: none could be read
};

/// Reads one message. Throws ControlError, whose text names the field; an unknown type or field brings near matches.
ControlMessage parse_control(std::string_view text);

}  // namespace signweave::server
