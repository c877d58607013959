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

/// What will be signed, by which captured frames, and when: one plain value between meaning and motion. It holds no
/// frames.
namespace signweave {

/// Where captured frames come from, as a score names it.
struct SourceRef {
  enum class Kind : std::uint8_t {
    recording,  ///< frames of a recording
    rest,       ///< the signer of a recording at rest, as a player shows it: frame 0 is the rest pose
    shown,      ///< frames that a stream showed before the score begins, which alone its player knew
  };
  Kind kind = Kind::recording;
  std::string recording;          ///< empty of `shown`
  std::uint64_t fingerprint = 0;  ///< checksum of its motion file; 0: not known, as of a motion that was made in memory
  friend bool operator==(const SourceRef&, const SourceRef&) = default;
};

/// The number of a clip in its score, from 0. It stays the same wherever the clip is reported.
using ClipId = std::uint32_t;

/// Captured frames of one recording.
struct Clip {
  ClipId id = 0;
  std::size_t place = 0;  ///< of what was asked for, from 0: the first one that the clip is of
  SourceRef source;
  FrameRange
      whole;        ///< recording frames that may be shown: the core with the first preparation and the last retraction
  FrameRange core;  ///< recording frames that are kept as they are; inside `whole`, not empty
  double step = 1;  ///< recording frames per output frame; positive
  FrameRange at;    ///< output frames of the core; not empty
  std::optional<GroundTransform> standing;  ///< how it is brought to where the signer stands; none: it is there
  FrameClock clock;                         ///< of the recording
  std::vector<Sign> signs;                  ///< that it holds, in the recording's annotation time
  std::vector<std::size_t> sign_places;     ///< [sign] the place that it is of
  friend bool operator==(const Clip&, const Clip&) = default;
};

/// A clip in a lane.
struct ClipUse {
  ClipId clip = 0;
  friend bool operator==(const ClipUse&, const ClipUse&) = default;
};

/// Between two clips in a lane: frames that are made, or in which both are cross-faded.
struct Transition {
  ClipId from = 0;
  ClipId to = 0;
  TransitionCut cut;
  friend bool operator==(const Transition&, const Transition&) = default;
};

struct Item {
  std::variant<ClipUse, Transition> what;
  FrameRange at;  ///< output frames; empty of a transition in which two clips meet
  friend bool operator==(const Item&, const Item&) = default;
};

/// What is controlled by itself.
enum class Channel : std::uint8_t {
  body,    ///< root, trunk, head, legs; of a rig whose hands are not known all of it
  left,    ///< arm and fingers
  right,   ///< arm and fingers
  tracks,  ///< scalar tracks, such as those of a face
};
inline constexpr std::array kChannels = {Channel::body, Channel::left, Channel::right, Channel::tracks};
std::string_view name_of(Channel channel) noexcept;
std::string_view name_of(SourceRef::Kind kind) noexcept;

/// One channel over all of the output: items without a hole and without an overlap. Clips and transitions take turns.
struct Lane {
  Channel channel = Channel::body;
  std::vector<Item> items;
  friend bool operator==(const Lane&, const Lane&) = default;
};

/// How the junction between two clips is made, whatever the lanes.
struct JunctionRef {
  std::size_t number = 1;  ///< by which it is named: 1 is where the first two places meet
  std::string method;      ///< that makes its frames
  std::string chosen;      ///< what was asked for it alone, see JunctionChoice; empty: nothing
  friend bool operator==(const JunctionRef&, const JunctionRef&) = default;
};

struct Score {
  SourceRef skeleton;  ///< the recording whose joints the output has
  FrameRate rate;
  std::int64_t frames = 0;             ///< of the output
  std::vector<Clip> clips;             ///< in the order of the utterance; [ClipId]
  std::vector<JunctionRef> junctions;  ///< [clip − 1]
  std::vector<Lane> lanes;             ///< [Channel]
  friend bool operator==(const Score&, const Score&) = default;
};

/// A day of signing at a hundred frames a second. Frame rates come from files: a wrong one must not ask for a terabyte.
inline constexpr std::int64_t kMostFrames = std::int64_t{24} * 60 * 60 * 100;

/// Throws Error{bad_input, "WHERE: what is wrong, what would mend it"} where a score cannot be rendered, whatever the
/// recordings: numbers out of range, lanes with holes, clips that are not in order.
void check(const Score& score, const std::string& where);

/// A line for each clip and each junction, for people.
std::string to_string(const Score& score);

}  // namespace signweave
