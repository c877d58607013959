#include <algorithm>
#include <cassert>

#include "demo/animate.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

Vector3f end_place(const SignShape* sign, Side side, float done) {
  return sign != nullptr && acts(*sign, side) ? stroke_place(*sign, side, done) : rest_place();
}

}  // namespace

WristPlan::WristPlan(const Script& script, const Timeline& timeline) : fps_(timeline.rate.hertz()), sink_(script.sink) {
  const auto add = [&](std::int64_t begin, std::int64_t end, const SignShape* from, const SignShape* to) {
    if (end > begin) {
      pieces_.push_back({.begin = static_cast<double>(begin), .end = static_cast<double>(end), .from = from, .to = to});
    }
  };
  std::int64_t at = 0;
  const SignShape* before = nullptr;  // whose retraction is under way
  for (std::size_t i = 0; i < timeline.signs.size(); ++i) {
    const PlacedSign& sign = timeline.signs[i];
    if (before == nullptr) {
      add(at, sign.begin, nullptr, nullptr);
      at = sign.begin;
    }
    add(at, sign.stroke_begin, before, sign.shape);
    if (at < sign.stroke_begin) {
      // The handshape forms in the preparation: it has left the old one when that begins, and is there a little before
      // the stroke.
      Piece& piece = pieces_.back();
      const double split = static_cast<double>(sign.begin - at) / static_cast<double>(sign.stroke_begin - at);
      piece.shape_begin = 0.7 * split;
      piece.shape_end = 1 - 0.12 * (1 - split);
    }
    add(sign.stroke_begin, sign.stroke_end, sign.shape, sign.shape);
    at = sign.stroke_end;
    before = sign.shape;
    const bool last = i + 1 == timeline.signs.size();
    if (last || timeline.signs[i + 1].begin > sign.end) {
      add(at, sign.end, sign.shape, nullptr);
      at = sign.end;
      before = nullptr;
    }
  }
  add(at, timeline.frames, nullptr, nullptr);
}

const WristPlan::Piece& WristPlan::piece_at(double frame) const {
  assert(!pieces_.empty());
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), frame,
                                      [](double value, const Piece& piece) { return value < piece.begin; });
  return after == pieces_.begin() ? pieces_.front() : *(after - 1);
}

double WristPlan::time_in(const Piece& piece, double frame) {
  return std::clamp((frame - piece.begin) / (piece.end - piece.begin), 0.0, 1.0);
}

double WristPlan::done_in(const Piece& piece, double frame) {
  const double t = time_in(piece, frame);
  return t * t * t * (10 + t * (6 * t - 15));  // minimum jerk (Flash and Hogan 1985)
}

Vector3f WristPlan::at(Side side, double frame) const {
  const Piece& piece = piece_at(frame);
  const auto done = static_cast<float>(done_in(piece, frame));
  if (piece.from == piece.to && piece.from != nullptr && acts(*piece.from, side)) {
    return to_model(stroke_place(*piece.from, side, done), side);
  }
  const Vector3f from = end_place(piece.from, side, 1);
  const Vector3f to = end_place(piece.to, side, 0);
  Vector3f place = from + done * (to - from);
  const float middle = 4 * done * (1 - done);        // 0 at both ends, where it neither starts nor stops the hand
  place.z() += 0.12f * middle * (to - from).norm();  // around the body, not through it
  const bool between = piece.from != nullptr && piece.to != nullptr && acts(*piece.from, side) && acts(*piece.to, side);
  if (between && piece.from != piece.to) {
    // A quick transition has no time to sink.
    const double seconds = (piece.end - piece.begin) / fps_;
    const auto depth = sink_ * static_cast<float>(std::clamp((seconds - 0.35) / 0.6, 0.0, 1.0));
    place += depth * middle * middle * (rest_place() - 0.5f * (from + to));
  }
  return to_model(place, side);
}

}  // namespace signweave::demo
