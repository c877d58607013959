#include "demo/plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace signweave::demo {
namespace {

using Eigen::Vector3f;
using Piece = HandPlan::Piece;
using End = HandPlan::End;

// Behaviour of a hand that is not used by the next signs, in seconds.
constexpr double kHoldsFor = 2.6;       ///< holds for up to this long if it is needed again
constexpr double kWaitsFor = 1.8;       ///< holds for up to this long until the sentence ends
constexpr double kDropsAfter = 0.25;    ///< otherwise drops after this long
constexpr double kDropsIn = 1.15;       ///< duration of the drop
constexpr double kRisesEarlier = 0.15;  ///< lead over the other hand when rising from rest
constexpr float kLetGo = 0.07f;         ///< how far a holding hand sinks

Vector3f place_of(const End& end, Side side) {
  Vector3f rest = rest_place(end.rest);
  if (end.sign == nullptr || !acts(*end.sign->shape, side)) return rest;
  const Vector3f place = stroke_place(*end.sign->shape, side, static_cast<float>(end.stroke), end.sign->token);
  return place + end.let_go * (rest - place);
}

bool keeps_moving(Movement movement) {
  return movement != Movement::straight && movement != Movement::arc;
}

/// An even pace with a quick, smooth start and stop.
double evenly(double t) {
  constexpr double kRamp = 0.22;
  if (t < kRamp) return t * t / (2 * kRamp * (1 - kRamp));
  if (t > 1 - kRamp) return 1 - (1 - t) * (1 - t) / (2 * kRamp * (1 - kRamp));
  return (t - 0.5 * kRamp) / (1 - kRamp);
}

}  // namespace

void shape_movement(Piece& piece, Side side, std::int64_t split, float sink, double frames_per_second, Random& random) {
  const Vector3f from_place = place_of(piece.from, side);
  const Vector3f to_place = place_of(piece.to, side);
  if (piece.to.sign != nullptr) {
    // The handshape changes during the preparation: the old one is released by its begin, and the new one is complete
    // slightly before the stroke.
    const double part = std::clamp((static_cast<double>(split) - piece.begin) / (piece.end - piece.begin), 0.0, 0.9);
    piece.shape_begin = 0.7 * part;
    piece.shape_end = 1 - 0.12 * (1 - part);
  }
  piece.skew = random.uniform(0.10, 0.34);
  // Around the body and outwards, never in a straight line.
  const Vector3f line = to_place - from_place;
  Vector3f across = line.cross(Vector3f::UnitZ());
  if (across.norm() > 0.25f * line.norm() && line.norm() > 0.01f) {
    across *= (across.x() < 0 ? -1.0f : 1.0f) / across.norm();
    piece.bulge = static_cast<float>(0.09 + 0.04 * random.normal()) * line.norm() * across;
  }
  piece.bulge.z() += 0.12f * line.norm();
  if (piece.from.sign != nullptr && piece.to.sign != nullptr) {
    // In a quick transition there is no time to sink.
    const double seconds = (piece.end - piece.begin) / frames_per_second;
    piece.sink = sink * static_cast<float>(std::clamp((seconds - 0.35) / 0.6, 0.0, 1.0) *
                                           std::clamp(1 + 0.2 * random.normal(), 0.6, 1.3));
  }
}

void PieceChain::add(double until, const End& to) {
  if (until > end_) {
    Piece piece{.begin = end_, .end = until, .from = now_, .to = to};
    if (side_ == Side::left && to.sign != nullptr)
      piece.lag = std::min(0.15, to.sign->token.lag * fps_ / (until - end_));
    pieces_.push_back(piece);
    end_ = until;
  }
  now_ = to;
}

/// Plans one hand over the signs of a timeline.
class HandPlan::Builder {
 public:
  Builder(const Script& script, const Timeline& timeline, Side side, Random& random)
      : script_(script),
        timeline_(timeline),
        side_(side),
        random_(random),
        fps_(timeline.rate.hertz()),
        chain_(side, fps_) {}

  std::vector<Piece> build() {
    for (std::size_t i = 0; i < timeline_.signs.size(); ++i) {
      const PlacedSign& sign = timeline_.signs[i];
      if (acts(*sign.shape, side_)) {
        const bool neighbour =
            chain_.now().sign != nullptr && chain_.now().sign + 1 == &sign && !ends_unit(timeline_, i - 1);
        if (!neighbour) wait(frame(sign.begin) - (side_ == Side::left ? kRisesEarlier * fps_ : 0), sign.begin);
        move_to(frame(sign.stroke_begin), {.sign = &sign}, sign.begin);
        chain_.add(frame(sign.stroke_end), {.sign = &sign, .stroke = 1});
      }
      if (ends_unit(timeline_, i)) finish(i);
    }
    chain_.add(frame(timeline_.frames), chain_.now());
    return chain_.take();
  }

 private:
  static double frame(std::int64_t frame) { return static_cast<double>(frame); }

  /// Adds a movement to another position. `split`: the frame in which the next sign begins.
  void move_to(double end, const End& to, std::int64_t split) {
    const double begin = chain_.end();
    chain_.add(end, to);
    if (begin != chain_.end()) shape_movement(chain_.last(), side_, split, script_.sink, fps_, random_);
  }

