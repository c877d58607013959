#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "demo/channels.h"
#include "demo/grid.h"

namespace signweave::demo {
namespace {

// Seconds.
constexpr double kRestAtBegin = 1.2;
constexpr double kRest = 0.8;          ///< at least, between units
constexpr double kPreparation = 0.70;  ///< from rest
constexpr double kRetraction = 0.65;   ///< to rest
constexpr double kLongestGap = 1.4;    ///< between the strokes of a hand that does not rest in between
constexpr double kHoldsOn = 0.12;      ///< after the stroke beside which a hand is held
constexpr double kBrowsBefore = 0.08;  ///< of the first sign
constexpr double kBrowsAfter = 0.02;   ///< of the last sign
constexpr double kMouthBefore = 0.08;  ///< of the stroke
constexpr double kMouthAfter = 0.06;
constexpr double kTouchBefore = 0.04;  ///< of the end of the stroke that touches
constexpr double kTouchAfter = 0.08;

Token draw_token(Random& random) {
  Token token;
  const auto within = [&](double deviation) {
    return static_cast<float>(deviation * std::clamp(random.normal(), -2.0, 2.0));
  };
  token.size = 1 + within(0.04);
  token.other_size = static_cast<float>(random.uniform(0.93, 1.0));
  token.lag = random.uniform(0.010, 0.030);
  token.turn = within(0.04);
  token.bend = within(0.03);
  for (float& along : token.shift) along = within(0.003);
  return token;
}

/// One unit in the making.
class UnitScheduler {
 public:
  UnitScheduler(ChannelTimeline& timeline, const ChannelUnit& unit, Random& random)
      : timeline_(timeline), unit_(unit), random_(random), grid_(grid_of(timeline.rate)) {
    first_ = {timeline.lanes[0].size(), timeline.lanes[1].size()};
  }

  /// Returns the frame in which both hands are at rest again. The first hand leaves rest at `begin`.
  std::int64_t run(std::int64_t begin) {
    place_strokes(begin);
    for (const Side side : kSides) join_neighbours(side);
    mark();
    return end_of(0, unit_.places.size() - 1);
  }

 private:
  struct Placed {
    std::int64_t stroke_begin = 0, stroke_end = 0;
    std::vector<std::pair<Side, std::size_t>> on;  ///< lane and index
  };

  std::int64_t frames(double seconds) const { return grid_.steps(seconds) * grid_.frames; }
  std::vector<LaneSign>& lane(Side side) { return timeline_.lanes[static_cast<std::size_t>(side)]; }

  double tempo(const SignShape& shape, const Token& token) {
    const double drawn = std::exp(std::clamp(0.07 * random_.normal(), -0.14, 0.14));
    return std::clamp(drawn * stroke_seconds(shape, token), 0.40, 0.80);
  }

  /// Seconds that a held sign needs between the end of another stroke of its hand and the place beside which it begins.
  double lead_of(std::size_t place) const {
    double lead = 0;
    for (const HeldSign& held : unit_.held) {
      if (held.from == place) lead = 0.45 + kHeldStroke + Seconds(held.earlier).count();
      if (held.to + 1 == place) lead = kHoldsOn + 0.55;
    }
    return lead;
  }

  void place_strokes(std::int64_t at) {
    for (std::size_t i = 0; i < unit_.places.size(); ++i) {
      const ChannelPlace& place = unit_.places[i];
      const SignShape& shape = channel_sign(place.gloss, place.hand);
      const double drawn = i == 0 ? kPreparation : std::clamp(0.72 + 0.10 * random_.normal(), 0.56, 0.95);
      at += frames(std::max(drawn, lead_of(i)));
      PlacedSign sign{.shape = &shape, .token = draw_token(random_), .stroke_begin = at};
      for (const HeldSign& held : unit_.held) {
        if (held.from == i) hold(held, at);
      }
      at += frames(tempo(shape, sign.token));
      sign.stroke_end = at;
      Placed placed{sign.stroke_begin, sign.stroke_end, {}};
      for (const Side side : kSides) {
        if (!acts(shape, side)) continue;
        placed.on.emplace_back(side, lane(side).size());
        lane(side).push_back({sign, sign.stroke_end});
      }
      for (const auto& [to, index] : held_until_) {
        if (to == i) lane(Side::left)[index].hold_end = at + frames(kHoldsOn);
      }
      placed_.push_back(std::move(placed));
    }
  }

  void hold(const HeldSign& held, std::int64_t at) {
    PlacedSign sign{.shape = &channel_sign(held.gloss, Side::left), .token = draw_token(random_)};
    sign.stroke_end = at - frames(Seconds(held.earlier).count());
    sign.stroke_begin = sign.stroke_end - frames(kHeldStroke);
    held_until_.emplace_back(held.to, lane(Side::left).size());
    lane(Side::left).push_back({sign, sign.stroke_end});
  }

  /// Gives the signs of a hand their begins and ends.
  void join_neighbours(Side side) {
    std::vector<LaneSign>& signs = lane(side);
    for (std::size_t i = first_[static_cast<std::size_t>(side)]; i < signs.size(); ++i) {
      PlacedSign& sign = signs[i].placed;
      if (i == first_[static_cast<std::size_t>(side)]) sign.begin = sign.stroke_begin - frames(kPreparation);
      sign.end = signs[i].hold_end + frames(kRetraction);
      if (i + 1 == signs.size()) continue;
      PlacedSign& next = signs[i + 1].placed;
      next.begin = next.stroke_begin - frames(kPreparation);
      const std::int64_t gap = next.stroke_begin - signs[i].hold_end;
      if (gap > frames(kLongestGap)) continue;
      sign.end = signs[i].hold_end + frames(0.5 * static_cast<double>(gap) / timeline_.rate.hertz());
      next.begin = sign.end;
    }
  }

