#pragma once

#include <array>
#include <vector>

#include "demo/script.h"

namespace signweave::demo {

/// Where both hands are meant to be at every moment: the plan, without the body's unrest. Metres, model space.
class HandPlan {
 public:
  /// The signs of `timeline` are borrowed; it must outlive the plan.
  HandPlan(const Script& script, const Timeline& timeline, Random& random);

  /// One end of a stretch.
  struct End {
    const PlacedSign* sign = nullptr;  ///< null: at rest
    int stroke = 0;                    ///< 0: where its stroke begins, 1: where it ends
    float let_go = 0;                  ///< how far a hand that holds has sunk towards rest, 0 to 1
    Rest rest = Rest::belly;
    bool operator==(const End&) const = default;
  };
  /// One stretch of a hand's plan: a stroke, a way from one place to another, or staying where it is.
  struct Piece {
    double begin = 0;  ///< frames
    double end = 0;
    End from, to;
    double shape_begin = 0;  ///< fractions of a way in which the handshape changes
    double shape_end = 1;
    double skew = 0;                                  ///< how much earlier than its middle a way is fastest
    double lag = 0;                                   ///< fraction by which the hand is behind in the middle
    Eigen::Vector3f bulge = Eigen::Vector3f::Zero();  ///< of the path's middle, metres
    float sink = 0;                                   ///< how far it sinks towards rest in the middle
    bool is_stroke() const noexcept { return from.sign != nullptr && from.sign == to.sign && from.stroke < to.stroke; }
  };

  const Piece& piece_at(Side side, double frame) const;
  /// Where in a piece a frame is: 0 to 1 by time, and how much of it is done (slow at both ends).
  static double time_in(const Piece& piece, double frame);
  static double done_in(const Piece& piece, double frame);

  Eigen::Vector3f at(Side side, double frame) const;
  /// How far the handshape has changed from the piece's begin to its end, 0 to 1 by time.
  static double shape_done(const Piece& piece, double frame);
  /// The handshape that a hand has, or is nearest to.
  Handshape shape_at(Side side, double frame) const;

 private:
  class Builder;
  std::array<std::vector<Piece>, 2> pieces_;  ///< [side]
};

/// The handshape at an end of a stretch.
Handshape shape_of(const HandPlan::End& end, Side side);

}  // namespace signweave::demo
