#pragma once

#include <span>
#include <string>

#include "signweave/core/text_reader.h"
#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// Assigns collections and signers to recordings from a table, for recordings whose folders and annotations do not give
/// them: CSV with the columns recording, collection and, optionally, signer; a first row "recording,…" is a heading. A
/// recording is given by its name or the end of it. Empty fields, and recordings without a row, change nothing;
/// collections of the same name are the same. Rows of recordings in `left_out`, which are not evaluated, are skipped.
/// Throws Error{bad_input, "FILE:LINE: …"}; then some recordings may have been changed.
void read_collections(TextReader& table, std::span<EvaluatedMotion> recordings,
                      std::span<const std::string> left_out = {});

}  // namespace signweave
