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
#include "signweave/synthesis/junction.h"
#include "signweave/synthesis/laid.h"
#include "signweave/synthesis/place_signs.h"

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

void check_length(const std::vector<Stretch>& stretches, std::int64_t frames, FrameRate rate, std::int64_t most) {
  if (frames >= 0 && frames <= most) return;
  const auto slowest =
      std::ranges::min_element(stretches, {}, [](const Stretch& stretch) { return stretch.source->rate().hertz(); });
  throw Error(ErrorCode::bad_input,
              fmt::format("the result would have more than {} frames at {} frames a second ('{}' has {}); sign fewer "
                          "signs, or give a lower --rate",
                          most, to_string(rate), slowest->recording, to_string(slowest->source->rate())));
}

/// Where everything will lie: Algorithm 1 before any frame is touched.
struct Plan {
  std::vector<Laid> laid;
  std::vector<JunctionCuts> cuts;  ///< [stretch − 1]
  std::int64_t frames = 0;
};

Plan plan_of(const std::vector<Stretch>& stretches, const JunctionSettings& settings, std::int64_t most) {
  Plan plan;
  plan.laid.reserve(stretches.size());
  plan.cuts.reserve(stretches.size());
  for (const Stretch& stretch : stretches) plan.laid.push_back(lay(stretch, settings.rate, settings.tempo));
  for (const Laid& laid : plan.laid) plan.frames += laid.core_frames;
  check_length(stretches, plan.frames, settings.rate, most);  // before any frame is read
  plan.laid.front().before = plan.laid.front().preparation;
  plan.laid.back().after = plan.laid.back().retraction;
  plan.laid.front().core = plan.laid.front().before;
  JunctionTimer timer(settings);
  JunctionScratch scratch;
  for (std::size_t i = 1; i < plan.laid.size(); ++i) {
    plan.cuts.push_back(timer.cuts_between(plan.laid[i - 1], plan.laid[i], stretches[i].pause_before, scratch));
    lay_after(plan.laid[i - 1], plan.laid[i], plan.cuts.back());
  }
  plan.frames = plan.laid.back().end();
  check_length(stretches, plan.frames, settings.rate, most);
  return plan;
}

/// Fills the output with the frames of the stretches, one after the other, and with what lies between them.
class Filler {
 public:
  Filler(const Plan& plan, const ConcatenateOptions& options, const JunctionSettings& settings, Synthesis& out)
      : plan_(plan), options_(options), junctions_(settings), out_(out) {}

  /// Stretch i, and the transition before it.
  void fill(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const std::int64_t shared = i == 0 ? 0 : JunctionFiller::shared(plan_.laid[i - 1], now);
    const FrameRange own{now.begin() + shared, now.end()};
    scratch_.shared.reset(out_.motion.shared_skeleton(), out_.motion.rate(), shared);
    read_frames(now, {now.begin(), own.begin}, scratch_.shared.poses({0, shared}));
    read_frames(now, own, out_.motion.poses(own));
    align_to_home(i, own);
    if (i > 0) junctions_.fill(plan_.laid[i - 1], now, plan_.cuts[i - 1].parts, {out_.motion}, scratch_);
    tell_sources(i);
  }

 private:
  bool is_aligned(std::size_t i) const {
    const std::string& home = plan_.laid[options_.reference].stretch->recording;
    return options_.alignment == Alignment::ground ||
           (options_.alignment == Alignment::automatic && plan_.laid[i].stretch->recording != home);
  }

  static FrameRange standing_frames(const Laid& laid) {
    return {laid.core, std::min(laid.core_end(), laid.core + kStandingFrames)};
  }

  /// Where the reference's signer stands, while stretch i is filled: the frames that tell are there already, but for a
  /// stretch before the reference.
  const Standing& home(std::size_t i) {
    if (home_) return *home_;
    const Laid& reference = plan_.laid[options_.reference];
    if (options_.reference <= i) {
      home_ = standing_over(out_.motion, standing_frames(reference));
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
    const GroundTransform transform = align(standing_over(out_.motion, standing_frames(now)), home(i));
    for (std::int64_t k = 0; k < scratch_.shared.frame_count(); ++k)
      apply(transform, out_.motion.skeleton(), scratch_.shared.pose(k));
    for (std::int64_t frame = own.begin; frame < own.end; ++frame)
      apply(transform, out_.motion.skeleton(), out_.motion.pose(frame));
  }

  void tell_sources(std::size_t i) {
    const Laid& now = plan_.laid[i];
    const auto stretch = static_cast<std::int32_t>(i);
    const bool last = i + 1 == plan_.laid.size();
    const std::int64_t kept_before = i == 0 ? now.before : common_to(plan_.cuts[i - 1].parts).kept_before();
    const std::int64_t kept_after = last ? now.after : common_to(plan_.cuts[i].parts).kept_after();
    const auto at = [&](std::int64_t frame) -> FrameSource& { return out_.sources[static_cast<std::size_t>(frame)]; };
    if (i > 0) {
      const std::int64_t made_from = plan_.laid[i - 1].core_end() + common_to(plan_.cuts[i - 1].parts).kept_after();
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
  JunctionFiller junctions_;
  Synthesis& out_;
  JunctionScratch scratch_;
  std::optional<Standing> home_;
};

}  // namespace

SignerRig signer_rig_of(const Stretch& stretch) {
  // The measures are medians over some frames of a motion: those of the core serve.
  const MotionSource& source = *stretch.source;
  Motion core;
  core.reset(source.skeleton(), source.rate(), std::min(stretch.core.size(), kBodyFrames));
  source.read({stretch.core.begin, stretch.core.begin + core.frame_count()}, core.poses({0, core.frame_count()}));
  SignerModel signer = model_of(core);
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
  const JunctionSettings settings{.skeleton = reference.source->skeleton(),
                                  .rate = rate,
                                  .method = &method,
                                  .rig = &rig,
                                  .fit = options.fit,
                                  .duration = options.duration,
                                  .tempo = options.tempo,
                                  .model = options.model};
  const Plan plan = plan_of(stretches, settings, options.most_frames);

  Synthesis out;
  std::vector<ScalarTrack> used_tracks = used.motion.take_tracks();
  out.motion = std::move(used.motion);
  out.sources = std::move(used.sources);
  out.motion.reset(reference.source->skeleton(), rate, plan.frames);
  out.sources.resize(static_cast<std::size_t>(plan.frames));
  Filler filler(plan, options, settings, out);
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
                             .cut = common_to(plan.cuts[i - 1].parts),
                             .cuts = plan.cuts[i - 1].parts,
                             .method = std::string(method_of(settings, plan.laid[i]).name),
                             .number = i,
                             .chosen = stretches[i].junction});
    assert(out.junctions.back().frames.size() == plan.cuts[i - 1].tracks.length);
  }
  std::vector<Laid> laid_tracks = plan.laid;
  for (std::size_t i = 0; i < plan.cuts.size(); ++i) {
    laid_tracks[i].after = plan.cuts[i].tracks.retraction_frames;
    laid_tracks[i + 1].before = plan.cuts[i].tracks.preparation_frames;
  }
  carry_tracks(laid_tracks, std::move(used_tracks), out.motion);
  place_signs(stretches, out);
  return out;
}

}  // namespace signweave
