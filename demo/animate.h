#pragma once

#include "demo/script.h"
#include "demo/signer.h"
#include "signweave/motion/motion.h"

namespace signweave::demo {

/// Where a wrist is meant to be at a frame: the plan, without the body's unrest. Metres, model space.
class WristPlan {
 public:
  WristPlan(const Script& script, const Timeline& timeline);
  Eigen::Vector3f at(Side side, double frame) const;

  /// One stretch of the plan.
  struct Piece {
    double begin = 0;  ///< frames
    double end = 0;
    const SignShape* from = nullptr;  ///< null: the hand is at rest
    const SignShape* to = nullptr;    ///< the same as `from` in a stroke or a rest
    double shape_begin = 0;           ///< fractions of a transition in which the handshape changes
    double shape_end = 1;
  };
  const Piece& piece_at(double frame) const;
  /// Where in a piece a frame is: 0 to 1 by time, and how much of the way is done (minimum jerk).
  static double time_in(const Piece& piece, double frame);
  static double done_in(const Piece& piece, double frame);

 private:
  std::vector<Piece> pieces_;
  double fps_ = 100;
  float sink_ = 0;
};

/// Makes the motion of a timeline: arms by inverse kinematics to the plan's wrists, hands from handshape to handshape,
/// a body that breathes and sways a little on feet that stand.
Motion animate(const Signer& signer, const Script& script, const Timeline& timeline, Random& random);

}  // namespace signweave::demo
