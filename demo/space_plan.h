#pragma once

#include <array>
#include <vector>

#include "demo/arms.h"
#include "demo/space.h"

namespace signweave::demo {

/// Both hands and the yaw of the chest at every moment of a recording of aimed signs.
class SpacePlan {
 public:
  /// Borrows the timeline. `noise` scales the small movement that never stops.
  SpacePlan(const SpaceTimeline& timeline, Random& random, float noise);

  SignerHand at(Side side, double frame) const;
  /// Radians, to the signer's left.
  float yaw_at(double frame) const;
  /// The signs that begin at the mouth touch the chin there.
  std::vector<HandPlan::Touch> touches() const;
  Handshape handshape_at(Side side, double frame) const;

 private:
  /// One end of a piece: of a stroke, or a rest.
  struct End {
    const PlacedAimed* sign = nullptr;
    int stroke = 0;
    Rest rest = Rest::belly;
  };
  /// A stroke, a movement or a hold.
  struct Piece {
    double begin = 0, end = 0;  ///< frames
    End from, to;
    bool is_stroke() const noexcept { return from.sign != nullptr && from.sign == to.sign && from.stroke < to.stroke; }
  };
  struct Posture {
    AimedHand hand;
    Handshape shape;
  };
  struct Unrest {
    explicit Unrest(Random& random);
    std::array<Wander, 3> place, turn;
    std::array<Wander, kFingers> fingers;
  };

  std::vector<Piece> pieces_of(Side side) const;
  const Piece& piece_at(Side side, double frame) const;
  Posture posture(const End& end, Side side, float done) const;
  AimedHand hand_in(const Piece& piece, Side side, float done) const;

  const SpaceTimeline& timeline_;
  float noise_;
  std::array<std::vector<Piece>, 2> pieces_;
  std::array<Unrest, 2> unrest_;
  std::array<std::array<AimedHand, 2>, 2> rests_;  ///< [side][Rest]
};

}  // namespace signweave::demo
