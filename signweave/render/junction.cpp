#include "signweave/render/junction.h"

#include <algorithm>

#include "signweave/motion/blend.h"

namespace signweave {

const TransitionMethod& method_of(const JunctionSettings& settings, const PlacedClip& placed) noexcept {
  const TransitionMethod* const own = placed.captured->junction.method;
  return own != nullptr ? *own : *settings.method;
}

namespace {

constexpr GroupSet kLeft = {JointGroup::left_arm, JointGroup::left_fingers};

/// An arm is kept out of the body and of the other hand. The right one comes second: it yields to the left one as that
/// was corrected.
GroupSet guards_for(GroupSet shown) noexcept {
  if (shown.has(JointGroup::right_arm)) return GroupSet::all();
  return shown.has(JointGroup::left_arm) ? kLeft : shown;
}

}  // namespace

JunctionFiller::JunctionFiller(const JunctionSettings& settings, GroupSet shown)
    : settings_(settings),
      shown_(shown.within({JointGroup::left_arm, JointGroup::right_arm}).empty() ? shown : GroupSet::all()),
      guarded_(guards_for(shown)),
      guard_(*settings_.skeleton, settings_.rig->signer, settings_.rig->groups) {}

std::int64_t JunctionFiller::shared(const PlacedClip& a, const PlacedClip& b) noexcept {
  return std::max<std::int64_t>(0, a.end() - b.begin());
}

std::int64_t JunctionFiller::context() const noexcept {
  return context_frames(settings_.rate);
}

void JunctionFiller::fill(const PlacedClip& a, const PlacedClip& b, const TransitionCuts& cuts, OutputWindow window,
                          JunctionScratch& scratch) {
  Motion& shared = scratch.shared;
  const bool as_one = std::ranges::all_of(cuts, [&](const TransitionCut& cut) { return cut == cuts.front(); });
  turn_signs(a, b, cuts, window, shared);
  if (cuts.front().overlap() > 0) {
    crossfade(b, cuts.front().overlap(), window, shared);
  } else if (shared.frame_count() > 0) {
    take_over(b, cuts, window, shared);
  }
  // The body first, so that the arms are then filled in complete poses.
  for (std::size_t part = 0; part < (as_one ? 1 : kTimed); ++part) {
    const FrameRange gap{a.core_end() + cuts[part].retraction_frames, b.core - cuts[part].preparation_frames};
    if (gap.empty()) continue;
    const GroupSet together = as_one ? GroupSet::all() : groups_of(kAllTimed[part]);
    // Methods that look for similar captures compare all joints that they fill.
    const bool looks_for_spans = method_of(settings_, b).fill->needs == Needs::spans;
    const GroupSet groups = looks_for_spans ? together : together.within(shown_);
    if (!groups.empty()) fill_gap(a, b, gap, groups, cuts[part], window, scratch.gap);
  }
  if (method_of(settings_, b).fill->offered != Offered::signing) return;  // shown uncorrected
  for (const Timed part : {Timed::left, Timed::right}) {
    const TransitionCut& cut = cuts[static_cast<std::size_t>(part)];
    const FrameRange made{a.core_end() + cut.kept_after(), b.core - cut.kept_before()};
    const GroupSet guarded = groups_of(part).within(guarded_);
    if (!made.empty() && !guarded.empty()) guard_.repair(gap_at(a, b, made, window), guarded, window.poses(made));
  }
}

JunctionFiller::Meeting JunctionFiller::meeting(const PlacedClip& a, const PlacedClip& b, const TransitionCuts& cuts,
                                                Timed part) noexcept {
  const std::int64_t faded = cuts.front().overlap();
  const TransitionCut& cut = cuts[static_cast<std::size_t>(part)];
  const std::int64_t begin = b.core - cut.preparation_frames;
  if (faded > 0) return {begin + faded / 2, begin + faded / 2};
  return {a.core_end() + cut.retraction_frames - 1, begin};
}

/// Quaternion signs are consistent within a clip, so one sign per joint makes the whole clip continuous with the
/// previous side. It is chosen where the two meet: in the middle of a cross-fade, so that the shorter arc is taken
/// there. A separate choice for each frame would make a joint jump if the sides pass half a turn apart.
void JunctionFiller::turn_signs(const PlacedClip& a, const PlacedClip& b, const TransitionCuts& cuts,
                                OutputWindow window, Motion& shared) const {
  const std::int64_t own_begin = b.begin() + shared.frame_count();
  const std::int64_t own_end = std::min(b.end(), window.frames().end);
  const auto right_pose = [&](std::int64_t frame) {
    return frame < own_begin ? PoseView(shared.pose(frame - b.begin())) : PoseView(window.pose(frame));
  };
  const JointGroups& groups = settings_.rig->groups;
  for (const Timed part : kAllTimed) {
    const Meeting at = meeting(a, b, cuts, part);
    const PoseView left = window.pose(at.of_a);
    const PoseView right = right_pose(at.of_b);
    const GroupSet of_part = groups_of(part);
    for (std::size_t joint = 0; joint < left.rotations.size(); ++joint) {
      if (!of_part.has(groups.of[joint]) || left.rotations[joint].dot(right.rotations[joint]) >= 0) continue;
      for (std::int64_t k = 0; k < shared.frame_count(); ++k) shared.pose(k).rotations[joint].coeffs() *= -1.0f;
      for (std::int64_t frame = own_begin; frame < own_end; ++frame) {
        window.pose(frame).rotations[joint].coeffs() *= -1.0f;
      }
    }
  }
}

void JunctionFiller::crossfade(const PlacedClip& b, std::int64_t frames, OutputWindow window,
                               const Motion& shared) const {
  for (std::int64_t k = 0; k < frames; ++k) {
    const MutablePoseView pose = window.pose(b.begin() + k);
    const PoseView other = shared.pose(k);
    const float weight = crossfade_weight(k, frames);
    slerp_as_signed(pose.rotations, other.rotations, weight, pose.rotations);
    for (std::size_t t = 0; t < pose.translations.size(); ++t) {
      pose.translations[t] += weight * (other.translations[t] - pose.translations[t]);
    }
  }
}

/// Handles frames in which one part still shows the previous side and another already shows this one.
void JunctionFiller::take_over(const PlacedClip& b, const TransitionCuts& cuts, OutputWindow window,
                               const Motion& shared) const {
  const JointGroups& groups = settings_.rig->groups;
  for (std::int64_t k = 0; k < shared.frame_count(); ++k) {
    const std::int64_t frame = b.begin() + k;
    const auto has_begun = [&](JointGroup group) {
      return frame >= b.core - cuts[static_cast<std::size_t>(timed_of(group))].preparation_frames;
    };
    const MutablePoseView pose = window.pose(frame);
    const PoseView other = shared.pose(k);
    for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
      if (has_begun(groups.of[joint])) pose.rotations[joint] = other.rotations[joint];
    }
    for (std::size_t t = 0; t < pose.translations.size(); ++t) {
      if (has_begun(groups.of_translation[t])) pose.translations[t] = other.translations[t];
    }
  }
}

