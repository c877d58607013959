#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/live/player.h"

namespace signweave::server {

/// When frames are sent.
enum class Pace {
  live,  ///< each frame at its time
  fast,  ///< as soon as the client accepts them; none while the signer rests
};

/// The options of an "open" message.
struct StreamOptions {
  PlayerOptions player;
  std::size_t batch = 1;  ///< most frames per message, 1 to 600
  Pace pace = Pace::live;
  std::string character;  ///< the character whose joints the frames have; empty: the recording's
};

enum class Control { open, sign, append, pause, resume, seek, tempo, loop, stop, score, ping };

/// A message from a stream's client: one JSON object, `{"type": "sign", "utterance": "DEMAIN MATIN", "id": 7}`.
struct ControlMessage {
  Control control = Control::ping;
  std::string id;  ///< as JSON, to be echoed; empty if not given
  StreamOptions open;
  std::string utterance_text;
  Utterance utterance;  ///< of `utterance_text`
  bool folds = false;   ///< accepts glosses that differ from known ones only in spelling
  Milliseconds at{0};
  double tempo = 1;
  bool loop = false;
};

/// An error in a control message.
struct ControlError : Error {
  ControlError(ErrorCode code, const std::string& text, std::string of) : Error(code, text), id(std::move(of)) {}
  std::string id;  ///< as JSON; empty if none could be read
};

/// Reads one message, its utterance with the words of a database. Throws ControlError, whose text names the field; for
/// an unknown type or field it suggests near matches.
ControlMessage parse_control(std::string_view text, const UtteranceWords& words = {});

}  // namespace signweave::server
