#pragma once

#include <string>

#include "signweave/query/phase_query.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// The plan of a query as text, one step per line: for `query --explain`.
std::string explain(const PhaseQuery& query, const Segments& segments);

}  // namespace signweave
