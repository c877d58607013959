#include "signweave/synthesis/concatenate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "signweave/core/error.h"
#include "signweave/features/phase_features.h"
#include "signweave/motion/blend.h"
#include "signweave/synthesis/carry_tracks.h"
#include "signweave/synthesis/cut_points.h"
#include "signweave/synthesis/laid.h"
#include "signweave/synthesis/place_signs.h"
#include "signweave/transition/body_guard.h"

namespace signweave {
namespace {

void check_skeletons(const std::vector<Stretch>& stretches, const Stretch& reference) {
  for (const Stretch& stretch : stretches) {
    if (stretch.source->skeleton() == reference.source->skeleton()) continue;
    const auto differs = difference(*reference.source->skeleton(), *stretch.source->skeleton());
    if (!differs) continue;
    throw Error(ErrorCode::bad_input,
                fmt::format("recordings '{}' and '{}' have different skeletons: {}; only motions with "
                            "the same joints can be joined",
                            reference.recording, stretch.recording, *differs));
  }
}

FrameRate highest_rate(const std::vector<Stretch>& stretches) {
  FrameRate highest = stretches[0].source->rate();
  for (const Stretch& stretch : stretches) {
    if (stretch.source->rate().hertz() > highest.hertz()) highest = stretch.source->rate();
  }
  return highest;
}

const std::string& name_at_end(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.back().gloss;
}
const std::string& name_at_begin(const Stretch& stretch) {
  return stretch.signs.empty() ? stretch.recording : stretch.signs.front().gloss;
}

/// A day of signing at a hundred frames a second. Frame rates come from files: a wrong one must not ask for a terabyte.
constexpr std::int64_t kMostFrames = 24 * 60 * 60 * 100;

void check_length(const std::vector<Stretch>& stretches, std::int64_t frames, FrameRate rate) {
  if (frames >= 0 && frames <= kMostFrames) return;
  const auto slowest =
      std::ranges::min_element(stretches, {}, [](const Stretch& stretch) { return stretch.source->rate().hertz(); });
  throw Error(ErrorCode::bad_input,
              fmt::format("the result would have more than {} frames at {} frames a second ('{}' has {}); sign fewer "
                          "signs, or give a lower --rate",
                          kMostFrames, to_string(rate), slowest->recording, to_string(slowest->source->rate())));
}

/// Where everything will lie: Algorithm 1 before any frame is touched.
struct Plan {
  std::vector<Laid> laid;
  std::vector<TransitionCuts> cuts;       ///< [stretch − 1]
  std::vector<TransitionCut> track_cuts;  ///< [stretch − 1] of the scalar tracks
  std::int64_t frames = 0;
};

/// Reads what lies around the two cuts of a junction, before it is known where they come to lie.
class Edges {
 public:
  Edges(FrameRate rate, std::shared_ptr<const Skeleton> skeleton) : rate_(rate), skeleton_(std::move(skeleton)) {}

  /// At most `most` frames beside each stroke, and kContext of the strokes themselves.
  void read(const Laid& a, const Laid& b, std::int64_t most) {
    const std::int64_t context = std::max<std::int64_t>(1, std::llround(kContext.count() * rate_.hertz()));
    const std::int64_t within_a = std::min(context, a.core_frames);
    const std::int64_t within_b = std::min(context, b.core_frames);
    const std::int64_t before = std::min(b.preparation, most);
    read(a, {a.core_frames - within_a, a.core_frames + std::min(a.retraction, most)}, left_);
    read(b, {-before, within_b}, right_);
    from_ = {view_of(left_, {0, left_.frame_count()}), within_a - 1};
    to_ = {view_of(right_, {0, right_.frame_count()}), before};
  }
  const CutSide& from() const noexcept { return from_; }
  const CutSide& to() const noexcept { return to_; }
  /// The transition as it is where nothing of it is kept. `count` frames are to be made.
  Gap whole(const JointGroups& groups, std::int64_t count) const noexcept {
    return {.skeleton = skeleton_.get(),
            .groups = &groups,
            .rate = rate_,
            .before = view_of(left_, {0, from_.stroke + 1}),
            .after = view_of(right_, {to_.stroke, right_.frame_count()}),
            .count = count};
  }

 private:
  /// Frames counted from the core's first.
  void read(const Laid& laid, FrameRange frames, Motion& out) {
    Laid alone = laid;
    alone.core = 0;
    out.reset(skeleton_, rate_, frames.size());
    read_frames(alone, frames, out.poses({0, frames.size()}));
  }

