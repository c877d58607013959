#include <algorithm>
#include <cmath>
#include <limits>

#include "signweave/core/text.h"
#include "signweave/evaluation/evaluate.h"
#include "signweave/evaluation/frame_at.h"
#include "signweave/evaluation/regenerate.h"
#include "signweave/evaluation/training.h"
#include "signweave/evaluation/wrist_kinematics.h"
#include "signweave/features/transition_stats.h"
#include "signweave/motion/blend.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// The frames of a sign's strokes; empty if it has none, or they extend beyond the motion or contain a defect.
FrameRange stroke_frames(const EvaluatedMotion& recording, const Sign& sign) {
  const std::optional<TimeSpan> span = sign.stroke_span();
  if (!span) return {};
  const FrameRange frames = frames_of(*span, recording.clock);
  if (frames.empty() || frames.begin < 1 || frames.end + 1 > recording.motion.frame_count()) return {};
  const auto spoiled = recording.unusable.begin();
  return std::find(spoiled + frames.begin, spoiled + frames.end, true) == spoiled + frames.end ? frames : FrameRange{};
}

/// Distance between the wrists of two recordings' frames in signer-centred space; squared metres.
double apart(const EvaluatedMotion& a, std::int64_t frame_a, const EvaluatedMotion& b, std::int64_t frame_b) {
  double sum = 0;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    if (a.tracks[hand].seen.empty() || b.tracks[hand].seen.empty()) continue;
    sum += static_cast<double>((a.tracks[hand].seen[at(frame_a)] - b.tracks[hand].seen[at(frame_b)]).squaredNorm());
  }
  return sum;
}

/// A token that may replace a sign.
struct Token {
  std::size_t recording = 0;
  FrameRange stroke;
  bool same_gloss = false;
};

std::optional<Token> token_for(std::span<const EvaluatedMotion> recordings, std::size_t index, const Sign& sign,
                               FrameRange first, FrameRange second) {
  const EvaluatedMotion& own = recordings[index];
  const std::string gloss = match_form(sign.gloss);
  std::optional<Token> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const EvaluatedMotion& other = recordings[r];
    if (r == index || other.signs.empty() || !(other.motion.rate() == own.motion.rate()) ||
        difference(own.motion.skeleton(), other.motion.skeleton())) {
      continue;
    }
    for (const Sign& candidate : other.signs) {
      const FrameRange stroke = stroke_frames(other, candidate);
      if (stroke.empty()) continue;
      const bool same = match_form(candidate.gloss) == gloss;
      if (best && best->same_gloss && !same) continue;
      const double cost =
          apart(own, first.begin - 1, other, stroke.begin) + apart(own, second.end, other, stroke.end - 1);
      if (best && best->same_gloss == same && cost >= least) continue;
      best = Token{r, stroke, same};
      least = cost;
    }
  }
  return best;
}

/// The two sides of a gap in one motion: the kept side of the recording, and the token moved to where the signer
/// stands, with `gap` between.
struct Joined {
  Motion motion;
  FrameRange gap;
};

Joined join(const EvaluatedMotion& recording, const EvaluatedMotion& source, const ReplacedSpan& replaced,
            std::int64_t context) {
  const Motion& own = recording.motion;
  const FrameRange frames = replaced.span.frames;
  const GroundTransform stand =
      align(standing_over(source.motion, replaced.stroke), standing_over(own, {frames.begin - 1, frames.end + 1}));
  Joined joined{Motion(own.shared_skeleton(), own.rate()), {}};
  const auto append = [&](const Motion& from, FrameRange range, bool moved) {
    for (std::int64_t frame = range.begin; frame < range.end; ++frame) {
      joined.motion.append(from.pose(frame));
      if (moved) apply(stand, own.skeleton(), joined.motion.pose(joined.motion.frame_count() - 1));
    }
  };
  const auto append_gap = [&] {
    joined.gap = {joined.motion.frame_count(), joined.motion.frame_count() + frames.size()};
    for (std::int64_t i = 0; i < frames.size(); ++i) joined.motion.append();
  };
  const FrameRange& stroke = replaced.stroke;
  if (replaced.token_first) {
    append(source.motion, {std::max(stroke.begin, stroke.end - context), stroke.end}, true);
    append_gap();
    append(own, {frames.end, std::min(own.frame_count(), frames.end + context)}, false);
  } else {
    append(own, {std::max<std::int64_t>(0, frames.begin - context), frames.begin}, false);
    append_gap();
    append(source.motion, {stroke.begin, std::min(stroke.end, stroke.begin + context)}, true);
  }
  return joined;
}

/// One wrist over a gap with some frames on both sides.
WristKinematics kinematics_of(const std::vector<Vector3f>& wrist, FrameRange gap, std::int64_t margin,
                              WristMeter& meter) {
  const std::int64_t begin = std::max<std::int64_t>(0, gap.begin - 1 - margin);
  const std::int64_t end = std::min(static_cast<std::int64_t>(wrist.size()), gap.end + 1 + margin);
  return meter.measure(std::span(wrist).subspan(at(begin), at(end - begin)), gap.begin - 1 - begin, gap.size());
}

