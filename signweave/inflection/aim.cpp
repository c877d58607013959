#include "signweave/inflection/aim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/inflection/reach.h"
#include "signweave/inflection/slots.h"
#include "signweave/inflection/turns.h"
#include "signweave/motion/turn_between.h"

namespace signweave {
namespace {

using inflection::kDegree;
using inflection::slot;
using inflection::wrapped;

using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// If neither end of a stroke is farther out, a palm that is nearer than this is at the signer. Shoulder widths. (ours)
constexpr float kAtSigner = 0.75f;
/// Shorter movements have no direction of their own. Metres. (ours)
constexpr float kNoMovement = 0.05f;
/// A hand whose locus is the signer is this far in front of the chest. Shoulder widths. (ours)
constexpr float kBeforeChest = 0.35f;
/// A stroke's end counts as outward if it is this much farther from the body than its begin. Metres. (ours)
constexpr float kOutward = 0.08f;
/// An index finger that is farther from the direction to the locus does not point at it. Degrees. (ours)
constexpr float kPointsElsewhere = 35;

Quaternionf yaw_of(float radians) {
  return Quaternionf(Eigen::AngleAxisf(radians, Vector3f::UnitY()));
}
float azimuth(const Vector3f& point) {
  return std::atan2(point.x(), point.z());
}
float level(const Vector3f& point) {
  return std::hypot(point.x(), point.z());
}

/// Between two points on the shortest arc around the origin's vertical.
Vector3f on_arc(const Vector3f& a, const Vector3f& b, float share) {
  if (share >= 1) return b;
  const float turn = wrapped(azimuth(b) - azimuth(a));
  const float distance = level(a) + share * (level(b) - level(a));
  const float angle = azimuth(a) + share * turn;
  return {distance * std::sin(angle), a.y() + share * (b.y() - a.y()), distance * std::cos(angle)};
}

bool touches_body(const CapturedStroke::Sample& sample, Side side) {
  return has(sample.touched[slot(side)], Contact::head) || has(sample.touched[slot(side)], Contact::torso);
}

/// One end of a stroke: where its palm was captured, and its locus.
struct StrokeEnd {
  Vector3f palm = Vector3f::Zero();  ///< metres
  std::optional<Locus> locus;        ///< captured; none: unknown
  bool touches = false;
  bool known = false;  ///< the locus is annotated, not guessed from the palm
};

/// Places of palms for loci. All in metres, the stroke's axes.
class Places {
 public:
  Places(const SignerBody& body, const PalmReach& reach, StrokeEnd begin, StrokeEnd end)
      : unit_(body.shoulder_width), reach_(reach), begin_(begin), end_(end) {
    const float outward = level(end_.palm) - level(begin_.palm);
    begin_.known = begin_.locus.has_value();
    end_.known = end_.locus.has_value();
    guess(begin_, outward);
    guess(end_, -outward);
  }
  bool is_outward() const noexcept { return begin_.locus->self && !end_.locus->self; }

  /// Where the palm goes at one end for a locus; none: as captured.
  Vector3f place(bool at_end, const std::optional<Locus>& wanted) const {
    const StrokeEnd& own = at_end ? end_ : begin_;
    const StrokeEnd& other = at_end ? begin_ : end_;
    if (!wanted || own.touches) return own.palm;
    if (wanted->self) {
      if (own.locus->self) return own.palm;
      if (other.locus->self) return other.palm;
      return unit_ * (wanted->at + Vector3f(0, 0, kBeforeChest));
    }
    // The end that was away from the signer shows how far and how high.
    const StrokeEnd& base = own.locus->self && !other.locus->self ? other : own;
    if (base.known && !base.locus->self) return reach_.within(moved(base, wanted->at));
    const float before = base.locus->self ? azimuth(base.palm) : azimuth(base.locus->at);
    const float turn = wrapped(azimuth(wanted->at) - before);
    Vector3f palm = yaw_of(turn) * base.palm;
    const float rise = elevation(wanted->at) - (base.locus->self ? 0 : elevation(base.locus->at));
    palm.y() += level(palm) * std::tan(std::clamp(rise, -kMostPitch * kDegree, kMostPitch * kDegree));
    return reach_.within(palm);
  }
  float turn_of(bool at_end, const std::optional<Locus>& wanted) const {
    const StrokeEnd& own = at_end ? end_ : begin_;
    if (!wanted || wanted->self || own.touches) return 0;
    return wrapped(azimuth(wanted->at) - (own.locus->self ? 0 : azimuth(own.locus->at)));
  }

