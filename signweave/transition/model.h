#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/residual_model.h"
#include "signweave/motion/motion.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// What was learned from captured spans; immutable, so threads may share it.
struct TransitionModel;

/// Learned from the files that docs/evaluation.md names, and kept in the repository (trained by
/// tools/train_transitions).
const TransitionModel& default_transition_model() noexcept;

/// Learns from captured spans of several recordings, so that the model without one of them costs little more than a
/// solution of its equations. Adding looks at each span once. It belongs to one thread; what it gives out stays as it
/// is, outlives it and may be shared.
class TransitionTrainer {
 public:
  TransitionTrainer();
  ~TransitionTrainer();
  TransitionTrainer(TransitionTrainer&&) noexcept;
  TransitionTrainer& operator=(TransitionTrainer&&) noexcept;

  /// Adds a captured stretch: `gap` as a method would be given it, and the frames that were captured where it is.
  /// `recording` tells which spans go together. Everything is borrowed for the call.
  void add(std::size_t recording, const Gap& gap, PosesView captured);
  /// What all recordings teach, or all but one.
  std::shared_ptr<const TransitionModel> model() const;
  std::shared_ptr<const TransitionModel> model_without(std::size_t recording) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Captured spans for the method `recorded`, without learning anything from them. It belongs to one thread.
class SpanCollector {
 public:
  SpanCollector();
  ~SpanCollector();

  /// Adds a captured stretch, as TransitionTrainer::add does. False where it is left out: for numbers that are none, or
  /// because there are thousands already.
  bool add(const Gap& gap, PosesView captured);
  /// What the model says of residuals.
  void set_residuals(std::shared_ptr<const ResidualModel> residuals);
  /// The default model, with these spans. They go over into it: the collector is empty then.
  std::shared_ptr<const TransitionModel> take_model();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace signweave
