#pragma once

#include <array>
#include <vector>

#include "demo/script.h"

namespace signweave::demo {

/// The intended positions of both hands at every moment: the plan, without the body's idle motion. Metres, model space.
class HandPlan {
 public:
  /// Borrows the signs of `timeline`, which must outlive the plan.
  HandPlan(const Script& script, const Timeline& timeline, Random& random);

  /// One end of a piece.
  struct End {
    const PlacedSign* sign = nullptr;  ///< null: at rest
    int stroke = 0;                    ///< 0: begin of its stroke, 1: end
    float let_go = 0;                  ///< how far a holding hand has sunk towards rest, 0 to 1
    Rest rest = Rest::belly;
    bool operator==(const End&) const = default;
  };
  /// One piece of a hand's plan: a stroke, a movement between two positions, or a hold.
  struct Piece {
    double begin = 0;  ///< frames
    double end = 0;
    End from, to;
    double shape_begin = 0;  ///< fractions of a movement between which the handshape changes
    double shape_end = 1;
    double skew = 0;                                  ///< how much earlier than its middle a movement is fastest
    double lag = 0;                                   ///< fraction by which the hand lags in the middle
    Eigen::Vector3f bulge = Eigen::Vector3f::Zero();  ///< of the path's middle, metres
    float sink = 0;                                   ///< how far it sinks towards rest in the middle
    bool is_stroke() const noexcept { return from.sign != nullptr && from.sign == to.sign && from.stroke < to.stroke; }
  };

  const Piece& piece_at(Side side, double frame) const;
  /// The position of a frame in a piece: 0 to 1 by time, and the fraction of the path done (slow at both ends).
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

/// The handshape at an end of a piece.
Handshape shape_of(const HandPlan::End& end, Side side);

}  // namespace signweave::demo
