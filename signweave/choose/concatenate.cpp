#include "signweave/choose/concatenate.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "signweave/choose/junction_timer.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/core/error.h"
#include "signweave/features/phase_features.h"
#include "signweave/render/render.h"

namespace signweave {
namespace {

FrameRate highest_rate(const std::vector<Stretch>& stretches) {
  FrameRate highest = stretches[0].source->rate();
  for (const Stretch& stretch : stretches) {
    if (stretch.source->rate().hertz() > highest.hertz()) highest = stretch.source->rate();
  }
  return highest;
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

FrameRange standing_frames(const Laid& laid) {
  return {laid.core, std::min(laid.core_end(), laid.core + kStandingFrames)};
}

/// Where the reference's signer stands, for a stretch of that number.
Standing home_of(const Plan& plan, const Motion& fetched, std::size_t reference, std::size_t asking) {
  const Laid& laid = plan.laid[reference];
  if (reference <= asking) return standing_over(fetched, standing_frames(laid));
  // Of a stretch that comes later, from its frames as they were captured.
  const Stretch& stretch = *laid.stretch;
  Motion core;
  core.reset(stretch.source->skeleton(), stretch.source->rate(), stretch.core.size());
  stretch.source->read(stretch.core, core.poses({0, core.frame_count()}));
  return standing_over(core, {0, core.frame_count()});
}

void stand(Plan& plan, const Motion& fetched, const ConcatenateOptions& options) {
  const std::string& home_recording = plan.laid[options.reference].stretch->recording;
  std::optional<Standing> home;
  for (std::size_t i = 0; i < plan.laid.size(); ++i) {
    if (!is_aligned(options.alignment, plan.laid[i].stretch->recording, home_recording)) continue;
    if (!home) home = home_of(plan, fetched, options.reference, i);
    plan.laid[i].standing = align(standing_over(fetched, standing_frames(plan.laid[i])), *home);
  }
}

Plan plan_for(const std::vector<Stretch>& stretches, const JunctionSettings& settings,
              const ConcatenateOptions& options) {
  const std::int64_t most = options.most_frames;
  Plan plan;
  plan.laid.reserve(stretches.size());
  plan.cuts.reserve(stretches.size());
  for (const Stretch& stretch : stretches) plan.laid.push_back(lay(stretch, settings.rate, options.tempo));
  for (const Laid& laid : plan.laid) plan.frames += laid.core_frames;
  check_length(stretches, plan.frames, settings.rate, most);  // before any frame is read
  plan.laid.front().before = plan.laid.front().preparation;
  plan.laid.back().after = plan.laid.back().retraction;
  plan.laid.front().core = plan.laid.front().before;
  JunctionTimer timer(settings, {.fit = options.fit, .duration = options.duration, .tempo = options.tempo});
  JunctionScratch scratch;
  for (std::size_t i = 1; i < plan.laid.size(); ++i) {
    plan.cuts.push_back(timer.cuts_between(plan.laid[i - 1], plan.laid[i], stretches[i].pause_before, scratch));
    lay_after(plan.laid[i - 1], plan.laid[i], plan.cuts.back());
  }
  plan.frames = plan.laid.back().end();
  check_length(stretches, plan.frames, settings.rate, most);
  return plan;
}

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
  for (const Stretch& stretch : stretches)
    require_same_joints(reference.recording, reference.source->skeleton(), stretch);
  const TransitionMethod& method = options.method != nullptr ? *options.method : transition_methods().front();
  const FrameRate rate = options.rate.numerator > 0 ? options.rate : highest_rate(stretches);
  std::optional<SignerRig> measured;
  if (options.rig == nullptr) measured = signer_rig_of(reference);
  const SignerRig& rig = measured ? *measured : *options.rig;
  const JunctionSettings settings{
      .skeleton = reference.source->skeleton(), .rate = rate, .method = &method, .rig = &rig, .model = options.model};
  Plan plan = plan_for(stretches, settings, options);

  Synthesis out;
  out.motion = std::move(used.motion);
  out.sources = std::move(used.sources);
  std::vector<ScalarTrack> fetched = fetch(plan, settings, out.motion);
  stand(plan, out.motion, options);
  Score score = score_of(plan, settings, source_of(reference));
  Renderer renderer(std::move(plan), settings);
  render(std::move(score), renderer, stretches, std::move(fetched), out);
  return out;
}

}  // namespace signweave
