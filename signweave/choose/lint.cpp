#include "signweave/choose/lint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

#include "signweave/core/text.h"
#include "signweave/features/contact.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/smoothing.h"
#include "signweave/features/two_handed.h"
#include "signweave/features/unmarked_handshape.h"
#include "signweave/render/hand_meter.h"
#include "signweave/render/place_correction.h"
#include "signweave/render/plan.h"

namespace signweave {
namespace {

/// Fewer common frames of two strokes are not judged. Seconds. (ours)
constexpr Seconds kLeastCommon{0.1};

/// Both hands over some frames of a motion.
struct BothHands {
  TwoHanded movement;  ///< without `openness_apart`
  HandsMeeting meeting;
};

/// Measures both hands in one pass. The movement is as of measure_hands.
BothHands both_hands(HandMeter& meter, const SignerBody& body, const Motion& motion, FrameRange frames) {
  const Smoother smoother(kSmoothing, motion.rate(), motion.frame_count());
  const FrameRange seen = smoother.window(frames);
  std::array<std::vector<Eigen::Vector3f>, 2> paths;
  BothHands both;
  for (std::int64_t frame = seen.begin; frame < seen.end; ++frame) {
    meter.look(motion.pose(frame));
    for (const Side side : kSides) {
      paths[static_cast<std::size_t>(side)].push_back(meter.space().to_signer(meter.palm(side)));
    }
    if (frame >= frames.begin && frame < frames.end) meter.meet(both.meeting);
  }
  std::array<PointTrack, 2> palms;
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
      palms[side].push_back({.position = paths[side][static_cast<std::size_t>(frame - seen.begin)],
                             .velocity = smoother.at(frame, paths[side], seen.begin).velocity * body.shoulder_width,
                             .state = {}});
    }
  }
  TwoHandedSum sum;
  sum.add(palms[0], palms[1]);
  both.movement = sum.movement();
  both.movement.contact = -both.meeting.depth <= kContactGap * body.shoulder_width;
  return both;
}

/// The handshapes in one frame, [Side].
std::array<Handshape, 2> handshapes(const Motion& motion, const SignerModel& signer, std::int64_t frame) {
  const HandMotion measured = measure_hands(motion, signer, {frame, frame + 1});
  return {measured.hands[0].frames.front().handshape, measured.hands[1].frames.front().handshape};
}

/// The mean difference of the hands' openness (TwoHanded::openness_apart).
float openness_apart(const Motion& motion, const SignerModel& signer) {
  const HandMotion measured = measure_hands(motion, signer, {0, motion.frame_count()});
  std::array<PointTrack, 2> palms;
  for (std::size_t side = 0; side < 2; ++side) {
    for (const HandFrame& frame : measured.hands[side].frames) palms[side].push_back(point_of(frame));
  }
  TwoHandedSum sum;
  sum.add(palms[0], palms[1]);
  return sum.movement().openness_apart;
}

class ChannelLint {
 public:
  ChannelLint(const Synthesis& made, const std::vector<MotionClip>& clips, const ChannelParts& parts,
              const SignerRig& rig)
      : made_(made), clips_(clips), parts_(parts), rig_(rig), meter_(made.motion.skeleton(), rig.signer) {}

  std::vector<Notice> take() { return std::move(notices_); }

  /// The strokes of a part's clip against those of the whole body at the same time.
  void examine(std::size_t part) {
    const ChannelClip& own = parts_.clips[part];
    const std::optional<Side> side = side_of_arm(own.channel);
    if (!side) return;
    const FrameRange at = made_.score.clips[clips_.size() + part].at;
    for (std::size_t i = 0; i < clips_.size(); ++i) {
      const FrameRange theirs = made_.score.clips[i].at;
      const FrameRange common{std::max(at.begin, theirs.begin), std::min(at.end, theirs.end)};
      const auto least = static_cast<std::int64_t>(kLeastCommon.count() * made_.score.rate.hertz());
      if (common.end - common.begin < least) continue;
      if (!has_hands()) continue;
      const BothHands both = both_hands(meter_, *rig_.signer.body, made_.motion, common);
      shapes(own, clips_[i], *side, common, both.movement);
      collision(own.clip, clips_[i], *side, both.meeting);
    }
  }

  /// What a channel leaves out of the signs of the whole body, from one clip to another.
  void dropped(Channel channel, std::size_t first, std::size_t last) {
    const std::optional<Side> side = side_of_arm(channel);
    if (!side || !has_hands()) return;
    for (std::size_t i = first; i <= last; ++i) {
      const bool touch = captured(clips_[i]).movement.contact;
      if (!touch && !alternates(clips_[i])) continue;
      add("weak_drop", fmt::format("the {} hand does something else in {}, in which both hands {}", name_of(channel),
                                   quoted_name(clips_[i]), touch ? "touch" : "alternate"));
    }
  }

