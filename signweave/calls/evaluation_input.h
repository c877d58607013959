#pragma once

#include <string>
#include <vector>

#include "signweave/calls/listener.h"
#include "signweave/calls/motion_reading.h"
#include "signweave/evaluation/evaluation.h"

namespace signweave::calls {

/// The recordings to evaluate on, and those that were left out.
struct EvaluationInput {
  std::vector<EvaluatedMotion> recordings;  ///< by name
  std::vector<std::string> left_out;        ///< names; each was reported
};

/// Reads recordings of databases, motion files, and folders of motion files with their annotation. A recording that
/// cannot be evaluated on is left out with a notice; one that cannot be read is reported as a fault.
EvaluationInput read_evaluation_input(const std::vector<std::string>& paths, const MotionReading& reading,
                                      const Listener& listener);

/// The recordings of one database.
EvaluationInput read_evaluation_input(const Database& database, const Listener& listener);

}  // namespace signweave::calls