  /// Adds the behaviour of a hand until it is needed again: at the earliest at `until`, at the latest at `sign_begin`.
  void wait(double until, std::int64_t sign_begin) {
    until = std::max(until, chain_.end());
    if (chain_.now().sign != nullptr) {
      if (until - chain_.end() < kHoldsFor * fps_) {
        hold(until);
      } else {
        drop(until, sign_begin);
      }
    }
    chain_.add(until, chain_.now());
  }

  void hold(double until) {
    End held = chain_.now();
    held.let_go = kLetGo;
    chain_.add(std::min(chain_.end() + 0.4 * fps_, until), held);
    chain_.add(until, held);
  }

  void drop(double until, std::int64_t split) {
    chain_.add(std::min(chain_.end() + kDropsAfter * fps_, until), chain_.now());
    move_to(std::min(chain_.end() + kDropsIn * fps_, until), {.rest = rest_}, split);
  }

  /// Adds the end of a sentence whose last sign is number i.
  void finish(std::size_t i) {
    rest_ = i + 1 == timeline_.signs.size() ? Rest::hips : Rest::belly;
    const PlacedSign& last = timeline_.signs[i];
    const auto end = frame(last.end);
    if (chain_.now().sign == &last) {
      move_to(end, {.rest = rest_}, last.end);
    } else if (chain_.now().sign != nullptr) {
      if (frame(last.stroke_end) - chain_.end() < kWaitsFor * fps_) {
        hold(std::max(chain_.end(), frame(last.stroke_end)));
        move_to(std::max(end, chain_.end() + 0.5 * fps_), {.rest = rest_}, last.end);
      } else {
        drop(end, last.end);
      }
    } else if (chain_.now().rest != rest_) {
      move_to(std::max(end, chain_.end() + 0.7 * fps_), {.rest = rest_}, last.end);
    }
  }

  const Script& script_;
  const Timeline& timeline_;
  Side side_;
  Random& random_;
  double fps_;
  PieceChain chain_;
  Rest rest_ = Rest::belly;
};

HandPlan::HandPlan(const Script& script, const Timeline& timeline, Random& random) {
  for (const Side side : kSides) {
    content_.pieces[static_cast<std::size_t>(side)] = Builder(script, timeline, side, random).build();
  }
}

const Piece& HandPlan::piece_at(Side side, double frame) const {
  const std::vector<Piece>& pieces = content_.pieces[static_cast<std::size_t>(side)];
  assert(!pieces.empty());
  const auto after = std::upper_bound(pieces.begin(), pieces.end(), frame,
                                      [](double value, const Piece& piece) { return value < piece.begin; });
  return after == pieces.begin() ? pieces.front() : *(after - 1);
}

double HandPlan::time_in(const Piece& piece, double frame) {
  return std::clamp((frame - piece.begin) / (piece.end - piece.begin), 0.0, 1.0);
}

double HandPlan::done_in(const Piece& piece, double frame) {
  double t = time_in(piece, frame);
  t += (piece.skew - 4 * piece.lag) * t * (1 - t);
  if (piece.is_stroke() && keeps_moving(piece.from.sign->shape->movement)) {
    return evenly(t);
  }
  // A blend of the minimum-jerk curve (Flash and Hogan 1985), which dwells at both ends, and one with a quicker start
  // and stop.
  return 0.35 * t * t * t * (10 + t * (6 * t - 15)) + 0.65 * t * t * (3 - 2 * t);
}

Vector3f HandPlan::at(Side side, double frame) const {
  const Piece& piece = piece_at(side, frame);
  const auto done = static_cast<float>(done_in(piece, frame));
  if (piece.is_stroke() && acts(*piece.from.sign->shape, side)) {
    return to_model(stroke_place(*piece.from.sign->shape, side, done, piece.from.sign->token), side);
  }
  const Vector3f from = place_of(piece.from, side);
  const Vector3f to = place_of(piece.to, side);
  const float middle = 4 * done * (1 - done);  // 0 at both ends, so that it does not affect start and stop
  Vector3f place = from + done * (to - from) + middle * piece.bulge;
  place += piece.sink * middle * middle * (rest_place() - 0.5f * (from + to));
  return to_model(place, side);
}

double HandPlan::shape_done(const Piece& piece, double frame) {
  return std::clamp((time_in(piece, frame) - piece.shape_begin) / (piece.shape_end - piece.shape_begin), 0.0, 1.0);
}

Handshape HandPlan::shape_at(Side side, double frame) const {
  const Piece& piece = piece_at(side, frame);
  return shape_of(shape_done(piece, frame) < 0.5 ? piece.from : piece.to, side);
}

Handshape shape_of(const HandPlan::End& end, Side side) {
  if (end.sign == nullptr || !acts(*end.sign->shape, side)) return Handshape::relaxed;
  const SignShape& sign = *end.sign->shape;
  if (side == Side::left && sign.hands == Hands::on_base) return sign.base.shape;
  return end.stroke == 0 ? sign.shape : sign.shape_end.value_or(sign.shape);
}

}  // namespace signweave::demo