 private:
  /// The palm keeps its place relative to the line from the shoulder to the locus, along which it goes as far as the
  /// arm's reach allows.
  Vector3f moved(const StrokeEnd& base, const Vector3f& wanted) const {
    const Vector3f before = unit_ * base.locus->at - reach_.shoulder;
    const Vector3f after = unit_ * wanted - reach_.shoulder;
    const float farther = std::tanh(after.norm() / reach_.most) / std::tanh(before.norm() / reach_.most);
    Vector3f palm = yaw_of(wrapped(azimuth(after) - azimuth(before))) * (base.palm - reach_.shoulder);
    const float rise = std::clamp(elevation(after) - elevation(before), -kMostPitch * kDegree, kMostPitch * kDegree);
    palm.x() *= farther;
    palm.z() *= farther;
    palm.y() += level(palm) * std::tan(rise);
    return reach_.shoulder + palm;
  }
  static float elevation(const Vector3f& point) { return std::atan2(point.y(), level(point)); }
  /// `outward`: how much farther from the signer the other end is.
  void guess(StrokeEnd& end, float outward) const {
    if (end.locus) return;
    const bool near = std::abs(outward) > kOutward ? outward > 0 : end.palm.z() < kAtSigner * unit_;
    end.locus = Locus{.at = end.palm / unit_, .self = end.touches || near};
    if (!end.locus->self) end.locus->at.y() = 0;
  }