  FrameRate rate_;
  std::shared_ptr<const Skeleton> skeleton_;
  Motion left_, right_;
  CutSide from_, to_;
};

/// Times and cuts one junction after another.
class Timer {
 public:
  Timer(const ConcatenateOptions& options, FrameRate rate, const TransitionMethod& method, const SignerRig& rig,
        const std::shared_ptr<const Skeleton>& skeleton)
      : options_(options), rate_(rate), method_(method), rig_(rig), edges_(rate, skeleton) {
    if (method.cut == nullptr) chooser_.emplace(*skeleton, rig.groups);
  }

  struct Cuts {
    TransitionCuts parts;
    TransitionCut tracks;  ///< of the scalar tracks, which know no poses
  };
  Cuts cuts_between(const Laid& a, const Laid& b, Milliseconds pause) {
    const bool choose = method_.cut == nullptr;
    const bool fitted = options_.fit != nullptr && !options_.fit->weights.empty();
    Seconds duration = options_.fit != nullptr ? options_.fit->mean : Seconds(options_.duration);
    if (choose || fitted) {
      edges_.read(a, b, choose ? std::llround(kLongestKept.count() * rate_.hertz()) : 0);
    }
    if (fitted) {
      TransitionTask task = task_of(edges_.whole(rig_.groups, 1), rig_.signer);
      for (HandTask& hand : task.hands) {  // as at tempo 1
        const auto tempo = static_cast<float>(options_.tempo);
        hand.speed_before /= tempo;
        hand.speed_after /= tempo;
        hand.approach /= tempo;
      }
      duration = duration_of(*options_.fit, task);
    }
    const double seconds = (duration + Seconds(pause)).count() / options_.tempo;
    const TransitionRoom room{.length = std::max<std::int64_t>(1, std::llround(seconds * rate_.hertz())),
                              .retraction = a.retraction,
                              .preparation = b.preparation,
                              .frames_per_second = rate_.hertz(),
                              .pause = pause > Milliseconds(0),
                              .pause_frames = std::llround(Seconds(pause).count() / options_.tempo * rate_.hertz())};
    Cuts cuts{.parts = {}, .tracks = method_.cut == nullptr ? cut_with_gap(room) : method_.cut(room)};
    if (!choose) {
      cuts.parts.fill(cuts.tracks);
      return cuts;
    }
    TransitionRoom known = room;  // what was read
    known.retraction = edges_.from().frames.frames - 1 - edges_.from().stroke;
    known.preparation = edges_.to().stroke;
    cuts.parts = chooser_->choose(known, edges_.from(), edges_.to());
    return cuts;
  }

 private:
  /// No more is kept of a retraction or a preparation where the cut is chosen.
  static constexpr Seconds kLongestKept{1.5};

  const ConcatenateOptions& options_;
  FrameRate rate_;
  const TransitionMethod& method_;
  const SignerRig& rig_;
  Edges edges_;
  std::optional<CutChooser> chooser_;
};

Plan plan_of(const std::vector<Stretch>& stretches, const ConcatenateOptions& options, FrameRate rate, Timer& timer) {
  Plan plan;
  plan.laid.reserve(stretches.size());
  plan.cuts.reserve(stretches.size());
  for (const Stretch& stretch : stretches) plan.laid.push_back(lay(stretch, rate, options.tempo));
  for (const Laid& laid : plan.laid) plan.frames += laid.core_frames;
  check_length(stretches, plan.frames, rate);  // before any frame is read
  plan.laid.front().before = plan.laid.front().preparation;
  plan.laid.back().after = plan.laid.back().retraction;
  plan.laid.front().core = plan.laid.front().before;
  for (std::size_t i = 1; i < plan.laid.size(); ++i) {
    Laid& a = plan.laid[i - 1];
    Laid& b = plan.laid[i];
    const Timer::Cuts cuts = timer.cuts_between(a, b, stretches[i].pause_before);
    for (const TransitionCut& cut : cuts.parts) {
      a.after = std::max(a.after, cut.retraction_frames);
      b.before = std::max(b.before, cut.preparation_frames);
    }
    b.core = a.core_end() + cuts.tracks.length;
    plan.cuts.push_back(cuts.parts);
    plan.track_cuts.push_back(cuts.tracks);
  }
  plan.frames = plan.laid.back().end();
  check_length(stretches, plan.frames, rate);
  return plan;
}

/// Fills the output with the frames of the stretches, one after the other, and with what lies between them.
class Filler {
 public:
  Filler(const Plan& plan, const ConcatenateOptions& options, const GapMethod& method, const SignerRig& rig,
         Synthesis& out)
      : plan_(plan),
        options_(options),
        method_(method),
        groups_(rig.groups),
        guard_(out.motion.skeleton(), rig.signer, rig.groups),
        out_(out) {}

