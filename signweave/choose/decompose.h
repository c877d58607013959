#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/choose/edit.h"
#include "signweave/choose/part_choice.h"
#include "signweave/choose/select.h"
#include "signweave/database/database.h"

namespace signweave {

/// A recording as choices: a place for each sign of its main tier, and if the tiers describe the hands apart, a part of
/// the other hand with its own signs. Every transition is that of the recording, so composing them gives the recording.
struct Decomposed {
  std::vector<Choice> choices;    ///< one candidate each; signs whose strokes overlap share a place
  std::vector<PartChoice> parts;  ///< at most one, over all places
};
/// Throws Error{not_found} for a recording without motion or without a stroke.
Decomposed decompose(const Contents& contents, std::string_view recording);

/// Replaces signs of single hands in a decomposed recording: those of the hand's own tier if it has one, otherwise the
/// hand's share of the signs that describe both. Throws as `choices_for`, and Error{bad_input} for a hand's sign that
/// is replaced twice.
void replace_in_hands(const Contents& contents, std::string_view recording,
                      std::span<const HandReplacement> replacements, Decomposed& decomposed);

}  // namespace signweave
