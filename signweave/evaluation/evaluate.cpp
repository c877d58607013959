#include "signweave/evaluation/evaluate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "signweave/evaluation/compare.h"
#include "signweave/evaluation/regenerate.h"
#include "signweave/evaluation/training.h"
#include "signweave/transition/duration.h"

namespace signweave {
namespace {

using SpansOf = std::map<std::size_t, std::vector<std::size_t>>;  ///< [recording] indices

SpansOf by_recording(std::span<const EvaluatedSpan> spans) {
  SpansOf of;
  for (std::size_t i = 0; i < spans.size(); ++i) of[spans[i].recording].push_back(i);
  return of;
}

/// The motion that the frames next to spans are taken from.
const Motion& seen_of(const EvaluatedMotion& recording) {
  return recording.shaken ? *recording.shaken : recording.motion;
}

Gap gap_of(std::span<const EvaluatedMotion> recordings, const EvaluatedSpan& span, std::int64_t count) {
  const EvaluatedMotion& recording = recordings[span.recording];
  Gap gap = gap_at(seen_of(recording), recording.groups, span.frames, count);
  gap.noise_before = gap.noise_after = &recording.noise;
  return gap;
}

/// Adds the scores of a generated span that do not come from the comparison.
void add_made(const Regenerator::Made& made, SpanScores& scores) {
  for (auto& of : scores.of) {
    of[static_cast<std::size_t>(Measure::changed_frames)].value = static_cast<double>(made.changed);
    of[static_cast<std::size_t>(Measure::microseconds)].value = made.microseconds;
  }
}

/// Generates every span with every method, with `count_of(span)` frames.
template <class CountOf>
std::vector<MethodScores> make_all(std::span<const EvaluatedMotion> recordings, std::span<const EvaluatedSpan> spans,
                                   std::span<const GapMethod* const> methods, const EvaluationProgress& progress,
                                   CountOf count_of) {
  const Folds folds = folds_of(recordings);
  const TransitionTrainer trainer = train(recordings, spans, folds);
  std::vector<MethodScores> scores(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m) {
    scores[m].name = methods[m]->name;
    scores[m].spans.resize(spans.size());
  }
  std::size_t done = 0;
  std::shared_ptr<const TransitionModel> model;
  std::optional<std::size_t> left_out;  // fold left out of the model
  for (const auto& [index, of_recording] : by_recording(spans)) {
    if (left_out != folds.of[index]) {
      left_out = folds.of[index];
      model = trainer.model_without(*left_out);
    }
    Comparison comparison(recordings[index]);
    const EvaluatedMotion& recording = recordings[index];
    const SignerRig rig{recording.signer, recording.groups};
    Regenerator regenerator({.skeleton = recording.motion.shared_skeleton(),
                             .rate = recording.motion.rate(),
                             .rig = &rig,
                             .model = model.get()});
    for (const std::size_t i : of_recording) {
      const CutOut cut{seen_of(recording), spans[i].frames, count_of(i), &recording.noise};
      for (std::size_t m = 0; m < methods.size(); ++m) {
        const Regenerator::Made made = regenerator.make(*methods[m], cut);
        scores[m].spans[i] = comparison.compare(spans[i], made.poses);
        add_made(made, scores[m].spans[i]);
      }
      if (progress) progress(static_cast<double>(++done) / static_cast<double>(spans.size()));
    }
  }
  return scores;
}

}  // namespace

TransitionTrainer train(std::span<const EvaluatedMotion> recordings, std::span<const EvaluatedSpan> spans,
                        const Folds& folds) {
  TransitionTrainer trainer;
  for (const EvaluatedSpan& span : spans) {
    trainer.add(folds.of[span.recording], gap_of(recordings, span, span.frames.size()),
                view_of(recordings[span.recording].motion, span.frames));
  }
  return trainer;
}

std::vector<MethodScores> evaluate_given(std::span<const EvaluatedMotion> recordings,
                                         std::span<const EvaluatedSpan> spans,
                                         std::span<const GapMethod* const> methods,
                                         const EvaluationProgress& progress) {
  return make_all(recordings, spans, methods, progress, [&](std::size_t i) { return spans[i].frames.size(); });
}

std::vector<MethodScores> evaluate_predicted(std::span<const EvaluatedMotion> recordings,
                                             std::span<const EvaluatedSpan> spans,
                                             std::span<const GapMethod* const> methods,
                                             const EvaluationProgress& progress) {
  const Folds folds = folds_of(recordings);
  std::vector<TimedTransition> timed;  // [span]
  for (const EvaluatedSpan& span : spans) {
    const Gap gap = gap_of(recordings, span, span.frames.size());
    timed.push_back({task_of(gap, recordings[span.recording].signer), gap.duration(), folds.of[span.recording]});
  }
  std::vector<std::int64_t> counts(spans.size());
  std::vector<double> errors(spans.size());
  std::vector<double> mean_errors(spans.size());
  std::map<std::pair<std::size_t, std::size_t>, DurationFit> fits;  // [group, fold left out]
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const auto [fit, is_new] = fits.try_emplace({spans[i].group, timed[i].recording});
    if (is_new) {
      std::vector<TimedTransition> others;
      for (std::size_t j = 0; j < spans.size(); ++j) {
        if (spans[j].group == spans[i].group && timed[j].recording != timed[i].recording) others.push_back(timed[j]);
      }
      fit->second = fit_durations(others);
    }
    const Seconds predicted = duration_of(fit->second, timed[i].task);
    const FrameRate rate = recordings[spans[i].recording].motion.rate();
    counts[i] = std::max<std::int64_t>(1, std::llround(predicted.count() * rate.hertz()) - 1);
    errors[i] = 1000 * std::abs((predicted - timed[i].duration).count());
    mean_errors[i] = 1000 * std::abs((fit->second.mean - timed[i].duration).count());
  }
  std::vector<MethodScores> scores =
      make_all(recordings, spans, methods, progress, [&](std::size_t i) { return counts[i]; });
  for (MethodScores& method : scores) {
    for (std::size_t i = 0; i < spans.size(); ++i) {
      for (auto& of : method.spans[i].of) {
        of[static_cast<std::size_t>(Measure::duration)].value = errors[i];
        of[static_cast<std::size_t>(Measure::mean_duration)].value = mean_errors[i];
      }
    }
  }
  return scores;
}

}  // namespace signweave