/// The context extends into the strokes, which are only read, but not beyond them: frames after a stroke may not be
/// known yet.
Gap JunctionFiller::gap_at(const PlacedClip& a, const PlacedClip& b, FrameRange frames, OutputWindow window) const {
  return {.skeleton = settings_.skeleton.get(),
          .groups = &settings_.rig->groups,
          .rate = settings_.rate,
          .before = window.view({std::max(a.core, frames.begin - context()), frames.begin}),
          .after = window.view({frames.end, std::min(frames.end + context(), b.core_end())}),
          .count = frames.size(),
          .noise_before = a.captured->noise.get(),
          .noise_after = b.captured->noise.get()};
}

void JunctionFiller::fill_gap(const PlacedClip& a, const PlacedClip& b, FrameRange frames, GroupSet groups,
                              const TransitionCut& cut, OutputWindow window, GapScratch& scratch) const {
  static const GapMethod* const waiting =
      find_gap_method("sine");  // from rest to rest, independent of noise at the borders
  Gap gap = gap_at(a, b, frames, window);
  gap.pause = static_cast<double>(cut.pause_frames) * gap.rate.frame_time();
  const GapMethod& method = cut.waits ? *waiting : *method_of(settings_, b).fill;
  const TransitionModel& model = settings_.model != nullptr ? *settings_.model : default_transition_model();
  method.fill({.gap = gap, .model = model, .groups = groups, .scratch = scratch}, window.poses(frames));
}

}  // namespace signweave
