#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/score/transition.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// The frames at one side of a transition.
struct CutSide {
  PosesView frames;         ///< with the stroke's frames next to the border, as context
  std::int64_t stroke = 0;  ///< index of the stroke's frame at the border
};

/// Chooses cut points m_i and m_j from pose and velocity at the cut and the time that the timing model leaves. (ours)
/// The pair is taken whose sum is least of
///
///     detour   (kept way of R_i + way over the gap + kept way of P_j − D) / (D + e), D the straight way from stroke to
///              stroke, e = kStillness times the root of the number of joints: a retraction is kept as far as it leads
///              on, not where the hand goes down and up again
///     turning  kTurning · ln(1 + E / E₀), E the integral of the squared acceleration of the cubic that goes on from
///              pose and velocity on both sides of the gap, E₀ that from rest to rest: what velocities that lead
///              elsewhere cost, and those that lead on spare
///     hurry    ln(time that the gap's way asks for / time of the gap) where that is positive. The time asked for is
///              that of the whole transition times the kHurryPower-th power of the ways' ratio, as in duration_of
///     making   kMaking · share of the transition that is made: what is captured is better
///
/// /// Poses are compared as rotations weighted with the reach of each joint, in metres, without the root: alignment
/// brings it to where it belongs. Used for many junctions it allocates for the first ones only.
class CutChooser {
 public:
  CutChooser(const Skeleton& skeleton, const JointGroups& groups);

  /// `from` ends, and `to` begins, with what was captured of retraction and preparation (both may have more frames than
  /// can be kept). Each part's gap has at least a tenth of a second, or the whole transition. In a pause a part keeps
  /// all of its way to rest and back (`cut_with_gap`) where the two meet: one that was captured on its way elsewhere
  /// would rise from rest to sink again.
  TransitionCuts choose(const TransitionRoom& room, const CutSide& from, const CutSide& to);

  static constexpr double kTurning = 0.3;
  static constexpr double kHurryPower = 0.6;
  static constexpr double kMaking = 0.8;
  static constexpr double kStillness = 0.015;  ///< metres
  /// A hand whose gap goes no farther than this, between borders slower than that, waits.
  static constexpr float kWaitingWay = 0.01f;    ///< metres
  static constexpr float kWaitingSpeed = 0.05f;  ///< metres a second
  static constexpr int kMostPoints = 10;         ///< cut points that are looked at on each side

 private:
  struct Weighted {
    std::size_t joint = 0;
    float reach = 0;  ///< metres
  };
  /// Cut points of one side of one part.
  struct Points {
    std::vector<std::int64_t> kept;  ///< frames
    Eigen::MatrixXf states;          ///< columns: positions of all points, then velocities; metres, metres a second
    std::vector<double> way;         ///< along what is kept, metres
  };
  void look(const std::vector<Weighted>& joints, const CutSide& side, int direction, std::int64_t most,
            const TransitionRoom& room, Points& out);
  void look_at_both(const std::vector<Weighted>& joints, const TransitionRoom& room, const CutSide& from,
                    const CutSide& to, std::int64_t most_after, std::int64_t most_before);
  /// True where what is kept by `cut` leads to one place from both sides, as to rest and back.
  bool meets(const std::vector<Weighted>& joints, const TransitionRoom& room, const TransitionCut& cut,
             const CutSide& from, const CutSide& to);
  TransitionCut choose(const std::vector<Weighted>& joints, const TransitionRoom& room, const CutSide& from,
                       const CutSide& to);

  std::array<std::vector<Weighted>, kTimed> joints_;
  Points left_, right_;
  Eigen::MatrixXf products_;
  /// Of the states at one point: place by place, place by velocity, velocity by velocity.
  struct Squares {
    float place;
    float both;
    float speed;
  };
  std::vector<Squares> ends_;  ///< [point of the right side]
  std::vector<float> signs_;   ///< [joint of the part] that brings `to` into the hemisphere of `from`
};

}  // namespace signweave
