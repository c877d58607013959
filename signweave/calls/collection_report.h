#pragma once

#include <string>
#include <vector>

#include "signweave/calls/evaluation_report.h"

namespace signweave::calls {

/// Tables by collection of the moving hand's wrist error: every method beside kriging in each collection and over
/// all, and whether it may be the default; medians beside means; long gaps by how many speed peaks they hide; and the
/// default over slerp by collection. Empty where kriging was not evaluated or there is no span.
std::string judged_text(const EvaluatedTask& task, Bootstrap& bootstrap);
/// The first of them, one entry a method.
std::vector<JudgedAnswer> judged_answers(const EvaluatedTask& task, Bootstrap& bootstrap);

}  // namespace signweave::calls