  void long_holds(const Utterance* utterance) {
    for (const Lane& lane : made_.score.lanes) {
      if (lane.channel == Channel::body || lane.channel == Channel::tracks) continue;
      for (const Item& item : lane.items) {
        const auto* const held = std::get_if<Hold>(&item.what);
        if (held == nullptr || item.at.begin == 0 || item.at.end == made_.score.frames) continue;
        if (made_.score.clips[held->clip].at_rest) continue;
        const double seconds = static_cast<double>(item.at.size()) / made_.score.rate.hertz();
        const Clip& clip = made_.score.clips[held->clip];
        const std::string what = clip.signs.empty() ? "a piece" : printable(clip.signs.back().gloss);
        if (seconds > kLongHold.count()) {
          add("long_hold", fmt::format("'{}' is held for {:.1f} s in the lane '{}'; holds of signers are rarely longer "
                                       "than {:.0f} s",
                                       what, seconds, name_of(lane.channel), kLongHold.count()));
        } else if (utterance != nullptr && crosses_stop(item.at, *utterance)) {
          add("long_hold",
              fmt::format("'{}' is held across a full stop in the lane '{}'", what, name_of(lane.channel)));
        }
      }
    }
  }

 private:
  void add(std::string code, std::string text) {
    Notice notice{"channels", std::move(text), {}, std::move(code)};
    if (std::ranges::find(notices_, notice) == notices_.end()) notices_.push_back(std::move(notice));
  }

  bool has_hands() const noexcept { return meter_.has(Side::left) && meter_.has(Side::right); }

  void shapes(const ChannelClip& own, const MotionClip& body, Side side, FrameRange common, const TwoHanded& movement) {
    if (!meter_.has_fingers(Side::left) || !meter_.has_fingers(Side::right)) return;
    const auto slot = static_cast<std::size_t>(side);
    const std::array<Handshape, 2> shapes = handshapes(made_.motion, rig_.signer, common.begin + common.size() / 2);
    if (!handshapes_differ(shapes[0], shapes[1])) return;
    if (both_move(movement)) {
      add("symmetry", fmt::format("{} and {} move at the same time with different handshapes", quoted_name(own.clip),
                                  quoted_name(body)));
      return;
    }
    const float own_speed = movement.palms[slot].mean_speed;
    const float other_speed = movement.palms[1 - slot].mean_speed;
    const bool own_is_held = own_speed < kStillPalm && other_speed > kMovingPalm;
    if (own_is_held && !is_unmarked(shapes[slot])) {
      add("dominance", fmt::format("the held hand of {} beside {} has a marked handshape of its own",
                                   quoted_name(own.clip), quoted_name(body)));
    }
  }

  void collision(const MotionClip& own, const MotionClip& body, Side side, const HandsMeeting& made) {
    const std::array<HandsMeeting, 2> in_captures = {captured(own).meeting, captured(body).meeting};
    if (const std::optional<std::string> why = why_hands_collide(made, in_captures)) {
      add("collision", fmt::format("{} of the {} hand and {}: {}", quoted_name(own),
                                   side == Side::left ? "left" : "right", quoted_name(body), *why));
    }
  }

  static Motion core_of(const MotionClip& clip) {
    const std::int64_t frames = std::min<std::int64_t>(clip.core.size(), kBodyFrames);
    Motion core(clip.source->skeleton(), clip.source->rate(), frames);
    clip.source->read({clip.core.begin, clip.core.begin + frames}, core.poses({0, frames}));
    return core;
  }
  const BothHands& captured(const MotionClip& clip) {
    const auto [at, is_new] = captured_.try_emplace(&clip);
    if (is_new && !clip.core.empty()) {
      const Motion core = core_of(clip);
      at->second = both_hands(meter_, *rig_.signer.body, core, {0, core.frame_count()});
    }
    return at->second;
  }
  /// True if the hands alternate in a clip. Their openness is measured only where it can change that.
  bool alternates(const MotionClip& clip) {
    TwoHanded movement = captured(clip).movement;
    if (class_of(movement, *rig_.signer.body) != Hands::alternating) return false;
    movement.openness_apart = openness_apart(core_of(clip), rig_.signer);
    return class_of(movement, *rig_.signer.body) == Hands::alternating;
  }

  bool crosses_stop(FrameRange frames, const Utterance& utterance) const {
    for (std::size_t i = 1; i < clips_.size(); ++i) {
      const Clip& clip = made_.score.clips[i];
      const bool stops = clip.place < utterance.places.size() && utterance.places[clip.place].pause_before >= kFullStop;
      if (stops && frames.begin < clip.at.begin && clip.at.begin <= frames.end) return true;
    }
    return false;
  }

  const Synthesis& made_;
  const std::vector<MotionClip>& clips_;
  const ChannelParts& parts_;
  const SignerRig& rig_;
  HandMeter meter_;
  std::map<const MotionClip*, BothHands> captured_;
  std::vector<Notice> notices_;
};

}  // namespace

std::vector<Notice> lint_channels(const Synthesis& made, const std::vector<MotionClip>& clips,
                                  const ChannelParts& parts, const SignerRig& rig, const Utterance* utterance) {
  if (parts.empty() || !rig.signer.body) return {};
  ChannelLint lint(made, clips, parts, rig);
  for (std::size_t i = 0; i < parts.clips.size(); ++i) {
    const ChannelClip& part = parts.clips[i];
    // Signs of a tier of its own are what the signer did.
    if (part.clip.continues || (i + 1 < parts.clips.size() && parts.clips[i + 1].clip.continues)) continue;
    if (!part.clip.at_rest) lint.examine(i);
    lint.dropped(part.channel, part.first, part.last);
  }
  for (const ChannelHold& held : parts.holds) lint.dropped(held.channel, held.from + 1, held.until);
  lint.long_holds(utterance);
  return lint.take();
}

}  // namespace signweave
