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

/// Parts of the body with their own cut points. The length of a transition is the same for all. (ours)
enum class Timed : std::uint8_t {
  body = 0,   ///< root, trunk, head, legs; everything for a rig with unknown hands
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
  std::int64_t pause_frames = 0;        ///< part of the gap in which nothing moves
  bool waits = false;                   ///< both borders of the gap are the same pose at rest, so no motion is needed

  /// Number of frames that neither side provides; they are generated. If it is positive, there is no overlap.
  std::int64_t gap() const noexcept {
    const std::int64_t missing = length - retraction_frames - preparation_frames;
    return missing > 0 ? missing : 0;
  }
  /// Number of frames in which both sides are cross-faded.
  std::int64_t overlap() const noexcept {
    const std::int64_t both = retraction_frames + preparation_frames - length;
    return both > 0 ? both : 0;
  }
  /// Numbers of frames shown as captured, after the first stroke and before the second.
  std::int64_t kept_after() const noexcept { return retraction_frames - overlap(); }
  std::int64_t kept_before() const noexcept { return preparation_frames - overlap(); }
  friend bool operator==(const TransitionCut&, const TransitionCut&) = default;
};

/// The cuts of the parts, [Timed]; all have the same length.
using TransitionCuts = std::array<TransitionCut, kTimed>;

/// The frames kept for all parts.
TransitionCut common_to(const TransitionCuts& cuts) noexcept;

/// The frames available for a transition, in output frames.
struct TransitionRoom {
  std::int64_t length = 0;       ///< frames requested by the timing model
  std::int64_t retraction = 0;   ///< captured frames of R_i
  std::int64_t preparation = 0;  ///< captured frames of P_j
  double frames_per_second = 30;
  bool pause = false;             ///< there is a pause: keep all captured motion to rest and back
  std::int64_t pause_frames = 0;  ///< its share of `length`
};

/// A method of making a transition: how it is cut, and how its gap is filled. `name` is what a user types.
struct TransitionMethod {
  std::string_view name;
  std::string_view description;  ///< one line
  /// Chooses m_i, m_j and p so that the whole transition has the requested length, the same for all parts. Null: the
  /// cut points of each part are chosen from the frames, see CutChooser.
  TransitionCut (*cut)(const TransitionRoom& room) = nullptr;
  const GapMethod* fill = nullptr;  ///< never null in the table
};

/// Every method, the default first: the two readings of the paper, and every GapMethod offered for signing, with its
/// own cut points. To add one, add a GapMethod.
std::span<const TransitionMethod> transition_methods();
/// The method of this name, or null.
const TransitionMethod* find_transition_method(std::string_view name);

/// Keeps at most two thirds of the transition, divided between the sides in proportion to their captured frames. With a
/// pause, keeps all captured motion to rest and back. The remainder is a gap.
TransitionCut cut_with_gap(const TransitionRoom& room) noexcept;

/// Weight of the second side for cross-faded frame `index` of `count`: rises smoothly from above 0 to below 1.
float crossfade_weight(std::int64_t index, std::int64_t count) noexcept;

/// Fills a gap of scalar values, such as a track's, by interpolating between its borders with crossfade_weight.
void go_over(float from, float to, std::span<float> values) noexcept;

}  // namespace signweave
