#include <algorithm>
#include <cmath>

#include "demo/channels.h"

namespace signweave::demo {
namespace {

using Piece = HandPlan::Piece;
using End = HandPlan::End;

constexpr float kSink = 0.10f;
constexpr double kLowerHand = 0.7;  ///< seconds from the belly to the hips

/// Plans one hand over the signs of its lane.
class LanePlanner {
 public:
  LanePlanner(const ChannelTimeline& timeline, Side side, Random& random)
      : timeline_(timeline), side_(side), random_(random), fps_(timeline.rate.hertz()), chain_(side, fps_) {}

  std::vector<Piece> build() {
    const std::vector<LaneSign>& signs = timeline_.lanes[static_cast<std::size_t>(side_)];
    for (std::size_t i = 0; i < signs.size(); ++i) {
      const PlacedSign& sign = signs[i].placed;
      const bool after_rest = i == 0 || signs[i - 1].placed.end < sign.begin;
      if (after_rest) add(sign.begin, chain_.now());
      move_to(sign.stroke_begin, {.sign = &sign}, sign.begin);
      add(sign.stroke_end, {.sign = &sign, .stroke = 1});
      add(signs[i].hold_end, chain_.now());
      const bool last = i + 1 == signs.size();
      if (last || sign.end < signs[i + 1].placed.begin) {
        const bool in_last_unit = sign.end >= timeline_.units.back()[0];
        move_to(sign.end, {.rest = last && in_last_unit ? Rest::hips : Rest::belly}, sign.end);
      }
    }
    if (chain_.now().rest != Rest::hips) {
      const std::int64_t end = timeline_.units.back()[1];
      add(end - std::llround(kLowerHand * fps_), chain_.now());
      move_to(end, {.rest = Rest::hips}, end);
    }
    add(timeline_.frames, chain_.now());
    return chain_.take();
  }

 private:
  void add(std::int64_t until, const End& to) { chain_.add(static_cast<double>(until), to); }

  void move_to(std::int64_t end, const End& to, std::int64_t split) {
    add(end, to);
    shape_movement(chain_.last(), side_, split, kSink, fps_, random_);
  }

  const ChannelTimeline& timeline_;
  Side side_;
  Random& random_;
  double fps_;
  PieceChain chain_;
};

}  // namespace

HandPlan plan_of(const ChannelTimeline& timeline, Random& random, float unrest) {
  HandPlan::Content content{.touches = timeline.touches, .unrest = unrest};
  for (const Side side : kSides) {
    const auto which = static_cast<std::size_t>(side);
    content.pieces[which] = LanePlanner(timeline, side, random).build();
    for (const LaneSign& sign : timeline.lanes[which]) {
      if (sign.hold_end <= sign.placed.stroke_end) continue;
      content.still[which].push_back({static_cast<double>(sign.placed.stroke_end), static_cast<double>(sign.hold_end)});
    }
  }
  return HandPlan(std::move(content));
}

}  // namespace signweave::demo
