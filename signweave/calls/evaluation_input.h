#pragma once

#include <string>
#include <vector>

#include "signweave/calls/listener.h"
#include "signweave/calls/motion_reading.h"
#include "signweave/evaluation/evaluation.h"

namespace signweave::calls {

/// What is evaluated on, and what could not be.
struct EvaluationInput {
  std::vector<EvaluatedMotion> recordings;  ///< by name
  std::vector<std::string> left_out;        ///< names; each was reported
};

/// Recordings of databases, motion files, and folders of them with the annotation beside them. What cannot be
/// evaluated on is told and left out; what cannot be read is a fault.
EvaluationInput read_evaluation_input(const std::vector<std::string>& paths, const MotionReading& reading,
                                      const Listener& listener);

/// The recordings of one database.
EvaluationInput read_evaluation_input(const Database& database, const Listener& listener);

}  // namespace signweave::calls
