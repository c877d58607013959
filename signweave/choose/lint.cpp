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
#include "signweave/notation/utterance.h"
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
  ChannelLint(const ComposedChannels& made, const SignerRig& rig)
      : made_(made), rig_(rig), meter_(made.motion.skeleton(), rig.signer) {}

  std::vector<Notice> take() { return std::move(notices_); }

  bool is_fixed(std::size_t clip) const noexcept {
    return made_.before != nullptr && clip < made_.before->fixed.size() && made_.before->fixed[clip];
  }

  /// The strokes of a part's clip against those of the whole body at the same time.
  void examine(std::size_t part) {
    const std::size_t own = made_.body + part;
    const std::optional<Side> side = side_of_arm(made_.parts.clips[part].channel);
    if (!side) return;
    const FrameRange at = made_.score.clips[own].at;
    const std::int64_t end = made_.first + made_.motion.frame_count();
    for (std::size_t i = 0; i < made_.body; ++i) {
      if (is_fixed(own) && is_fixed(i)) continue;
      const FrameRange theirs = made_.score.clips[i].at;
      const FrameRange common{std::max({at.begin, theirs.begin, made_.first}), std::min({at.end, theirs.end, end})};
      const auto least = static_cast<std::int64_t>(kLeastCommon.count() * made_.score.rate.hertz());
      if (common.end - common.begin < least) continue;
      if (!has_hands()) continue;
      const FrameRange frames{common.begin - made_.first, common.end - made_.first};
      const BothHands both = both_hands(meter_, *rig_.signer.body, made_.motion, frames);
      shapes(made_.clips[own], made_.clips[i], *side, frames, both.movement);
      collision(made_.clips[own], made_.clips[i], *side, both.meeting);
    }
  }

  /// What a channel leaves out of the signs of the whole body, from one clip to another.
  void dropped(Channel channel, std::size_t first, std::size_t last) {
    const std::optional<Side> side = side_of_arm(channel);
    if (!side || !has_hands()) return;
    for (std::size_t i = first; i <= last; ++i) {
      const bool touch = captured(made_.clips[i]).movement.contact;
      if (!touch && !alternates(made_.clips[i])) continue;
      add("weak_drop", fmt::format("the {} hand does something else in {}, in which both hands {}", name_of(channel),
                                   quoted_name(made_.clips[i]), touch ? "touch" : "alternate"));
    }
  }

  void long_holds() {
    for (const Lane& lane : made_.score.lanes) {
      if (lane.channel == Channel::body || lane.channel == Channel::tracks) continue;
      for (std::size_t i = 0; i < lane.items.size(); ++i) {
        const auto* const held = std::get_if<Hold>(&lane.items[i].what);
        if (held == nullptr || lane.items[i].at.begin == 0 || made_.score.clips[held->clip].at_rest) continue;
        if (is_held_with_parent(lane.channel, lane.items[i])) continue;
        FrameRange at = lane.items[i].at;
        if (at.end == made_.score.frames) {
          if (!is_held_to_the_end(lane.channel)) continue;
          at.end = made_.score.clips[made_.body - 1].at.end;
        } else if (is_fixed(clip_after(lane, i))) {
          continue;
        }
        const LongHold why = why_too_long(at);
        if (why == LongHold::no) continue;
        const std::int64_t known = std::min(at.end, known_end(lane.channel, held->clip));
        if (why_too_long({at.begin, known}) != LongHold::no) continue;
        const Clip& clip = made_.score.clips[held->clip];
        const std::string what = clip.signs.empty() ? "a piece" : printable(clip.signs.back().gloss);
        if (why == LongHold::seconds) {
          add("long_hold", fmt::format("'{}' is held for {:.1f} s in the lane '{}'; holds of signers are rarely longer "
                                       "than {:.0f} s",
                                       what, seconds_of(at), name_of(lane.channel), kLongHold.count()));
        } else {
          add("long_hold",
              fmt::format("'{}' is held across a full stop in the lane '{}'", what, name_of(lane.channel)));
        }
      }
    }
  }

 private:
  enum class LongHold { no, seconds, stop };

  double seconds_of(FrameRange frames) const noexcept {
    return static_cast<double>(std::max<std::int64_t>(frames.size(), 0)) / made_.score.rate.hertz();
  }

  void add(std::string code, std::string text) {
    Notice notice{"channels", std::move(text), {}, std::move(code)};
    if (std::ranges::find(notices_, notice) == notices_.end()) notices_.push_back(std::move(notice));
  }

  bool has_hands() const noexcept { return meter_.has(Side::left) && meter_.has(Side::right); }

  void shapes(const MotionClip& own, const MotionClip& body, Side side, FrameRange frames, const TwoHanded& movement) {
    if (!meter_.has_fingers(Side::left) || !meter_.has_fingers(Side::right)) return;
    const auto slot = static_cast<std::size_t>(side);
    const std::array<Handshape, 2> shapes = handshapes(made_.motion, rig_.signer, frames.begin + frames.size() / 2);
    if (!handshapes_differ(shapes[0], shapes[1])) return;
    if (both_move(movement)) {
      add("symmetry", fmt::format("{} and {} move at the same time with different handshapes", quoted_name(own),
                                  quoted_name(body)));
      return;
    }
    const float own_speed = movement.palms[slot].mean_speed;
    const float other_speed = movement.palms[1 - slot].mean_speed;
    const bool own_is_held = own_speed < kStillPalm && other_speed > kMovingPalm;
    if (own_is_held && !is_unmarked(shapes[slot])) {
      add("dominance", fmt::format("the held hand of {} beside {} has a marked handshape of its own", quoted_name(own),
                                   quoted_name(body)));
    }
  }

  void collision(const MotionClip& own, const MotionClip& body, Side side, const HandsMeeting& made) {
    if (!why_hands_collide(made, {})) return;  // not even if their captures kept them apart
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

  /// The clip that a lane shows after an item.
  static std::size_t clip_after(const Lane& lane, std::size_t item) {
    while (++item < lane.items.size()) {
      if (const auto* const use = std::get_if<ClipUse>(&lane.items[item].what)) return use->clip;
    }
    return static_cast<std::size_t>(-1);
  }
  /// True if the part that contains a channel holds the same: fingers with their hand.
  bool is_held_with_parent(Channel channel, const Item& held) const {
    const std::optional<Channel> parent = parent_of(channel);
    return parent && std::ranges::any_of(lane_of(made_.score, *parent)->items, [&](const Item& item) {
             const auto* const theirs = std::get_if<Hold>(&item.what);
             return theirs != nullptr && theirs->clip == std::get<Hold>(held.what).clip &&
                    item.at.begin == held.at.begin;
           });
  }
  bool is_held_to_the_end(Channel channel) const {
    return std::ranges::any_of(made_.parts.holds, [&](const ChannelHold& held) {
      return held.until + 1 == made_.body && (held.channel == channel || held.channel == parent_of(channel));
    });
  }
  /// Until when a pose was known to be held when its clip was examined.
  std::int64_t known_end(Channel channel, ClipId clip) const {
    if (made_.before == nullptr) return 0;
    for (const ChannelStart& start : made_.before->starts) {
      if (start.channel != channel && start.channel != parent_of(channel)) continue;
      for (const ChannelLink& link : start.links) {
        if (link.clip == clip && link.held_until) return made_.score.clips[*link.held_until].at.end;
      }
    }
    return 0;
  }
  /// Why a pose should not be held for these frames.
  LongHold why_too_long(FrameRange frames) const {
    if (seconds_of(frames) > kLongHold.count()) return LongHold::seconds;
    for (std::size_t i = 0; i < made_.body; ++i) {
      const std::int64_t begin = made_.score.clips[i].at.begin;
      const bool stops = made_.clips[i].pause_before >= kFullStop;
      if (stops && frames.begin < begin && begin <= frames.end) return LongHold::stop;
    }
    return LongHold::no;
  }

  const ComposedChannels& made_;
  const SignerRig& rig_;
  HandMeter meter_;
  std::map<const MotionClip*, BothHands> captured_;
  std::vector<Notice> notices_;
};

}  // namespace

std::vector<Notice> lint_channels(const ComposedChannels& made, const SignerRig& rig) {
  const bool is_whole_body = made.parts.empty() && (made.before == nullptr || made.before->starts.empty());
  if (is_whole_body || !rig.signer.body) return {};
  ChannelLint lint(made, rig);
  for (std::size_t i = 0; i < made.parts.clips.size(); ++i) {
    const ChannelClip& part = made.parts.clips[i];
    const std::size_t clip = made.body + i;
    // Signs of a tier of its own are what the signer did.
    if (made.clips[clip].continues || (clip + 1 < made.clips.size() && made.clips[clip + 1].continues)) continue;
    if (!made.clips[clip].at_rest) lint.examine(i);
    if (!lint.is_fixed(clip)) lint.dropped(part.channel, part.first, part.last);
  }
  for (const ChannelHold& held : made.parts.holds) lint.dropped(held.channel, held.from + 1, held.until);
  lint.long_holds();
  return lint.take();
}

void refuse(const std::vector<Notice>& found) {
  if (found.empty()) return;
  throw Error(ErrorCode::bad_input, fmt::format("{} ({})", found.front().text, found.front().code),
              {{"strict", "false"}});
}

}  // namespace signweave
