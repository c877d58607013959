#pragma once

#include <array>
#include <span>
#include <utility>
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

  /// A time in which a hand is kept as it is: its joints stay constant relative to the chest. Frames.
  struct Stillness {
    double begin = 0, end = 0;
  };
  /// What a fingertip can touch.
  enum class Touchable { chin, chest, fingertip, mouth };
  /// A time in which a fingertip touches something. Frames.
  struct Touch {
    double begin = 0, end = 0;
    Side side = Side::right;
    int finger = 1;  ///< the one that touches, thumb 0
    Touchable what = Touchable::chin;
    int other_finger = 1;  ///< of the other hand, if a fingertip is touched
  };
  /// Everything that hands do, [side], in order; each hand's pieces must join end to end.
  struct Content {
    std::array<std::vector<Piece>, 2> pieces;
    std::array<std::vector<Stillness>, 2> still;
    std::vector<Touch> touches;
    float unrest = 1;  ///< scale of the movement of hands that are kept still
  };
  explicit HandPlan(Content content) : content_(std::move(content)) {}

  std::span<const Stillness> still(Side side) const { return content_.still[static_cast<std::size_t>(side)]; }
  std::span<const Touch> touches() const { return content_.touches; }
  float unrest() const noexcept { return content_.unrest; }

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
  Content content_;
};

/// Gives a movement between two positions its curve, its speed and the time in which the handshape changes. `split` is
/// the frame in which the next sign begins; between two signs the hand sinks by `sink` (Script::sink).
void shape_movement(HandPlan::Piece& piece, Side side, std::int64_t split, float sink, double frames_per_second,
                    Random& random);

/// The pieces of one hand, joined end to end from frame 0.
class PieceChain {
 public:
  PieceChain(Side side, double frames_per_second) : side_(side), fps_(frames_per_second) {}

  /// Adds a piece to another end, unless there is no time for it.
  void add(double until, const HandPlan::End& to);
  double end() const noexcept { return end_; }  ///< frame
  const HandPlan::End& now() const noexcept { return now_; }
  HandPlan::Piece& last() { return pieces_.back(); }
  std::vector<HandPlan::Piece> take() { return std::move(pieces_); }

 private:
  Side side_;
  double fps_;
  std::vector<HandPlan::Piece> pieces_;
  double end_ = 0;
  HandPlan::End now_ = {.rest = Rest::hips};
};

/// The handshape at an end of a piece.
Handshape shape_of(const HandPlan::End& end, Side side);

}  // namespace signweave::demo
