#pragma once

#include <string_view>

#include "signweave/core/syntax_error.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// Parses a query; the grammar is in docs/query.md. Throws SyntaxError. Accepts at most 64 KiB of UTF-8, 200 levels of
/// nesting and 64 places of a sequence, so that no text can exhaust the stack or memory.
PhaseQuery parse(std::string_view text);

}  // namespace signweave
