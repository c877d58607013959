#pragma once

#include <span>
#include <string>

#include "signweave/core/text_reader.h"
#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// Says of recordings which collection they belong to and who signs, where neither folders nor annotations do: CSV with
/// the columns recording, collection, and perhaps the signer; a first row "recording,…" is a heading. A recording goes
/// by its name or the end of it. What is empty, and recordings without a row, stay as they are; a collection that is
/// called as another is the same. Rows of `left_out`, which are not evaluated on, are passed over. Throws
/// Error{bad_input, "FILE:LINE: …"}, and then some may have been changed.
void read_collections(TextReader& table, std::span<EvaluatedMotion> recordings,
                      std::span<const std::string> left_out = {});

}  // namespace signweave
