#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "signweave/transition/method.h"

namespace signweave {

// The paper, section 4.2, Algorithm 1. Between the last stroke frame of one sign and the first stroke frame of the next
// lie `length` frames. The first `retraction_frames` (m_i) of the retraction R_i and the last `preparation_frames`
// (m_j) of the preparation P_j are kept; `blend_frames` (p) is the context on either side from which the rest is
// interpolated.

/// What of the body has cut points of its own. The length of the transition is one for all. (ours)
enum class Timed : std::uint8_t {
  body = 0,   ///< root, trunk, head, legs; of a rig whose hands are not known all of it
  left = 1,   ///< arm and fingers
  right = 2,  ///< arm and fingers
};
inline constexpr std::size_t kTimed = 3;
inline constexpr std::array<Timed, kTimed> kAllTimed = {Timed::body, Timed::left, Timed::right};
std::string_view name_of(Timed part) noexcept;
GroupSet groups_of(Timed part) noexcept;
Timed timed_of(JointGroup group) noexcept;

/// How a transition is cut.
struct TransitionCut {
  std::int64_t length = 0;              ///< frames between the two strokes
  std::int64_t retraction_frames = 0;   ///< m_i
  std::int64_t preparation_frames = 0;  ///< m_j
  std::int64_t blend_frames = 0;        ///< p
  std::int64_t pause_frames = 0;        ///< of the gap, in which nothing moves
  bool waits = false;                   ///< both borders of the gap are one pose, at rest: nothing need move in it

  /// Frames that neither side gives: they are made from nothing but their borders. Where it is positive nothing
  /// overlaps.
  std::int64_t gap() const noexcept {
    const std::int64_t missing = length - retraction_frames - preparation_frames;
    return missing > 0 ? missing : 0;
  }
  /// Frames in which both sides are cross-faded.
  std::int64_t overlap() const noexcept {
    const std::int64_t both = retraction_frames + preparation_frames - length;
    return both > 0 ? both : 0;
  }
  /// Frames that are as captured, after the stroke before and before the stroke after.
  std::int64_t kept_after() const noexcept { return retraction_frames - overlap(); }
  std::int64_t kept_before() const noexcept { return preparation_frames - overlap(); }
  friend bool operator==(const TransitionCut&, const TransitionCut&) = default;
};

/// How each part is cut, [Timed]; all have one length.
using TransitionCuts = std::array<TransitionCut, kTimed>;

/// What is kept of all parts together.
TransitionCut common_to(const TransitionCuts& cuts) noexcept;

/// What there is to cut from, in output frames.
struct TransitionRoom {
  std::int64_t length = 0;       ///< frames that the timing model asks for
  std::int64_t retraction = 0;   ///< frames of R_i that were captured
  std::int64_t preparation = 0;  ///< frames of P_j that were captured
  double frames_per_second = 30;
  bool pause = false;             ///< a pause lies between: keep all that was captured of the way to rest and back
  std::int64_t pause_frames = 0;  ///< how much of the length it is
};

/// One way to make a transition: how it is cut, and how a gap in it is filled. `name` is what a user types.
struct TransitionMethod {
  std::string_view name;
  std::string_view description;  ///< one line
  /// Chooses m_i, m_j and p so that the whole transition has the length asked for, the same for all parts. Null: the
  /// cut points are chosen for each part from the frames, see CutChooser.
  TransitionCut (*cut)(const TransitionRoom& room) = nullptr;
  const GapMethod* fill = nullptr;  ///< never null in the table
};

/// Every method, the default first: the paper's two readings, and every GapMethod that is offered for signing, with cut
/// points of its own. To add one, add a GapMethod.
std::span<const TransitionMethod> transition_methods();
/// The method of this name, or null.
const TransitionMethod* find_transition_method(std::string_view name);

/// Keeps at most two thirds of the transition, shared out as captured: where a pause lies between, all that was
/// captured of the way to rest and back. The rest is a gap.
TransitionCut cut_with_gap(const TransitionRoom& room) noexcept;

/// Weight of the second side for cross-faded frame `index` of `count`: rises from above 0 to below 1, slow at both
/// ends.
float crossfade_weight(std::int64_t index, std::int64_t count) noexcept;

/// A number in a gap, such as that of a scalar track: goes from where it was to where it will be, by that weight.
void go_over(float from, float to, std::span<float> values) noexcept;

}  // namespace signweave
