#include "signweave/render/lane_renderer.h"

#include <algorithm>

#include "signweave/render/render.h"
#include "signweave/render/window.h"

namespace signweave {
namespace {

GroupSet groups_of(Channel channel) noexcept {
  switch (channel) {
    case Channel::left:
      return {JointGroup::left_arm, JointGroup::left_fingers};
    case Channel::right:
      return {JointGroup::right_arm, JointGroup::right_fingers};
    case Channel::left_fingers:
      return {JointGroup::left_fingers};
    case Channel::right_fingers:
      return {JointGroup::right_fingers};
    case Channel::head:
      return {JointGroup::body};
    case Channel::body:
    case Channel::tracks:
      return {};
  }
  return {};
}

/// True for the neck or head of a rig and everything that grows from it, [joint].
std::vector<bool> joints_of_head(const Skeleton& skeleton, const SignerRig& rig) {
  const RigMap& map = rig.signer.rig;
  const JointIndex root = map[Part::neck].joint != kNoJoint ? map[Part::neck].joint : map[Part::head].joint;
  std::vector<bool> of_head(skeleton.joint_count(), false);
  for (std::size_t joint = 0; joint < of_head.size(); ++joint) {
    const JointIndex parent = skeleton.joints()[joint].parent;
    const bool grows =
        static_cast<JointIndex>(joint) == root || (parent != kNoJoint && of_head[static_cast<std::size_t>(parent)]);
    of_head[joint] = root != kNoJoint && grows && rig.groups.of[joint] == JointGroup::body;
  }
  return of_head;
}

void negate(const std::vector<std::size_t>& joints, const JointSigns& turned, MutablePoseView pose) noexcept {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (turned[i]) pose.rotations[joints[i]].coeffs() *= -1.0f;
  }
}

/// The weight of a clip's correction at an output frame: it rises over the transition before the clip's core, and falls
/// over the one after it. A corrected clip that follows takes over, so then it does not fall.
float weight_at(const LaneRun& run, std::size_t clip, std::int64_t frame) noexcept {
  const std::vector<PlacedClip>& placed = run.plan.placed;
  if (frame < placed[clip].core) {
    const std::int64_t begin = clip == 0 ? run.frames.begin : placed[clip - 1].core_end();
    if (clip == 0 && !run.from_parent) return 1;
    return frame < begin ? 0 : crossfade_weight(frame - begin, placed[clip].core - begin);
  }
  if (frame < placed[clip].core_end() || clip + 1 == placed.size()) return 1;
  const std::int64_t end = placed[clip + 1].core;
  if (run.places[clip + 1]) return frame < end ? 1 : 0;
  const std::int64_t begin = placed[clip].core_end();
  return frame >= end ? 0 : 1 - crossfade_weight(frame - begin, end - begin);
}

}  // namespace

LaneRenderer::LaneRenderer(std::span<const LaneRun> runs, const JunctionSettings& settings) : settings_(settings) {
  joints_.resize(kChannels.size() + kPartChannels.size());
  for (const LaneRun& run : runs) {
    Joints& joints = joints_[static_cast<std::size_t>(run.channel)];
    if (joints.rotations.empty()) joints = joints_of(run.channel);
    if (side_of_arm(run.channel) && !placer_ && settings.rig->signer.body) {
      placer_.emplace(*settings.skeleton, settings.rig->signer, settings.rig->groups);
    }
    strands_.push_back(
        {.run = &run, .renderer = std::make_unique<Renderer>(run.plan, settings, groups_of(run.channel))});
  }
}

LaneRenderer::~LaneRenderer() = default;

/// Frames of a strand, which stay until the next call.
PosesView LaneRenderer::frames_of(Strand& strand, FrameRange shown) {
  const FrameRange all = strand.run->frames;
  if (strand.made) return view_of(*strand.made, {shown.begin - all.begin, shown.end - all.begin});
  strand.renderer->render(shown, shown_);
  return view_of(shown_, {0, shown.size()});
}

/// Corrects the places of a run's hand in frames into which its arm was copied from `source`.
void LaneRenderer::correct(const LaneRun& run, FrameRange shown, const PosesView& source, OutputWindow window) {
  const std::optional<Side> side = side_of_arm(run.channel);
  if (!side || !placer_) return;
  for (std::size_t clip = 0; clip < run.places.size(); ++clip) {
    if (!run.places[clip]) continue;
    weights_.clear();
    for (std::int64_t frame = shown.begin; frame < shown.end; ++frame) {
      weights_.push_back(weight_at(run, clip, frame));
    }
    const HandPlace& place = *run.places[clip];
    const PlaceCorrection correction{
        .side = *side, .anchor = place.anchor, .kept_in = place.kept_in, .none = false, .out = place.out};
    placer_->apply(correction, source, weights_, window.poses(shown));
  }
}

/// True if another arm shows the same frames at the same time.
bool LaneRenderer::shows_same(const LaneRun& run, std::size_t clip, Channel other) const noexcept {
  const PlacedClip& own = run.plan.placed[clip];
  return std::ranges::any_of(strands_, [&](const Strand& strand) {
    return strand.run->channel == other && std::ranges::any_of(strand.run->plan.placed, [&](const PlacedClip& theirs) {
             return theirs.core == own.core && theirs.captured->recording == own.captured->recording &&
                    theirs.captured->core == own.captured->core;
           });
  });
}