void compare(const WristKinematics& is, const WristKinematics& was, std::array<Measurement, kMeasures>& out) {
  constexpr double kLeastChord = 0.02;  // metres: shorter movements have no meaningful shape
  if (!is.moves || !was.moves || is.chord < kLeastChord || was.chord < kLeastChord) return;
  const auto put = [&](double difference, Measure signed_one, Measure error) {
    out[static_cast<std::size_t>(signed_one)].value = difference;
    out[static_cast<std::size_t>(error)].value = std::abs(difference);
  };
  const auto peak = [](const WristKinematics& one) { return std::log(one.peak_speed / one.length); };
  put(peak(is) - peak(was), Measure::peak_speed, Measure::peak_speed_error);
  put(std::log(is.length / is.chord) - std::log(was.length / was.chord), Measure::path_length,
      Measure::path_length_error);
  put(is.jerk - was.jerk, Measure::jerk, Measure::jerk_error);
  put(is.arc_length - was.arc_length, Measure::arc_length, Measure::arc_length_error);
  out[static_cast<std::size_t>(Measure::velocity_jump)] = {is.velocity_jump, was.velocity_jump};
  out[static_cast<std::size_t>(Measure::acceleration_jump)] = {is.acceleration_jump, was.acceleration_jump};
}

}  // namespace

std::vector<ReplacedSpan> choose_replaced(std::span<const EvaluatedMotion> recordings) {
  std::vector<ReplacedSpan> chosen;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const EvaluatedMotion& recording = recordings[r];
    const std::vector<AnnotatedTransition> transitions = transitions_in(recording.signs);
    for (const AnnotatedTransition& first : transitions) {
      for (const AnnotatedTransition& second : transitions) {
        if (second.from != first.to) continue;
        const FrameRange before = frames_of(first.span, recording.clock);
        const FrameRange after = frames_of(second.span, recording.clock);
        const auto usable = [&](FrameRange frames) {
          if (frames.empty() || frames.begin < 2 || frames.end + 2 > recording.motion.frame_count()) return false;
          const auto spoiled = recording.unusable.begin();
          return std::find(spoiled + frames.begin - 2, spoiled + frames.end + 2, true) == spoiled + frames.end + 2;
        };
        if (!usable(before) || !usable(after)) continue;
        const std::optional<Token> token = token_for(recordings, r, recording.signs[first.to], before, after);
        if (!token) continue;
        for (const bool token_first : {false, true}) {
          chosen.push_back({.span = span_at(recording, r, token_first ? after : before, 0),
                            .source = token->recording,
                            .stroke = token->stroke,
                            .token_first = token_first,
                            .same_gloss = token->same_gloss});
        }
      }
    }
  }
  return chosen;
}

std::vector<MethodScores> evaluate_replaced(std::span<const EvaluatedMotion> recordings,
                                            std::span<const ReplacedSpan> spans,
                                            std::span<const EvaluatedSpan> training,
                                            std::span<const GapMethod* const> methods,
                                            const EvaluationProgress& progress) {
  const Folds folds = folds_of(recordings);
  const TransitionTrainer trainer = train(recordings, training, folds);
  std::vector<MethodScores> scores(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m) {
    scores[m].name = methods[m]->name;
    scores[m].spans.resize(spans.size());
  }
  std::shared_ptr<const TransitionModel> model;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const ReplacedSpan& replaced = spans[i];
    const EvaluatedMotion& recording = recordings[replaced.span.recording];
    if (i == 0 || spans[i - 1].span.recording != replaced.span.recording) {
      model = trainer.model_without(folds.of[replaced.span.recording]);
    }
    const FrameRate rate = recording.motion.rate();
    const std::int64_t context = context_frames(rate);
    const std::int64_t margin = std::max<std::int64_t>(2, std::llround(0.1 * rate.hertz()));
    Joined joined = join(recording, recordings[replaced.source], replaced, context);
    const SignerRig rig{recording.signer, recording.groups};
    Regenerator regenerator(
        {.skeleton = joined.motion.shared_skeleton(), .rate = rate, .rig = &rig, .model = model.get()});
    HandTracker tracker(joined.motion.skeleton(), recording.signer);
    WristMeter meter(rate);
    HandTracks tracks;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Regenerator::Made made = regenerator.make(*methods[m], {joined.motion, joined.gap, joined.gap.size()});
      const MutablePoses place = joined.motion.poses(joined.gap);
      std::copy(made.poses.rotations.begin(), made.poses.rotations.end(), place.rotations.begin());
      std::copy(made.poses.translations.begin(), made.poses.translations.end(), place.translations.begin());
      tracker.track(view_of(joined.motion, {0, joined.motion.frame_count()}), tracks);
      SpanScores& one = scores[m].spans[i];
      for (std::size_t hand = 0; hand < 2; ++hand) {
        if (tracks[hand].wrist.empty()) continue;
        compare(kinematics_of(tracks[hand].wrist, joined.gap, margin, meter),
                kinematics_of(recording.tracks[hand].wrist, replaced.span.frames, margin, meter), one.of[hand]);
        if (tracks[hand].depth.empty()) continue;
        const auto depth = tracks[hand].depth.begin();
        const float sources = std::max(depth[joined.gap.begin - 1], depth[joined.gap.end]);
        const float deepest = *std::max_element(depth + joined.gap.begin, depth + joined.gap.end);
        one.of[hand][static_cast<std::size_t>(Measure::depth)].value =
            1000 * static_cast<double>(std::max(0.0f, deepest - sources));
      }
      one.of[static_cast<std::size_t>(HandChoice::moving)] = one.of[static_cast<std::size_t>(replaced.span.moving)];
      for (auto& of : one.of) {
        of[static_cast<std::size_t>(Measure::changed_frames)].value = static_cast<double>(made.changed);
        of[static_cast<std::size_t>(Measure::microseconds)].value = made.microseconds;
      }
    }
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(spans.size()));
  }
  return scores;
}

}  // namespace signweave
