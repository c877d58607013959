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

/// How one method did: [span], in the order of the spans that were evaluated.
struct MethodScores {
  std::string name;
  std::vector<SpanScores> spans;
};

/// Called with the part that is done, in [0, 1]; may throw to cancel.
using EvaluationProgress = std::function<void(double fraction)>;

/// Cuts each span out of its recording and makes it again by each method, with a model that was trained on every span
/// of the other folds: nothing is learned from the collection, signer or recording that is judged (Folds).
std::vector<MethodScores> evaluate_given(std::span<const EvaluatedMotion> recordings,
                                         std::span<const EvaluatedSpan> spans,
                                         std::span<const GapMethod* const> methods,
                                         const EvaluationProgress& progress = {});

/// The same with a duration that is told from the borders alone (DurationFit), fitted on the captured spans of the same
/// group in the other folds. Of Measure::duration and mean_duration each method has the same scores.
std::vector<MethodScores> evaluate_predicted(std::span<const EvaluatedMotion> recordings,
                                             std::span<const EvaluatedSpan> spans,
                                             std::span<const GapMethod* const> methods,
                                             const EvaluationProgress& progress = {});

/// A captured transition of which one side is replaced by a token from another recording.
struct ReplacedSpan {
  EvaluatedSpan span;        ///< the captured transition; its group is 0
  std::size_t source = 0;    ///< the recording that the other side is from
  FrameRange stroke;         ///< of the token, in it
  bool token_first = false;  ///< the token stands before the gap, else after it
  bool same_gloss = false;   ///< a token of the same gloss; else there was none, and it is of another sign
};

/// For each sign between two others, whose transitions to both were captured: a token from another recording of the
/// same joints stands in its place, of the same gloss where there is one, and of all such the one whose wrists lie
/// nearest to those of the neighbours at both borders. Two spans each. By recording, time.
std::vector<ReplacedSpan> choose_replaced(std::span<const EvaluatedMotion> recordings);

/// Makes the transitions to and from the tokens, each in the time of the captured one. Poses cannot be compared then,
/// so known are peak speed (over the mean speed), path length (over the straight way), smoothness, jumps and depth,
/// each beside the captured transition's. The model is trained on the spans of `training` that are of other folds
/// than the captured transition.
std::vector<MethodScores> evaluate_replaced(std::span<const EvaluatedMotion> recordings,
                                            std::span<const ReplacedSpan> spans,
                                            std::span<const EvaluatedSpan> training,
                                            std::span<const GapMethod* const> methods,
                                            const EvaluationProgress& progress = {});

/// How near the captures themselves come to the spans: another captured clip of as many frames, of a like body (the
/// same joints, shoulders as wide within kLikeBody, the same rate), its moving wrist seen from the signer and shifted
/// so that both ends meet. Two rows: "nearest", chosen by place and velocity at the borders, out of other recordings;
/// and "ceiling", chosen knowing what was captured, out of all recordings, of the span's own only what is at least
/// kApart away from it. Only Measure::wrist and wrist_widths are known, of the moving hand alone; not those where no
/// such clip is.
std::vector<MethodScores> evaluate_ceiling(std::span<const EvaluatedMotion> recordings,
                                           std::span<const EvaluatedSpan> spans);
inline constexpr float kLikeBody = 0.05f;  ///< share of the width
inline constexpr Seconds kApart{0.3};
/// Looking for them takes spans times captured frames; of more spans than this every second, third, … is looked at.
inline constexpr std::size_t kMostCeilings = 2000;

}  // namespace signweave