  std::int64_t begin_of(std::size_t from, std::size_t to) {
    std::int64_t begin = timeline_.rate.numerator * 1'000'000;
    for (std::size_t i = from; i <= to; ++i) {
      for (const auto& [side, index] : placed_[i].on) begin = std::min(begin, lane(side)[index].placed.begin);
    }
    return begin;
  }
  std::int64_t end_of(std::size_t from, std::size_t to) {
    std::int64_t end = 0;
    for (std::size_t i = from; i <= to; ++i) {
      for (const auto& [side, index] : placed_[i].on) end = std::max(end, lane(side)[index].placed.end);
    }
    for (const auto& [held_to, index] : held_until_) {
      if (held_to == to) end = std::max(end, lane(Side::left)[index].placed.end);
    }
    return end;
  }

  void mark() {
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const ChannelPlace& place = unit_.places[i];
      if (!place.mouthing.empty()) {
        timeline_.mouthings.push_back({std::string(place.mouthing), placed_[i].stroke_begin - frames(kMouthBefore),
                                       placed_[i].stroke_end + frames(kMouthAfter)});
      }
      for (const SignTouch& touch : channel_touches()) {
        if (touch.gloss == place.gloss) mark_touch(touch, i);
      }
      // The eyes blink after the last sign, and in the middle of a long unit.
      const bool middle = placed_.size() >= 4 && i + 1 == placed_.size() / 2;
      if (i + 1 == placed_.size() || middle) {
        const std::int64_t shut = placed_[i].stroke_end + frames(0.16);
        timeline_.blinks.push_back({"blink", shut - frames(0.08), shut + frames(0.15)});
      }
    }
    for (const MarkedPlaces& marked : unit_.marked) mark_places(marked);
    std::int64_t begin = begin_of(0, placed_.size() - 1);
    for (const auto& [to, index] : held_until_) begin = std::min(begin, lane(Side::left)[index].placed.begin);
    timeline_.units.push_back({begin, end_of(0, placed_.size() - 1)});
  }

  void mark_touch(const SignTouch& touch, std::size_t place) {
    static constexpr std::string_view kNames[] = {"thumb", "index", "middle finger", "ring finger", "little finger"};
    const std::int64_t at = touch.at_end ? placed_[place].stroke_end : placed_[place].stroke_begin;
    const Side side = placed_[place].on.back().first;  // the right hand if both act
    HandPlan::Touch added{.begin = static_cast<double>(at - frames(kTouchBefore)),
                          .end = static_cast<double>(at + frames(kTouchAfter)),
                          .side = side,
                          .finger = touch.finger,
                          .what = touch.what,
                          .other_finger = touch.other_finger};
    timeline_.touches.push_back(added);
    const std::string_view own = side == Side::right ? "right" : "left";
    const std::string_view other = side == Side::right ? "left" : "right";
    std::string what = touch.what == HandPlan::Touchable::chin ? "chin" : "chest";
    if (touch.what == HandPlan::Touchable::fingertip) {
      what = fmt::format("{} {}", other, kNames[static_cast<std::size_t>(touch.other_finger)]);
    }
    timeline_.contacts.push_back({fmt::format("{} {} - {}", own, kNames[static_cast<std::size_t>(touch.finger)], what),
                                  at - frames(kTouchBefore), at + frames(kTouchAfter)});
  }

  void mark_places(const MarkedPlaces& marked) {
    const std::int64_t begin = begin_of(marked.from, marked.to);
    const std::int64_t end = end_of(marked.from, marked.to);
    const MarkedFrames brows{"", begin - frames(kBrowsBefore), end + frames(kBrowsAfter)};
    switch (marked.marking) {
      case Marking::brows_raised:
        timeline_.brows.push_back({"raised", brows.begin, brows.end});
        break;
      case Marking::brows_lowered:
        timeline_.brows.push_back({"lowered", brows.begin, brows.end});
        break;
      case Marking::head_shake:
        timeline_.heads.push_back({"shake", begin, end});
        break;
      case Marking::head_nod:
        timeline_.heads.push_back({"nod", begin, end});
        break;
      case Marking::gaze_left:
        timeline_.gazes.push_back({"left", begin, end});
        break;
      case Marking::gaze_right:
        timeline_.gazes.push_back({"right", begin, end});
        break;
    }
  }

  static constexpr double kHeldStroke = 0.45;

  ChannelTimeline& timeline_;
  const ChannelUnit& unit_;
  Random& random_;
  Grid grid_;
  std::array<std::size_t, 2> first_{};
  std::vector<Placed> placed_;
  std::vector<std::pair<std::size_t, std::size_t>> held_until_;  ///< place, index on the left lane
};

}  // namespace

ChannelTimeline schedule_channels(const ChannelScript& script, FrameRate rate, Random& random) {
  ChannelTimeline timeline;
  timeline.rate = rate;
  const Grid grid = grid_of(rate);
  std::int64_t at = grid.steps(kRestAtBegin) * grid.frames;
  for (const ChannelUnit& unit : script.units) {
    const std::int64_t end = UnitScheduler(timeline, unit, random).run(at);
    at = end + grid.steps(random.uniform(kRest, kRest + 0.4)) * grid.frames;
  }
  timeline.frames = at + grid.steps(0.4) * grid.frames;
  return timeline;
}

Timeline dominant_timeline(const ChannelTimeline& timeline) {
  Timeline dominant{.rate = timeline.rate, .signs = {}, .frames = timeline.frames};
  for (const LaneSign& sign : timeline.lanes[static_cast<std::size_t>(Side::right)]) {
    dominant.signs.push_back(sign.placed);
  }
  return dominant;
}

}  // namespace signweave::demo
