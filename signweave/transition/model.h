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

/// Parameters learned from captured spans; immutable, so threads may share it.
struct TransitionModel;

/// The model stored in the repository, learned from the files named in docs/evaluation.md (trained by
/// tools/train_transitions).
const TransitionModel& default_transition_model() noexcept;

/// Learns from captured spans of several recordings. A model without one of them costs little more than solving its
/// equations, because each span is processed once, when added. Used by one thread; returned models are immutable,
/// outlive it and may be shared.
class TransitionTrainer {
 public:
  TransitionTrainer();
  ~TransitionTrainer();
  TransitionTrainer(TransitionTrainer&&) noexcept;
  TransitionTrainer& operator=(TransitionTrainer&&) noexcept;

  /// Adds a captured span: `gap` as passed to a method, and the frames captured in its place. `recording` identifies
  /// the spans of one recording. Everything is borrowed for the call.
  void add(std::size_t recording, const Gap& gap, PosesView captured);
  /// The model of all recordings, or of all but one.
  std::shared_ptr<const TransitionModel> model() const;
  std::shared_ptr<const TransitionModel> model_without(std::size_t recording) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Collects captured spans for the method `recorded`, without learning from them. Used by one thread.
class SpanCollector {
 public:
  SpanCollector();
  ~SpanCollector();

  /// Adds a captured span, as TransitionTrainer::add does. Returns false if it is skipped: for non-finite values, or
  /// because kMostSpans are stored already.
  bool add(const Gap& gap, PosesView captured);
  /// Sets the residual model of the result.
  void set_residuals(std::shared_ptr<const ResidualModel> residuals);
  /// Returns the default model with these spans, which are moved into it: the collector is empty afterwards.
  std::shared_ptr<const TransitionModel> take_model();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace signweave
