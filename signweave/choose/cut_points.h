#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/score/transition.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// The frames on one side of a transition.
struct CutSide {
  PosesView frames;         ///< including the stroke's frames next to the border, as context
  std::int64_t stroke = 0;  ///< index of the stroke frame at the border
};

/// Chooses cut points m_i and m_j from pose and velocity at the cut and the available time. (ours) Takes the pair with
/// the least sum of
///
///     detour   (kept path of R_i + path over the gap + kept path of P_j − D) / (D + e), D the straight path
///              from stroke to stroke, e = kStillness times the root of the number of joints: a retraction is kept
///              while it leads to the next stroke, not where the hand goes down and up again
///     turning  kTurning · ln(1 + E / E₀), E the integral of the squared acceleration of the cubic that continues
///              pose and velocity on both sides of the gap, E₀ that from rest to rest: penalizes velocities that lead
///              elsewhere, rewards those that lead on
///     hurry    ln(time needed for the gap's path / time of the gap) if that is positive. The time needed is
///              that of the whole transition times the kHurryPower-th power of the paths' ratio, as in duration_of
///     making   kMaking · generated share of the transition: captured frames are preferred
///
/// Poses are compared as rotations weighted by the reach of each joint, in metres, without the root, which is aligned
/// separately. If used for many junctions, it allocates only for the first ones.
class CutChooser {
 public:
  CutChooser(const Skeleton& skeleton, const JointGroups& groups);

  /// `from` ends with the captured retraction, and `to` begins with the captured preparation (both may have more frames
  /// than can be kept). Each part's gap has at least a tenth of a second, or the whole transition. With a pause, a part
  /// keeps all of its path to rest and back (`cut_with_gap`) if the two ends meet: otherwise it would rise from rest
  /// only to sink again.
  TransitionCuts choose(const TransitionRoom& room, const CutSide& from, const CutSide& to);

  static constexpr double kTurning = 0.3;
  static constexpr double kHurryPower = 0.6;
  static constexpr double kMaking = 0.8;
  static constexpr double kStillness = 0.015;  ///< metres
  /// A hand waits if its gap is no longer than this, between borders slower than that.
  static constexpr float kWaitingPath = 0.01f;   ///< metres
  static constexpr float kWaitingSpeed = 0.05f;  ///< metres a second
  static constexpr int kMostPoints = 10;         ///< cut points evaluated on each side

 private:
  struct Weighted {
    std::size_t joint = 0;
    float reach = 0;  ///< metres
  };
  /// Cut points of one part on one side.
  struct Points {
    std::vector<std::int64_t> kept;  ///< frames
    Eigen::MatrixXf states;          ///< columns: positions of all points, then velocities; metres, metres a second
    std::vector<double> path;        ///< length of the kept path, metres
  };
  void look(const std::vector<Weighted>& joints, const CutSide& side, int direction, std::int64_t most,
            const TransitionRoom& room, Points& out);
  void look_at_both(const std::vector<Weighted>& joints, const TransitionRoom& room, const CutSide& from,
                    const CutSide& to, std::int64_t most_after, std::int64_t most_before);
  /// True if the frames kept by `cut` lead to the same pose from both sides, as to rest and back.
  bool meets(const std::vector<Weighted>& joints, const TransitionRoom& room, const TransitionCut& cut,
             const CutSide& from, const CutSide& to);
  TransitionCut choose(const std::vector<Weighted>& joints, const TransitionRoom& room, const CutSide& from,
                       const CutSide& to);

  std::array<std::vector<Weighted>, kTimed> joints_;
  Points left_, right_;
  Eigen::MatrixXf products_;
  /// Inner products of the state at one point: position·position, position·velocity, velocity·velocity.
  struct Squares {
    float place;
    float both;
    float speed;
  };
  std::vector<Squares> ends_;  ///< [point of the right side]
  std::vector<float> signs_;   ///< [joint of the part] sign that brings `to` into the hemisphere of `from`
};

}  // namespace signweave
