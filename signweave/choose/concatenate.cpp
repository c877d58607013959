#include "signweave/choose/concatenate.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "signweave/choose/joint_setup.h"
#include "signweave/choose/junction_timer.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/core/error.h"
#include "signweave/features/phase_features.h"
#include "signweave/render/render.h"

namespace signweave {
namespace {

FrameRate highest_rate(const std::vector<MotionClip>& clips) {
  FrameRate highest = clips[0].source->rate();
  for (const MotionClip& clip : clips) {
    if (clip.source->rate().hertz() > highest.hertz()) highest = clip.source->rate();
  }
  return highest;
}

void check_length(const std::vector<MotionClip>& clips, std::int64_t frames, FrameRate rate, std::int64_t most) {
  if (frames >= 0 && frames <= most) return;
  const auto slowest =
      std::ranges::min_element(clips, {}, [](const MotionClip& clip) { return clip.source->rate().hertz(); });
  throw Error(ErrorCode::bad_input,
              fmt::format("the result would have more than {} frames at {} frames a second ('{}' has {}); sign fewer "
                          "signs, or at a lower rate",
                          most, to_string(rate), slowest->recording, to_string(slowest->source->rate())),
              {{"rate", ""}});
}

FrameRange standing_frames(const PlacedClip& placed) {
  return {placed.core, std::min(placed.core_end(), placed.core + kStandingFrames)};
}

/// The standing of the reference's signer, for clip number `asking`.
Standing home_of(const Plan& plan, const Motion& fetched, std::size_t reference, std::size_t asking) {
  const PlacedClip& placed = plan.placed[reference];
  if (reference <= asking) return standing_over(fetched, standing_frames(placed));
  // For a later clip, from its frames as captured.
  const MotionClip& clip = *placed.captured;
  Motion core;
  core.reset(clip.source->skeleton(), clip.source->rate(), clip.core.size());
  clip.source->read(clip.core, core.poses({0, core.frame_count()}));
  return standing_over(core, {0, core.frame_count()});
}

void stand(Plan& plan, const Motion& fetched, const ConcatenateOptions& options) {
  const std::string& home_recording = plan.placed[options.reference].captured->recording;
  std::optional<Standing> home;
  for (std::size_t i = 0; i < plan.placed.size(); ++i) {
    if (!is_aligned(options.alignment, plan.placed[i].captured->recording, home_recording)) continue;
    if (!home) home = home_of(plan, fetched, options.reference, i);
    plan.placed[i].standing = align(standing_over(fetched, standing_frames(plan.placed[i])), *home);
  }
}

Plan plan_for(const std::vector<MotionClip>& clips, const JunctionSettings& settings,
              const ConcatenateOptions& options) {
  const std::int64_t most = options.most_frames;
  Plan plan;
  plan.placed.reserve(clips.size());
  plan.cuts.reserve(clips.size());
  for (const MotionClip& clip : clips) plan.placed.push_back(placed_at_tempo(clip, settings.rate, options.tempo));
  for (const PlacedClip& placed : plan.placed) plan.frames += placed.core_frames;
  check_length(clips, plan.frames, settings.rate, most);  // before any frame is read
  plan.placed.front().before = plan.placed.front().preparation;
  plan.placed.back().after = plan.placed.back().retraction;
  plan.placed.front().core = plan.placed.front().before;
  JunctionTimer timer(settings, {.fit = options.fit, .duration = options.duration, .tempo = options.tempo});
  JunctionScratch scratch;
  for (std::size_t i = 1; i < plan.placed.size(); ++i) {
    plan.cuts.push_back(timer.cuts_between(plan.placed[i - 1], plan.placed[i], clips[i].pause_before, scratch));
    place_after(plan.placed[i - 1], plan.placed[i], plan.cuts.back());
  }
  plan.frames = plan.placed.back().end();
  check_length(clips, plan.frames, settings.rate, most);
  return plan;
}

}  // namespace

SignerRig signer_rig_of(const MotionClip& clip) {
  // The measures are medians over some frames of a motion, so frames of the core suffice.
  const MotionSource& source = *clip.source;
  Motion core;
  core.reset(source.skeleton(), source.rate(), std::min(clip.core.size(), kBodyFrames));
  source.read({clip.core.begin, clip.core.begin + core.frame_count()}, core.poses({0, core.frame_count()}));
  SignerModel signer = model_of(core);
  JointGroups groups = joint_groups(core.skeleton(), signer.rig);
  return {std::move(signer), std::move(groups)};
}

JointSetup::JointSetup(const std::vector<MotionClip>& clips, const ConcatenateOptions& options) {
  if (clips.empty()) throw Error(ErrorCode::bad_input, "nothing to join");
  const MotionClip& reference = clips.at(options.reference);
  for (const MotionClip& clip : clips) require_same_joints(reference.recording, reference.source->skeleton(), clip);
  if (options.rig == nullptr) measured = signer_rig_of(reference);
  settings = {.skeleton = reference.source->skeleton(),
              .rate = options.rate.numerator > 0 ? options.rate : highest_rate(clips),
              .method = options.method != nullptr ? options.method : &transition_methods().front(),
              .rig = measured ? &*measured : options.rig,
              .model = options.model};
}

Synthesis concatenate(const std::vector<MotionClip>& clips, const ConcatenateOptions& options, Synthesis used) {
  const JointSetup setup(clips, options);
  const JunctionSettings& settings = setup.settings;
  const MotionClip& reference = clips[options.reference];
  Plan plan = plan_for(clips, settings, options);

  Synthesis out;
  out.motion = std::move(used.motion);
  out.sources = std::move(used.sources);
  std::vector<ScalarTrack> fetched = fetch(plan, settings, out.motion);
  stand(plan, out.motion, options);
  Score score = score_of(plan, settings, source_of(reference));
  if (options.author) plan.curves = score.curves = options.author(score);
  Renderer renderer(std::move(plan), settings);
  render(std::move(score), renderer, clips, std::move(fetched), out);
  return out;
}

}  // namespace signweave