  float unit_;
  PalmReach reach_;
  StrokeEnd begin_, end_;
};

/// The similarity that takes a movement from `a` to `b` to one from `a2` to `b2`, yaw first, within the limits.
struct Similarity {
  Matrix3f linear = Matrix3f::Identity();
  Quaternionf turn = Quaternionf::Identity();
  Vector3f left_over = Vector3f::Zero();  ///< from the mapped end to the wanted one
};
Similarity similarity(const Vector3f& a, const Vector3f& b, const Vector3f& a2, const Vector3f& b2, float usual_yaw) {
  const Vector3f from = b - a;
  const Vector3f to = b2 - a2;
  const bool has_direction = level(from) > kNoMovement && level(to) > kNoMovement;
  const float yaw = has_direction ? wrapped(azimuth(to) - azimuth(from)) : usual_yaw;
  Similarity found{.turn = yaw_of(yaw)};
  if (has_direction) {
    const float rise = std::atan2(to.y(), level(to)) - std::atan2(from.y(), level(from));
    const float pitch = std::clamp(rise, -kMostPitch * kDegree, kMostPitch * kDegree);
    const Vector3f axis = Vector3f(to.z(), 0, -to.x()).normalized();  // to the left of the movement's direction
    found.turn = Quaternionf(Eigen::AngleAxisf(-pitch, axis)) * found.turn;
  }
  const float length = from.norm();
  const float scale = length > kNoMovement && to.norm() > kNoMovement
                          ? std::clamp(to.norm() / length, kLeastAimScale, kMostAimScale)
                          : 1;
  found.linear = scale * found.turn.toRotationMatrix();
  found.left_over = to - found.linear * from;
  return found;
}

/// The rotation about a shoulder that takes the direction to `from` to that to `to`, yaw first.
Quaternionf about(const Vector3f& shoulder, const Vector3f& from, const Vector3f& to) {
  const Vector3f before = from - shoulder;
  const Vector3f after = to - shoulder;
  const bool level_both = level(before) > kNoMovement && level(after) > kNoMovement;
  const Quaternionf yaw = level_both ? yaw_of(wrapped(azimuth(after) - azimuth(before))) : Quaternionf::Identity();
  return turn_between(yaw * before, after) * yaw;
}

/// The map of one hand, or of the middle between both.
ArmChange arm_change(const Vector3f& a, const Vector3f& b, const Vector3f& a2, const Vector3f& b2, float usual_yaw,
                     float relief, const Vector3f& shoulder) {
  const Similarity map = similarity(a, b, a2, b2, usual_yaw);
  ArmChange change{.linear = map.linear, .from = a, .to = a2};
  change.carry = about(shoulder, (a + b) / 2, (a2 + b2) / 2);
  // A hand that turns with the arm bends its wrist as captured.
  change.turn = change.carry.slerp(1 - relief, map.turn);
  if (map.left_over.norm() > 1e-6f) change.path = {{}, {.shift = map.left_over}};
  return change;
}

/// The change of a hand, or of both if they keep to each other.
StrokeChange change_of(const CapturedStroke& stroke, Side side, ArmChange arm) {
  StrokeChange change{.arms = {}, .together = stroke.together()};
  if (stroke.together()) change.arms[slot(inflection::other(side))] = arm;
  change.arms[slot(side)] = std::move(arm);
  return change;
}

/// The palm at an end of the changed stroke.
Vector3f changed_palm(StrokeChanger& changer, const CapturedStroke& stroke, const StrokeChange& change,
                      const CapturedStroke::Sample& sample, Side side, HandInSpace* hand = nullptr) {
  Pose pose = sample.pose;
  std::array<PathSpline, 2> paths;
  for (const Side one : kSides) {
    if (change.arms[slot(one)]) paths[slot(one)] = PathSpline(change.arms[slot(one)]->path);
  }
  changer.apply(change, paths, stroke.space, 1, sample.time, pose.view());
  CapturedStroke::Sample made;
  for (const Side one : kSides) {
    if (changer.has(one)) made.hands[slot(one)] = changer.look(std::as_const(pose).view(), stroke.space, one);
  }
  if (hand != nullptr) *hand = made.hands[slot(side)];
  return stroke.palm(made, side);
}

/// Takes the ends of a movement to `a2` and `b2`.
Aimed move_ends(StrokeChanger& changer, const CapturedStroke& stroke, const Vector3f& a2, const Vector3f& b2,
                float usual_yaw) {
  const Side side = stroke.dominant;
  const CapturedStroke::Sample& first = stroke.samples.front();
  const CapturedStroke::Sample& last = stroke.samples.back();
  const Vector3f a = stroke.palm(first, side);
  const Vector3f b = stroke.palm(last, side);
  const auto make = [&](float share, float relief, const Vector3f& pushed) {
    return change_of(stroke, side,
                     arm_change(a, b, on_arc(a, a2, share) + pushed, on_arc(b, b2, share) + pushed, share * usual_yaw,
                                relief, first.hands[slot(side)].shoulder));
  };
  const float sideways = azimuth(a2 + b2) - azimuth(a + b);
  Aimed aimed{.fitted = fit_change(changer, stroke, make, wrapped(sideways))};
  aimed.begin_missed = (changed_palm(changer, stroke, aimed.fitted.change, first, side) - a2).norm();
  aimed.end_missed = (changed_palm(changer, stroke, aimed.fitted.change, last, side) - b2).norm();
  return aimed;
}

Aimed aim_movement(StrokeChanger& changer, const CapturedStroke& stroke, const std::optional<Locus>& begin,
                   const std::optional<Locus>& end, const std::optional<Locus>& begin_before,
                   const std::optional<Locus>& end_before) {
  const Side side = stroke.dominant;
  const CapturedStroke::Sample& first = stroke.samples.front();
  const CapturedStroke::Sample& last = stroke.samples.back();
  const Vector3f a = stroke.palm(first, side);
  const Vector3f b = stroke.palm(last, side);
  const Places places(changer.body(), reach_of(changer, stroke, side), {a, begin_before, touches_body(first, side)},
                      {b, end_before, touches_body(last, side)});
  const float begin_turn = places.turn_of(false, begin);
  const float end_turn = places.turn_of(true, end);
  return move_ends(changer, stroke, places.place(false, begin), places.place(true, end),
                   std::abs(end_turn) > std::abs(begin_turn) ? end_turn : begin_turn);
}

/// Each hand comes from its own locus, or goes to it.
Aimed aim_each_hand(StrokeChanger& changer, const CapturedStroke& stroke, const LociOfSign& wanted) {
  const auto hand_of = [&](const std::optional<Locus>& locus) {
    return locus && !locus->self && locus->at.x() > 0 ? Side::left : Side::right;
  };
  const Side own = wanted.from ? hand_of(wanted.from) : hand_of(wanted.to) == Side::left ? Side::right : Side::left;
  const Side theirs = inflection::other(own);
  const auto make = [&](float share, float relief, const Vector3f& pushed) {
    StrokeChange change;
    for (const auto& [side, locus] : {std::pair(own, wanted.from), std::pair(theirs, wanted.to)}) {
      if (!changer.has(side)) continue;
      const StrokeEnd begin{.palm = stroke.first(side).palm};
      const StrokeEnd end{.palm = stroke.last(side).palm};
      const Places places(changer.body(), reach_of(changer, stroke, side), begin, end);
      // The hand is displaced where it is farther from the other one; where the hands meet, both go to the middle.
      const Vector3f a2 = on_arc(begin.palm, places.place(false, locus), share) + pushed;
      change.arms[slot(side)] =
          arm_change(begin.palm, end.palm, a2, end.palm + pushed, 0, relief, stroke.first(side).shoulder);
    }
    return change;
  };
  Aimed aimed{.fitted = fit_change(changer, stroke, make, 0)};
  return aimed;
}

/// The direction in which a hand points: of the index finger, or of the movement.
Vector3f pointing_of(const HandInSpace& hand) {
  return (hand.index_tip - hand.index_base).normalized();
}

/// Where a locus is pointed at, metres. A hand would stand on a locus that is near; it points at one farther out in the
/// same direction.
Vector3f pointed_place(const Locus& locus, float unit) {
  return unit * std::max(locus.self ? 1.0f : kNearestPointedAt / std::max(locus.at.norm(), 1e-3f), 1.0f) * locus.at;
}

/// True unless the index finger of an annotated stroke goes elsewhere than to its locus: such a hand is placed, and
/// turned, before the locus.
bool points(const CapturedStroke& stroke, const std::optional<Locus>& captured, float unit) {
  if (!captured || captured->self) return true;
  const HandInSpace& hand = stroke.last(stroke.dominant);
  const Vector3f line = pointed_place(*captured, unit) - hand.index_base;
  return pointing_of(hand).dot(line.normalized()) > std::cos(kPointsElsewhere * kDegree);
}

Aimed point(StrokeChanger& changer, const CapturedStroke& stroke, const Locus& target,
            const std::optional<Locus>& captured) {
  const Side side = stroke.dominant;
  if (!changer.has_index(side)) {
    throw Error(ErrorCode::bad_input,
                "this signer has no index finger to point with; choose a sign that is placed instead");
  }
  const CapturedStroke::Sample& last = stroke.samples.back();
  const HandInSpace& hand = last.hands[slot(side)];
  const float unit = changer.body().shoulder_width;
  const Vector3f goal = pointed_place(target, unit);
  // The arm turns about the shoulder as far as the direction from there to the target turns.
  const Vector3f before = pointing_of(hand);
  const Vector3f pointed_at = captured && !captured->self
                                  ? pointed_place(*captured, unit)
                                  : Vector3f(hand.index_base + unit * kNearestPointedAt * before);
  const Vector3f arm_before = (pointed_at - hand.shoulder).normalized();
  const auto make = [&](float share, float relief, const Vector3f& pushed) {
    const Vector3f direction =
        on_arc(arm_before, (goal - hand.shoulder).normalized(), (1 - relief) * share).normalized();
    const Quaternionf carry = about(Vector3f::Zero(), arm_before, direction);
    ArmChange arm{.linear = carry.toRotationMatrix(),
                  .from = hand.palm,
                  .to = hand.shoulder + carry * (hand.palm - hand.shoulder) + pushed,
                  .turn = carry,
                  .carry = carry};
    // Then the finger points from where it now is; several times, because turning it moves its knuckle.
    for (int i = 0; i < 6; ++i) {
      const Vector3f base = arm.to + arm.turn * (hand.index_base - hand.palm);
      const Vector3f wanted = on_arc(before, (goal - base).normalized(), share).normalized();
      arm.turn = about(Vector3f::Zero(), arm.turn * before, wanted) * arm.turn;
    }
    return change_of(stroke, side, std::move(arm));
  };
  Aimed aimed{.fitted = fit_change(changer, stroke, make, wrapped(azimuth(goal) - azimuth(before)))};
  HandInSpace made;
  changed_palm(changer, stroke, aimed.fitted.change, last, side, &made);
  const float cosine = pointing_of(made).dot((goal - made.index_base).normalized());
  aimed.aim_error = std::acos(std::clamp(cosine, -1.0f, 1.0f)) / kDegree;
  return aimed;
}

}  // namespace

void require_in_front(const std::optional<Locus>& locus) {
  if (!locus || locus->self) return;
  const float angle = angles_of(locus->at).azimuth;
  if (std::abs(angle) <= kMostAzimuth) return;
  throw Error(ErrorCode::bad_input,
              fmt::format("a locus at {:.0f}° is behind the signer; give one within {:.0f}° to either side", angle,
                          kMostAzimuth));
}

Aimed aim_stroke(StrokeChanger& changer, const CapturedStroke& stroke, SpaceRole role, const LociOfSign& wanted,
                 const LociOfSign& captured) {
  for (const auto& locus : {wanted.from, wanted.to, wanted.at}) require_in_front(locus);
  if (role == SpaceRole::aim && (wanted.at || wanted.to)) {
    const std::optional<Locus>& target = wanted.at ? wanted.at : wanted.to;
    const std::optional<Locus>& before = captured.at ? captured.at : captured.to;
    if (!changer.has_index(stroke.dominant) || points(stroke, before, changer.body().shoulder_width)) {
      return point(changer, stroke, *target, before);
    }
    return aim_movement(changer, stroke, target, target, before, before);
  }
  if (wanted.at) return aim_movement(changer, stroke, wanted.at, wanted.at, captured.at, captured.at);
  switch (role) {
    case SpaceRole::forward:
      return aim_movement(changer, stroke, wanted.from, wanted.to, captured.from, captured.to);
    case SpaceRole::backward:
      return aim_movement(changer, stroke, wanted.to, wanted.from, captured.to, captured.from);
    case SpaceRole::both:
      return aim_each_hand(changer, stroke, wanted);
    case SpaceRole::aim:
    case SpaceRole::none:
      break;
  }
  throw Error(ErrorCode::bad_input,
              "a sign without a role goes nowhere by itself; give its role in a table (GLOSS,forward)");
}

Aimed aim_between(StrokeChanger& changer, const CapturedStroke& stroke, const Vector3f& begin, const Vector3f& end) {
  const Vector3f a = stroke.palm(stroke.samples.front(), stroke.dominant);
  const Vector3f b = stroke.palm(stroke.samples.back(), stroke.dominant);
  return move_ends(changer, stroke, begin, end, wrapped(azimuth(begin + end) - azimuth(a + b)));
}

SpaceRole guessed_role(const CapturedStroke& stroke, const StrokeChanger& changer) {
  const Vector3f a = stroke.palm(stroke.samples.front(), stroke.dominant);
  const Vector3f b = stroke.palm(stroke.samples.back(), stroke.dominant);
  const float outward = level(b) - level(a);
  if (outward > kOutward) return SpaceRole::forward;
  if (outward < -kOutward) return SpaceRole::backward;
  return changer.has_index(stroke.dominant) && (b - a).norm() < kOutward ? SpaceRole::aim : SpaceRole::none;
}

}  // namespace signweave
