#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "signweave/notation/utterance_options.h"

/// The ends of what lasts until another place. Only for the sources of utterances in this folder.
namespace signweave::utterances {

inline constexpr std::size_t kNoPlace = static_cast<std::size_t>(-1);

/// Something in an utterance whose last place is known when all places are.
struct OpenEnd {
  enum class Of : std::uint8_t { part, hold, non_manual };
  Of of = Of::part;
  Extent extent;
  std::size_t after = 0;  ///< the place behind which the end is looked for
  std::size_t place = 0;  ///< of a part: its first place
  std::size_t index = 0;  ///< in Place::parts, Utterance::holds or Utterance::non_manuals
};

/// Sets the ends. What has none is left out, and reported if the text has no other faults. Also leaves out non-manuals
/// that end at kNoPlace.
void finish_ends(Utterance& utterance, std::span<const OpenEnd> ends, Cursor& cursor);

}  // namespace signweave::utterances
