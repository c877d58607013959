#pragma once

#include "signweave/notation/utterance.h"

namespace signweave {

/// Throws Error{unsupported} for an utterance that asks for changes in space: they can be read but not signed yet.
void refuse_space(const Utterance& utterance);

}  // namespace signweave
