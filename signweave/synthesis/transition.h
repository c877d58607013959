#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/transition_stats.h"
#include "signweave/motion/blend.h"
#include "signweave/motion/motion.h"

namespace signweave {

// The paper, section 4.2, Algorithm 1. Between the last stroke frame of one sign and the first stroke frame of the next
// lie `length` frames. The first `retraction_frames` (m_i) of the retraction R_i and the last `preparation_frames`
// (m_j) of the preparation P_j are kept; `blend_frames` (p) is the context on either side from which the rest is
// interpolated.

/// How a transition is cut.
struct TransitionCut {
  std::int64_t length = 0;              ///< frames between the two strokes
  std::int64_t retraction_frames = 0;   ///< m_i
  std::int64_t preparation_frames = 0;  ///< m_j
  std::int64_t blend_frames = 0;        ///< p

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
};

/// What there is to cut from, in output frames.
struct TransitionRoom {
  std::int64_t length = 0;       ///< frames that the timing model asks for
  std::int64_t retraction = 0;   ///< frames of R_i that were captured
  std::int64_t preparation = 0;  ///< frames of P_j that were captured
  double frames_per_second = 30;
  bool pause = false;  ///< a pause lies between: keep all that was captured of the way to rest and back
};

/// One way to fill the transition. `name` is what a user types.
struct TransitionMethod {
  std::string_view name;
  std::string_view description;  ///< one line
  /// Chooses m_i, m_j and p so that the whole transition has the length asked for.
  TransitionCut (*cut)(const TransitionRoom& room);
};

/// Every method, the default first. To add one, write its `cut` and a row here.
std::span<const TransitionMethod> transition_methods() noexcept;
/// The method of this name, or null.
const TransitionMethod* find_transition_method(std::string_view name) noexcept;

/// Weight of the second side for cross-faded frame `index` of `count`: rises from above 0 to below 1, slow at both
/// ends.
float crossfade_weight(std::int64_t index, std::int64_t count) noexcept;

/// One border of a gap: the pose there, and how it moves.
struct Border {
  PoseView pose;          ///< the last kept frame before the gap, or the first after it
  PoseView context;       ///< p frames away from the gap
  std::int64_t span = 0;  ///< p; 0: no context, the border counts as still
};

/// How long a border's movement takes to come to rest in a gap, seconds.
inline constexpr double kEaseSeconds = 0.15;

/// What lies in a gap. Each side goes on as it moved and comes to rest within `ease` frames; the two are cross-faded
/// over the whole gap with a weight that is flat at both ends. So position and velocity go on at both borders, and
/// however long the gap, nothing swings out farther than half of what `ease` frames of that movement are. (ours) Used
/// for many gaps it allocates for the first only.
class GapFiller {
 public:
  /// Between two borders lie `count` frames.
  void between(const Border& from, const Border& to, std::int64_t count, double ease);
  /// Fills `out` with frame `index`, from 0. Allocates nothing.
  void fill(std::int64_t index, MutablePoseView out) const noexcept;

 private:
  CoastingRotations from_, to_;                           ///< at the borders
  CoastingRotations from_rest_, to_rest_;                 ///< where they come to rest
  std::vector<Eigen::Quaternionf> signed_to_;             ///< [joint] the right border, in the left one's hemisphere
  std::vector<Eigen::Vector3f> from_turns_, to_turns_;    ///< [joint] rotation vector per frame, in the joint's space
  std::vector<Eigen::Vector3f> from_places_, to_places_;  ///< [translated joint] metres
  std::vector<Eigen::Vector3f> from_shifts_, to_shifts_;  ///< [translated joint] metres per frame
  std::int64_t count_ = 0;
  double ease_ = 1;
};

/// How long transitions last.
struct DurationModel {
  /// Given by the user; else the mean of the corpus (the paper, section 5.1).
  std::optional<Milliseconds> fixed;
};

/// For a corpus in which no transition was measured: half a second, reported wherever it is used. (ours)
inline constexpr Milliseconds kUnmeasuredTransition{500};

/// The duration of a transition.
Milliseconds transition_duration(const DurationModel& model, const TransitionStats& corpus) noexcept;

}  // namespace signweave
