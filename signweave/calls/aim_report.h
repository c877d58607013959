#pragma once

#include <string>

#include "signweave/calls/evaluation_answer.h"
#include "signweave/evaluation/evaluate_aim.h"

namespace signweave::calls {

AimAnswer aim_answer(const AimEvaluation& evaluation);
/// Tables of mean errors: of all glosses, and of each one that has loci or tokens at different places.
std::string aim_text(const AimAnswer& answer);

}  // namespace signweave::calls