std::vector<FoundPlace> LaneRenderer::find_places(ClipId first, const RenderBody& body) {
  std::vector<FoundPlace> found;
  if (!placer_) return found;
  for (Strand& strand : strands_) strand.renderer->render(strand.run->frames, strand.made.emplace());
  Motion composed;
  for (std::size_t i = 0; i < strands_.size(); ++i) {
    const LaneRun& run = *strands_[i].run;
    const std::optional<Side> side = side_of_arm(run.channel);
    if (!side) continue;
    const auto slot = static_cast<std::size_t>(*side);
    for (std::size_t clip = 0; clip < run.clips.size(); ++clip) {
      if (run.clips[clip] < first) continue;
      const PlacedClip& placed = run.plan.placed[clip];
      const FrameRange core{placed.core, placed.core_end()};
      body(core, composed);
      apply({composed, core.begin}, body);
      const bool both = shows_same(run, clip, arm_channel(kSides[1 - slot]));
      const MotionClip& captured = *placed.captured;
      std::array<bool, 2> arms = {both, both};
      arms[slot] = true;
      auto corrections =
          placer_->corrections({.name = captured.signs.empty() ? captured.recording : captured.signs.front().gloss,
                                .source = frames_of(strands_[i], core),
                                .composed = view_of(composed, {0, core.size()}),
                                .from_source = arms});
      std::optional<PlaceCorrection>& own = corrections[slot];
      if (own) found.push_back({run.channel, run.clips[clip], std::move(*own)});
    }
  }
  return found;
}

LaneRenderer::Joints LaneRenderer::joints_of(Channel channel) const {
  const Skeleton& skeleton = *settings_.skeleton;
  const JointGroups& groups = settings_.rig->groups;
  const GroupSet wanted = channel == Channel::head ? GroupSet() : groups_of(channel);
  const std::vector<bool> head =
      channel == Channel::head ? joints_of_head(skeleton, *settings_.rig) : std::vector<bool>(skeleton.joint_count());
  Joints joints;
  std::size_t translation = 0;
  for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
    const bool is_of_channel = wanted.has(groups.of[joint]) || head[joint];
    if (is_of_channel) joints.rotations.push_back(joint);
    if (!skeleton.joints()[joint].translated) continue;
    if (is_of_channel) joints.translations.push_back(translation);
    ++translation;
  }
  return joints;
}

/// A strand shows its first clip with the signs of its lane there, and its parent is shown after it with the signs that
/// the strand ends with.
void LaneRenderer::find_signs(std::size_t strand, const RenderBody& body) {
  Strand& now = strands_[strand];
  if (now.turned) return;
  const std::vector<std::size_t>& of_channel = joints(strand).rotations;
  Motion theirs(settings_.skeleton, settings_.rate, 1);
  Motion ours(settings_.skeleton, settings_.rate, 1);
  // Compares the strand with what is below it, in a frame of a clip that both show.
  const auto compare = [&](std::int64_t frame) {
    body({frame, frame + 1}, theirs);
    apply(strand, {theirs, frame}, body);
    now.renderer->render({frame, frame + 1}, ours);
    JointSigns differ(of_channel.size());
    for (std::size_t i = 0; i < of_channel.size(); ++i) {
      differ[i] = theirs.pose(0).rotations[of_channel[i]].dot(ours.pose(0).rotations[of_channel[i]]) < 0;
    }
    return differ;
  };
  JointSigns turned(of_channel.size(), false);
  if (now.run->from_parent) turned = compare(now.run->frames.begin - 1);
  // Below it, after it, the flips of the run before are shown as well, and this one's replace them.
  JointSigns flipped(of_channel.size(), false);
  if (now.run->back_to_parent) {
    flipped = compare(now.run->frames.end);
    for (std::size_t i = 0; i < of_channel.size(); ++i) flipped[i] = flipped[i] != turned[i];
  }
  now.turned = std::move(turned);
  now.flipped = std::move(flipped);
}

void LaneRenderer::apply(OutputWindow window, const RenderBody& body) {
  apply(strands_.size(), window, body);
}

/// Applies the first strands. The flips of a lane's runs add up: each one is relative to what is shown with those
/// before.
void LaneRenderer::apply(std::size_t strands, OutputWindow window, const RenderBody& body) {
  for (std::size_t i = 0; i < strands; ++i) {
    Strand& now = strands_[i];
    if (now.run->frames.begin >= window.frames().end) continue;
    find_signs(i, body);
    const Joints& channel = joints(i);
    const FrameRange shown = inside(now.run->frames, window.frames());
    if (!shown.empty()) {
      const PosesView source = frames_of(now, shown);
      for (std::int64_t frame = shown.begin; frame < shown.end; ++frame) {
        const PoseView from = source.pose(frame - shown.begin);
        const MutablePoseView to = window.pose(frame);
        for (const std::size_t joint : channel.rotations) to.rotations[joint] = from.rotations[joint];
        for (const std::size_t moved : channel.translations) to.translations[moved] = from.translations[moved];
      }
      correct(*now.run, shown, source, window);
      for (std::int64_t frame = shown.begin; frame < shown.end; ++frame) {
        negate(channel.rotations, *now.turned, window.pose(frame));
      }
    }
    const FrameRange after = inside({now.run->frames.end, window.frames().end}, window.frames());
    if (std::ranges::find(*now.flipped, true) == now.flipped->end()) continue;
    for (std::int64_t frame = after.begin; frame < after.end; ++frame) {
      negate(channel.rotations, *now.flipped, window.pose(frame));
    }
  }
}

}  // namespace signweave
