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
#include "signweave/score/transition.h"

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
  friend bool operator==(const Clip&, const Clip&) = default;
};

/// A clip in a lane.
struct ClipUse {
  ClipId clip = 0;
  friend bool operator==(const ClipUse&, const ClipUse&) = default;
};

/// A transition between two clips in a lane: generated or cross-faded frames.
struct Transition {
  ClipId from = 0;
  ClipId to = 0;
  TransitionCut cut;
  friend bool operator==(const Transition&, const Transition&) = default;
};

struct Item {
  std::variant<ClipUse, Transition> what;
  FrameRange at;  ///< output frames; empty for a transition between adjacent clips
  friend bool operator==(const Item&, const Item&) = default;
};

/// A part of the signer with its own lane.
enum class Channel : std::uint8_t {
  body,    ///< root, trunk, head, legs; everything for a rig with unknown hands
  left,    ///< arm and fingers
  right,   ///< arm and fingers
  tracks,  ///< scalar tracks, such as those of a face
};
inline constexpr std::array kChannels = {Channel::body, Channel::left, Channel::right, Channel::tracks};
std::string_view name_of(Channel channel) noexcept;
std::string_view name_of(SourceRef::Kind kind) noexcept;

/// One channel over the whole output: items without holes or overlaps. Clips and transitions alternate.
struct Lane {
  Channel channel = Channel::body;
  std::vector<Item> items;
  friend bool operator==(const Lane&, const Lane&) = default;
};

/// Options of the junction between two clips, common to all lanes.
struct JunctionRef {
  std::size_t number = 1;  ///< number used to refer to it: 1 is between the first two places
  std::string method;      ///< method that generates its frames
  std::string chosen;      ///< options given for it alone, see JunctionChoice; empty: none
  friend bool operator==(const JunctionRef&, const JunctionRef&) = default;
};

struct Score {
  SourceRef skeleton;  ///< the recording that defines the output's joints
  FrameRate rate;
  std::int64_t frames = 0;             ///< of the output
  std::vector<Clip> clips;             ///< in the order of the utterance; [ClipId]
  std::vector<JunctionRef> junctions;  ///< [clip − 1]
  std::vector<Lane> lanes;             ///< [Channel]
  friend bool operator==(const Score&, const Score&) = default;
};

/// A day of signing at a hundred frames a second. Frame rates come from files; a wrong one must not allocate a
/// terabyte.
inline constexpr std::int64_t kMostFrames = std::int64_t{24} * 60 * 60 * 100;

/// Throws Error{bad_input, "WHERE: problem, how to fix it"} if a score cannot be rendered from any recordings: numbers
/// out of range, lanes with holes, clips out of order.
void check(const Score& score, const std::string& where);

/// Human-readable text with a line for each clip and each junction.
std::string to_string(const Score& score);

}  // namespace signweave
