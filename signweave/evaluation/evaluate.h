#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "signweave/evaluation/evaluation.h"
#include "signweave/evaluation/measure.h"
#include "signweave/evaluation/spans.h"
#include "signweave/transition/method.h"

namespace signweave {

/// The scores of one method: [span], in the order of the evaluated spans.
struct MethodScores {
  std::string name;
  std::vector<SpanScores> spans;
};

/// Called with the completed fraction, in [0, 1]; may throw to cancel.
using EvaluationProgress = std::function<void(double fraction)>;

/// Cuts each span out of its recording and regenerates it with each method, using a model trained on every span of the
/// other folds: nothing is learned from the collection, signer or recording that is evaluated (Folds).
std::vector<MethodScores> evaluate_given(std::span<const EvaluatedMotion> recordings,
                                         std::span<const EvaluatedSpan> spans,
                                         std::span<const GapMethod* const> methods,
                                         const EvaluationProgress& progress = {});

/// The same with a duration predicted from the borders alone (DurationFit), fitted on the captured spans of the same
/// group in the other folds. Measure::duration and mean_duration are the same for all methods.
std::vector<MethodScores> evaluate_predicted(std::span<const EvaluatedMotion> recordings,
                                             std::span<const EvaluatedSpan> spans,
                                             std::span<const GapMethod* const> methods,
                                             const EvaluationProgress& progress = {});

/// A captured transition with one side replaced by a token from another recording.
struct ReplacedSpan {
  EvaluatedSpan span;        ///< the captured transition; its group is 0
  std::size_t source = 0;    ///< the recording of the replacing token
  FrameRange stroke;         ///< of the token, in `source`
  bool token_first = false;  ///< true: the token is before the gap; false: after it
  bool same_gloss = false;   ///< a token of the same gloss; false: there was none, and it is of another sign
};

/// Chooses, for each sign with captured transitions to both neighbours, a replacing token from another recording with
/// the same joints: of the same gloss if there is one, and among those the one whose wrists are nearest to those of the
/// neighbours at both borders. Gives two spans for each sign, sorted by recording, time.
std::vector<ReplacedSpan> choose_replaced(std::span<const EvaluatedMotion> recordings);

/// Generates the transitions to and from the tokens, each with the duration of the captured one. Poses cannot be
/// compared, so the known measures are peak speed (over the mean speed), path length (over the straight distance),
/// smoothness, jumps and depth, each compared with the captured transition. The model is trained on the spans of
/// `training` in other folds than the captured transition.
std::vector<MethodScores> evaluate_replaced(std::span<const EvaluatedMotion> recordings,
                                            std::span<const ReplacedSpan> spans,
                                            std::span<const EvaluatedSpan> training,
                                            std::span<const GapMethod* const> methods,
                                            const EvaluationProgress& progress = {});

/// How well other captures match the spans: another captured piece of the same number of frames, of a similar body
/// (same joints, shoulder widths equal within kLikeBody, same rate), with its moving wrist in signer-centred space and
/// shifted so that both ends meet. Two rows: "nearest", chosen by position and velocity at the borders, from other
/// recordings; and "ceiling", chosen by comparison with the captured span, from all recordings, in the span's recording
/// only at least kApart away from it. Only Measure::wrist and wrist_widths of the moving hand are known, and only if
/// such a piece exists.
std::vector<MethodScores> evaluate_ceiling(std::span<const EvaluatedMotion> recordings,
                                           std::span<const EvaluatedSpan> spans);
inline constexpr float kLikeBody = 0.05f;  ///< relative to the width
inline constexpr Seconds kApart{0.3};
/// The search takes spans times captured frames; with more spans than this, only every second, third, … span is used.
inline constexpr std::size_t kMostCeilings = 2000;

}  // namespace signweave