  /// Stretch i, and the transition before it.
  void fill(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const std::int64_t shared = shared_before(i);
    const FrameRange own{now.begin() + shared, now.end()};
    faded_.reset(out_.motion.shared_skeleton(), out_.motion.rate(), shared);
    read_frames(now, {now.begin(), own.begin}, faded_.poses({0, shared}));
    read_frames(now, own, out_.motion.poses(own));
    align_to_home(i, own);
    if (i > 0) join(plan_.laid[i - 1], now, plan_.cuts[i - 1], own);
    tell_sources(i);
  }

 private:
  /// Frames that the stretch before has too: of the whole body in a cross-fade, of one part here and another there
  /// where each has its own cut.
  std::int64_t shared_before(std::size_t i) const {
    return i == 0 ? 0 : std::max<std::int64_t>(0, plan_.laid[i - 1].end() - plan_.laid[i].begin());
  }

  bool is_aligned(std::size_t i) const {
    const std::string& home = plan_.laid[options_.reference].stretch->recording;
    return options_.alignment == Alignment::ground ||
           (options_.alignment == Alignment::automatic && plan_.laid[i].stretch->recording != home);
  }

  /// Where the reference's signer stands, while stretch i is filled: the frames that tell are there already, but for a
  /// stretch before the reference.
  const Standing& home(std::size_t i) {
    if (home_) return *home_;
    const Laid& reference = plan_.laid[options_.reference];
    if (options_.reference <= i) {
      home_ = standing_over(out_.motion, {reference.core, reference.core_end()});
    } else {
      const MotionSource& source = *reference.stretch->source;
      Motion core;
      core.reset(source.skeleton(), source.rate(), reference.stretch->core.size());
      source.read(reference.stretch->core, core.poses({0, core.frame_count()}));
      home_ = standing_over(core, {0, core.frame_count()});
    }
    return *home_;
  }

  void align_to_home(std::size_t i, FrameRange own) {
    if (!is_aligned(i)) return;
    const Laid& now = plan_.laid[i];
    const GroundTransform transform = align(standing_over(out_.motion, {now.core, now.core_end()}), home(i));
    for (std::int64_t k = 0; k < faded_.frame_count(); ++k) apply(transform, out_.motion.skeleton(), faded_.pose(k));
    for (std::int64_t frame = own.begin; frame < own.end; ++frame)
      apply(transform, out_.motion.skeleton(), out_.motion.pose(frame));
  }

  /// The transition: Algorithm 1, lines 3 to 6. What both sides keep of it is there already.
  void join(const Laid& a, const Laid& b, const TransitionCuts& cuts, FrameRange own) {
    const bool as_one = std::ranges::all_of(cuts, [&](const TransitionCut& cut) { return cut == cuts.front(); });
    turn_signs(a, b, cuts, own);
    if (cuts.front().overlap() > 0) {
      crossfade(b, cuts.front().overlap());
    } else if (faded_.frame_count() > 0) {
      take_over(b, cuts);
    }
    // The body first: where it is, the arms' frames are those of whole poses.
    for (std::size_t part = 0; part < (as_one ? 1 : kTimed); ++part) {
      const FrameRange gap{a.core_end() + cuts[part].retraction_frames, b.core - cuts[part].preparation_frames};
      if (gap.empty()) continue;
      fill_gap(a, b, gap, as_one ? GroupSet::all() : groups_of(kAllTimed[part]), cuts[part]);
    }
    for (const Timed part : {Timed::left, Timed::right}) {
      const TransitionCut& cut = cuts[static_cast<std::size_t>(part)];
      const FrameRange made{a.core_end() + cut.kept_after(), b.core - cut.kept_before()};
      if (!made.empty()) guard_.mend(gap_at(a, b, made), groups_of(part), out_.motion.poses(made));
    }
  }

