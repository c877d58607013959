#pragma once

#include <span>

#include "signweave/evaluation/evaluation.h"
#include "signweave/evaluation/folds.h"
#include "signweave/evaluation/spans.h"
#include "signweave/transition/model.h"

/// Inside this module only.
namespace signweave {

/// What is learned from every span; by fold, so that each can be left out.
TransitionTrainer train(std::span<const EvaluatedMotion> recordings, std::span<const EvaluatedSpan> spans,
                        const Folds& folds);

}  // namespace signweave
