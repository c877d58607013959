#include "signweave/choose/durations.h"

namespace signweave {

DurationFit durations_of(const Contents& contents, const semantic_db::Learned& learned, const DurationModel& model) {
  if (model.fixed) return {.mean = *model.fixed};
  const TransitionStats& stats = contents.transitions;
  DurationFit fit;
  if (model.fitted) fit = learned.durations;
  fit.count = stats.count;
  if (model.fitted && stats.inferred && 2 * stats.count < learned.unphased_signs) {
    // Most of them touch, so the few gaps are pauses and say nothing about transitions.
    fit.count = 0;
    fit.mean = kUnphasedTransition;
    return fit;
  }
  fit.median = model.fitted && stats.inferred;
  if (stats.count > 0) {
    fit.mean = model.fitted && stats.inferred ? stats.median : stats.mean;
  } else {
    fit.mean = learned.phased_signs > 0 ? kUnmeasuredTransition : kUnphasedTransition;
  }
  return fit;
}

}  // namespace signweave