  /// Each stretch keeps its quaternions' signs from frame to frame, so one sign a joint makes the whole of it go on
  /// from the side before. It is chosen where the two meet: in the middle of a cross-fade, so that there the shorter
  /// arc is taken. Choosing anew for each frame would make a joint jump where the sides pass half a turn apart.
  void turn_signs(const Laid& a, const Laid& b, const TransitionCuts& cuts, FrameRange own) {
    const std::int64_t shared = cuts.front().overlap();
    const auto right_pose = [&](std::int64_t frame) {
      return frame < own.begin ? PoseView(faded_.pose(frame - b.begin())) : PoseView(out_.motion.pose(frame));
    };
    for (std::size_t part = 0; part < kTimed; ++part) {
      const TransitionCut& cut = cuts[part];
      const std::int64_t begin = b.core - cut.preparation_frames;
      const PoseView left =
          out_.motion.pose(shared > 0 ? begin + shared / 2 : a.core_end() + cut.retraction_frames - 1);
      const PoseView right = right_pose(shared > 0 ? begin + shared / 2 : begin);
      const GroupSet groups = groups_of(kAllTimed[part]);
      for (std::size_t joint = 0; joint < left.rotations.size(); ++joint) {
        if (!groups.has(groups_.of[joint]) || left.rotations[joint].dot(right.rotations[joint]) >= 0) continue;
        for (std::int64_t k = 0; k < faded_.frame_count(); ++k) faded_.pose(k).rotations[joint].coeffs() *= -1.0f;
        for (std::int64_t frame = own.begin; frame < own.end; ++frame) {
          out_.motion.pose(frame).rotations[joint].coeffs() *= -1.0f;
        }
      }
    }
  }

  void crossfade(const Laid& b, std::int64_t shared) {
    for (std::int64_t k = 0; k < shared; ++k) {
      const MutablePoseView pose = out_.motion.pose(b.begin() + k);
      const PoseView other = faded_.pose(k);
      const float weight = crossfade_weight(k, shared);
      slerp_as_signed(pose.rotations, other.rotations, weight, pose.rotations);
      for (std::size_t t = 0; t < pose.translations.size(); ++t) {
        pose.translations[t] += weight * (other.translations[t] - pose.translations[t]);
      }
    }
  }

  /// Where one part still shows the side before and another already this one.
  void take_over(const Laid& b, const TransitionCuts& cuts) {
    for (std::int64_t k = 0; k < faded_.frame_count(); ++k) {
      const std::int64_t frame = b.begin() + k;
      const auto has_begun = [&](JointGroup group) {
        return frame >= b.core - cuts[static_cast<std::size_t>(timed_of(group))].preparation_frames;
      };
      const MutablePoseView pose = out_.motion.pose(frame);
      const PoseView other = faded_.pose(k);
      for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
        if (has_begun(groups_.of[joint])) pose.rotations[joint] = other.rotations[joint];
      }
      for (std::size_t t = 0; t < pose.translations.size(); ++t) {
        if (has_begun(groups_.of_translation[t])) pose.translations[t] = other.translations[t];
      }
    }
  }

  Gap gap_at(const Laid& a, const Laid& b, FrameRange frames) const {
    // The context may reach into the strokes: it is only looked at.
    const std::int64_t context = std::max<std::int64_t>(1, std::llround(kContext.count() * out_.motion.rate().hertz()));
    return {.skeleton = &out_.motion.skeleton(),
            .groups = &groups_,
            .rate = out_.motion.rate(),
            .before = view_of(out_.motion, {std::max(a.core, frames.begin - context), frames.begin}),
            .after = view_of(out_.motion, {frames.end, std::min(frames.end + context, b.end())}),
            .count = frames.size()};
  }

  void fill_gap(const Laid& a, const Laid& b, FrameRange frames, GroupSet groups, const TransitionCut& cut) {
    Gap gap = gap_at(a, b, frames);
    gap.pause = static_cast<double>(cut.pause_frames) * gap.rate.frame_time();
    const GapMethod& method = cut.waits ? *waiting_ : method_;
    const TransitionModel& model = options_.model != nullptr ? *options_.model : default_transition_model();
    method.fill({.gap = gap, .model = model, .groups = groups, .scratch = scratch_}, out_.motion.poses(frames));
  }

  void tell_sources(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const auto stretch = static_cast<std::int32_t>(i);
    const bool last = i + 1 == plan_.laid.size();
    const std::int64_t kept_before = i == 0 ? now.before : common_to(plan_.cuts[i - 1]).kept_before();
    const std::int64_t kept_after = last ? now.after : common_to(plan_.cuts[i]).kept_after();
    const auto at = [&](std::int64_t frame) -> FrameSource& { return out_.sources[static_cast<std::size_t>(frame)]; };
    if (i > 0) {
      const std::int64_t made_from = plan_.laid[i - 1].core_end() + common_to(plan_.cuts[i - 1]).kept_after();
      for (std::int64_t frame = made_from; frame < now.core - kept_before; ++frame) {
        at(frame) = {FrameSource::kNone, stretch - 1, 0};
      }
    }
    const auto kept = [&](std::int64_t begin, std::int64_t end, std::int32_t junction) {
      if (now.captured_as_is()) {
        const std::int64_t shift = now.stretch->core.begin - now.core;
        for (std::int64_t frame = begin; frame < end; ++frame) {
          at(frame) = {stretch, junction, static_cast<double>(frame + shift)};
        }
      } else {
        for (std::int64_t frame = begin; frame < end; ++frame) at(frame) = {stretch, junction, now.frame_at(frame)};
      }
    };
    kept(now.core - kept_before, now.core, i > 0 ? stretch - 1 : FrameSource::kNone);
    kept(now.core, now.core_end(), FrameSource::kNone);
    kept(now.core_end(), now.core_end() + kept_after, last ? FrameSource::kNone : stretch);
  }

