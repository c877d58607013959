#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"
#include "signweave/motion/blend.h"
#include "signweave/nonmanual/curve.h"
#include "signweave/score/hand_place.h"
#include "signweave/score/transition.h"
#include "signweave/space/stroke_change.h"

/// A score says what is signed, with which captured frames, and when: a plain value between the request and the motion.
/// It contains no frames.
namespace signweave {

/// The source of captured frames, as stored in a score.
struct SourceRef {
  enum class Kind : std::uint8_t {
    recording,  ///< frames of a recording
    rest,       ///< a recording's signer at rest, as shown by a player; frame 0 is the rest pose
    shown,      ///< frames that a stream showed before the score begins, known only to its player
  };
  Kind kind = Kind::recording;
  std::string recording;          ///< empty for `shown`
  std::uint64_t fingerprint = 0;  ///< checksum of its motion file; 0: unknown, such as for a motion created in memory
  friend bool operator==(const SourceRef&, const SourceRef&) = default;
};

/// The number of a clip in its score, from 0. Reports refer to the clip by this number.
using ClipId = std::uint32_t;

/// Captured frames of one recording.
struct Clip {
  ClipId id = 0;
  std::size_t place = 0;  ///< the first place of the request that the clip fills, from 0
  SourceRef source;
  FrameRange whole;  ///< recording frames that may be shown: core, first preparation and last retraction
  FrameRange core;   ///< recording frames that are never changed; inside `whole`, not empty
  double step = 1;   ///< recording frames per output frame; positive
  FrameRange at;     ///< output frames of the core; not empty
  std::optional<GroundTransform> standing;  ///< moves it to where the signer stands; none: not moved
  FrameClock clock;                         ///< of the recording
  std::vector<Sign> signs;                  ///< its signs, in the recording's annotation time
  std::vector<std::size_t> sign_places;     ///< [sign] the place that it fills
  bool mirrored = false;                    ///< shown with left and right exchanged; signs are as annotated
  bool at_rest = false;                     ///< a hand that rests; no signs
  /// Changes of its core in space, applied one after another to the captured frames: the only way in which the frames
  /// of a core are not those of its recording.
  std::vector<ClipChange> changes = {};
  friend bool operator==(const Clip&, const Clip&) = default;
};

/// A clip in a lane.
struct ClipUse {
  ClipId clip = 0;
  std::optional<HandPlace> place = {};  ///< in the lane of an arm: corrects the place of the hand
  friend bool operator==(const ClipUse&, const ClipUse&) = default;
};

/// A transition between two clips in a lane: generated or cross-faded frames.
struct Transition {
  ClipId from = 0;
  ClipId to = 0;
  TransitionCut cut;
  friend bool operator==(const Transition&, const Transition&) = default;
};

/// A pose that is kept: the last frame of the clip that is shown before it, or, at the begin of a lane, the first frame
/// of the clip that is shown after it.
struct Hold {
  ClipId clip = 0;
  friend bool operator==(const Hold&, const Hold&) = default;
};

struct Item {
  std::variant<ClipUse, Transition, Hold> what;
  FrameRange at;  ///< output frames; empty for a transition between adjacent clips
  friend bool operator==(const Item&, const Item&) = default;
};

/// A part of the signer with its own lane. The first four cover the signer and are in every score; the others are parts
/// of them, with a lane only where they show something else than their parent.
enum class Channel : std::uint8_t {
  body,           ///< root, trunk, head, legs; everything for a rig with unknown hands
  left,           ///< arm and fingers
  right,          ///< arm and fingers
  tracks,         ///< scalar tracks, such as those of a face
  left_fingers,   ///< part of `left`
  right_fingers,  ///< part of `right`
  head,           ///< neck and head, part of `body`
};
inline constexpr std::array kChannels = {Channel::body, Channel::left, Channel::right, Channel::tracks};
inline constexpr std::array kPartChannels = {Channel::left_fingers, Channel::right_fingers, Channel::head};
inline constexpr std::array kAllChannels = {Channel::body,   Channel::left,         Channel::right,
                                            Channel::tracks, Channel::left_fingers, Channel::right_fingers,
                                            Channel::head};
std::string_view name_of(Channel channel) noexcept;
std::optional<Channel> channel_named(std::string_view name) noexcept;
/// The channel that a part belongs to; none for the first four.
std::optional<Channel> parent_of(Channel channel) noexcept;
std::string_view name_of(SourceRef::Kind kind) noexcept;

/// One channel over the whole output: items without holes or overlaps. Clips and transitions alternate; a clip may be
/// held before its transition, at the begin of the lane and at its end.
struct Lane {
  Channel channel = Channel::body;
  std::vector<Item> items;
  friend bool operator==(const Lane&, const Lane&) = default;
};

/// Options of the junction before a clip, common to all lanes.
struct JunctionRef {
  std::size_t number = 1;  ///< number used to refer to it: 1 is between the first two places
  std::string method;      ///< method that generates its frames
  std::string chosen;      ///< options given for it alone, see JunctionChoice; empty: none
  friend bool operator==(const JunctionRef&, const JunctionRef&) = default;
};

/// An authored movement of face, gaze or head over captured motion.
struct AuthoredCurve {
  Curve curve;
  FrameRange at;          ///< output frames; not empty. It may begin before the output and end after it
  std::size_t first = 0;  ///< the first place that it accompanies, from 0
  std::size_t last = 0;   ///< inclusive
  friend bool operator==(const AuthoredCurve&, const AuthoredCurve&) = default;
};

struct Score {
  SourceRef skeleton;  ///< the recording that defines the output's joints
  FrameRate rate;
  std::int64_t frames = 0;  ///< of the output
  /// Those of the lane of the body, in the order of the utterance, then those that only other lanes show. [ClipId]
  std::vector<Clip> clips;
  std::vector<JunctionRef> junctions;  ///< [clip − 1]; not used if no transition leads to the clip
  std::vector<Lane> lanes;             ///< [Channel] of kChannels, then those of kPartChannels that differ
  /// Shown over what the lanes show: later ones over earlier ones, of which they may cover the same frames.
  std::vector<AuthoredCurve> curves;
  friend bool operator==(const Score&, const Score&) = default;
};

/// A day of signing at a hundred frames a second. Frame rates come from files; a wrong one must not allocate a
/// terabyte.
inline constexpr std::int64_t kMostFrames = std::int64_t{24} * 60 * 60 * 100;

/// The number of clips in the lane of the body: the first ones of the score. The others are of single channels.
std::size_t body_clips(const Score& score) noexcept;
/// The lane of a channel; null: it has none, and shows what its parent does.
const Lane* lane_of(const Score& score, Channel channel) noexcept;

/// Throws Error{bad_input, "WHERE: problem, how to fix it"} if a score cannot be rendered from any recordings: numbers
/// out of range, lanes with holes, clips out of order.
void check(const Score& score, const std::string& where);

/// Human-readable text with a line for each clip and each junction.
std::string to_string(const Score& score);

}  // namespace signweave
