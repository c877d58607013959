#pragma once

#include <span>

#include "signweave/evaluation/evaluation.h"
#include "signweave/evaluation/folds.h"
#include "signweave/evaluation/spans.h"
#include "signweave/transition/model.h"

/// Internal to this module.
namespace signweave {

/// Trains on every span, by fold, so that each fold can be left out.
TransitionTrainer train(std::span<const EvaluatedMotion> recordings, std::span<const EvaluatedSpan> spans,
                        const Folds& folds);

}  // namespace signweave