  const Plan& plan_;
  const ConcatenateOptions& options_;
  const GapMethod& method_;
  const JointGroups& groups_;
  BodyGuard guard_;
  Synthesis& out_;
  const GapMethod* waiting_ = find_gap_method("sine");  ///< from rest to rest, whatever the borders' noise says
  GapScratch scratch_;
  Motion faded_;  ///< the frames of a stretch that the one before has too
  std::optional<Standing> home_;
};

}  // namespace

SignerRig signer_rig_of(const Stretch& stretch, const RigNames& names) {
  // The measures are medians over some frames of a motion: those of the core serve.
  const MotionSource& source = *stretch.source;
  Motion core;
  core.reset(source.skeleton(), source.rate(), std::min(stretch.core.size(), kBodyFrames));
  source.read({stretch.core.begin, stretch.core.begin + core.frame_count()}, core.poses({0, core.frame_count()}));
  SignerModel signer = model_of(core, names);
  JointGroups groups = joint_groups(core.skeleton(), signer.rig);
  return {std::move(signer), std::move(groups)};
}

Synthesis concatenate(const std::vector<Stretch>& stretches, const ConcatenateOptions& options, Synthesis used) {
  if (stretches.empty()) throw Error(ErrorCode::bad_input, "nothing to join");
  const Stretch& reference = stretches.at(options.reference);
  check_skeletons(stretches, reference);
  const TransitionMethod& method = options.method != nullptr ? *options.method : transition_methods().front();
  const FrameRate rate = options.rate.numerator > 0 ? options.rate : highest_rate(stretches);
  std::optional<SignerRig> told;
  if (options.rig == nullptr) told = signer_rig_of(reference);
  const SignerRig& rig = told ? *told : *options.rig;
  Timer timer(options, rate, method, rig, reference.source->skeleton());
  const Plan plan = plan_of(stretches, options, rate, timer);

  Synthesis out;
  std::vector<ScalarTrack> used_tracks = used.motion.take_tracks();
  out.motion = std::move(used.motion);
  out.sources = std::move(used.sources);
  out.motion.reset(reference.source->skeleton(), rate, plan.frames);
  out.sources.resize(static_cast<std::size_t>(plan.frames));
  Filler filler(plan, options, *method.fill, rig, out);
  for (std::size_t i = 0; i < plan.laid.size(); ++i) filler.fill(i);

  for (std::size_t i = 0; i < plan.laid.size(); ++i) {
    const Laid& laid = plan.laid[i];
    const FrameRange core{laid.core, laid.core_end()};
    out.stretches.push_back({.recording = stretches[i].recording,
                             .output = {i == 0 ? 0 : core.begin, i + 1 == plan.laid.size() ? plan.frames : core.end},
                             .core = core,
                             .first_frame = laid.frame_at(core.begin),
                             .step = laid.step});
    if (i == 0) continue;
    out.junctions.push_back({.from = name_at_end(stretches[i - 1]),
                             .to = name_at_begin(stretches[i]),
                             .frames = {plan.laid[i - 1].core_end(), laid.core},
                             .cut = common_to(plan.cuts[i - 1]),
                             .cuts = plan.cuts[i - 1],
                             .method = std::string(method.name)});
    assert(out.junctions.back().frames.size() == plan.cuts[i - 1].front().length);
  }
  std::vector<Laid> laid_tracks = plan.laid;
  for (std::size_t i = 0; i < plan.track_cuts.size(); ++i) {
    laid_tracks[i].after = plan.track_cuts[i].retraction_frames;
    laid_tracks[i + 1].before = plan.track_cuts[i].preparation_frames;
  }
  carry_tracks(laid_tracks, std::move(used_tracks), out.motion);
  place_signs(stretches, out);
  return out;
}

}  // namespace signweave
