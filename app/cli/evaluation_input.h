#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/motion_options.h"
#include "signweave/evaluation/evaluation.h"

namespace signweave::cli {

/// What is evaluated on, and what could not be.
struct EvaluationInput {
  std::vector<EvaluatedMotion> recordings;  ///< by name
  std::size_t left_out = 0;                 ///< each was told of on `err`
};

/// Recordings of databases, motion files, and folders of them with the annotation beside them. What cannot be
/// evaluated on is told in one line each and left out; what cannot be read sets the exit status to 1 too.
EvaluationInput read_evaluation_input(const std::vector<std::string>& paths, const MotionOptions& reading, Io& io);

}  // namespace signweave::cli
