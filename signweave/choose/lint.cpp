#include "signweave/choose/lint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "signweave/core/text.h"
#include "signweave/features/hand_motion.h"
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
  TwoHanded movement;
  std::array<Handshape, 2> shapes;  ///< [Side] in the middle
  bool have_fingers = false;
};
std::optional<BothHands> both_hands(const Motion& motion, const SignerModel& signer, FrameRange frames) {
  const HandMotion measured = measure_hands(motion, signer, frames);
  std::array<PointTrack, 2> palms;
  BothHands both;
  both.have_fingers = true;
  for (std::size_t side = 0; side < 2; ++side) {
    const HandMotion::OneHand& hand = measured.hands[side];
    if (hand.frames.empty()) return std::nullopt;
    for (const HandFrame& frame : hand.frames) palms[side].push_back(point_of(frame));
    both.shapes[side] = hand.frames[hand.frames.size() / 2].handshape;
    both.have_fingers = both.have_fingers && hand.why_no_fingers.empty();
  }
  TwoHandedSum sum;
  sum.add(palms[0], palms[1]);
  both.movement = sum.movement();
  return both;
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
      shapes(own, clips_[i], *side, common);
      collision(own.clip, clips_[i], *side, common);
    }
  }

  /// What a channel leaves out of the signs of the whole body, from one clip to another.
  void dropped(Channel channel, std::size_t first, std::size_t last) {
    const std::optional<Side> side = side_of_arm(channel);
    if (!side) return;
    for (std::size_t i = first; i <= last; ++i) {
      const std::optional<BothHands> both = captured(clips_[i]);
      if (!both) continue;
      const std::optional<Hands> hands = class_of(both->movement, *rig_.signer.body);
      if (hands == Hands::one || (!both->movement.contact && hands != Hands::alternating)) continue;
      add("weak_drop", fmt::format("the {} hand does something else in {}, in which both hands {}", name_of(channel),
                                   quoted_name(clips_[i]), both->movement.contact ? "touch" : "alternate"));
    }
  }

  void long_holds(const Utterance* utterance) {
    for (const Lane& lane : made_.score.lanes) {
      if (lane.channel == Channel::body || lane.channel == Channel::tracks) continue;
      for (const Item& item : lane.items) {
        const auto* const held = std::get_if<Hold>(&item.what);
        if (held == nullptr || item.at.begin == 0 || item.at.end == made_.score.frames) continue;
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

  void shapes(const ChannelClip& own, const MotionClip& body, Side side, FrameRange common) {
    const std::optional<BothHands> both = both_hands(made_.motion, rig_.signer, common);
    if (!both || !both->have_fingers) return;
    const auto slot = static_cast<std::size_t>(side);
    if (!handshapes_differ(both->shapes[0], both->shapes[1])) return;
    if (both_move(both->movement)) {
      add("symmetry", fmt::format("{} and {} move at the same time with different handshapes", quoted_name(own.clip),
                                  quoted_name(body)));
      return;
    }
    const float own_speed = both->movement.palms[slot].mean_speed;
    const float other_speed = both->movement.palms[1 - slot].mean_speed;
    const bool own_is_held = own_speed < kStillPalm && other_speed > kMovingPalm;
    if (own_is_held && !is_unmarked(both->shapes[slot])) {
      add("dominance", fmt::format("the held hand of {} beside {} has a marked handshape of its own",
                                   quoted_name(own.clip), quoted_name(body)));
    }
  }

  void collision(const MotionClip& own, const MotionClip& body, Side side, FrameRange common) {
    if (!meter_.has(Side::left) || !meter_.has(Side::right)) return;
    const HandsMeeting made = meter_.meeting(view_of(made_.motion, common));
    const std::array<HandsMeeting, 2> captured = {meeting_in(own), meeting_in(body)};
    if (const std::optional<std::string> why = why_hands_collide(made, captured)) {
      add("collision", fmt::format("{} of the {} hand and {}: {}", quoted_name(own),
                                   side == Side::left ? "left" : "right", quoted_name(body), *why));
    }
  }

  Motion core_of(const MotionClip& clip) const {
    const std::int64_t frames = std::min<std::int64_t>(clip.core.size(), kBodyFrames);
    Motion core(clip.source->skeleton(), clip.source->rate(), frames);
    clip.source->read({clip.core.begin, clip.core.begin + frames}, core.poses({0, frames}));
    return core;
  }
  HandsMeeting meeting_in(const MotionClip& clip) {
    const Motion core = core_of(clip);
    return meter_.meeting(view_of(core, {0, core.frame_count()}));
  }
  std::optional<BothHands> captured(const MotionClip& clip) const {
    const Motion core = core_of(clip);
    return both_hands(core, rig_.signer, {0, core.frame_count()});
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
    lint.examine(i);
    lint.dropped(part.channel, part.first, part.last);
  }
  for (const ChannelHold& held : parts.holds) lint.dropped(held.channel, held.from + 1, held.until);
  lint.long_holds(utterance);
  return lint.take();
}

}  // namespace signweave
