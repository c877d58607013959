#pragma once

#include <string>
#include <vector>

#include "signweave/calls/evaluation_report.h"

namespace signweave::calls {

/// Tables of the moving hand's wrist error by collection: every method against kriging, in each collection and overall,
/// and whether it may be the default; medians alongside means; long gaps by their number of speed peaks; and the ratio
/// of the default to slerp. Empty if kriging was not evaluated or there is no span.
std::string judged_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// The first of these tables, one entry per method.
std::vector<JudgedAnswer> judged_answers(const EvaluatedTask& task, Bootstrap& bootstrap);

}  // namespace signweave::calls
