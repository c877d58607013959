#include "signweave/inflection/fit_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "signweave/inflection/slots.h"
#include "signweave/render/place_correction.h"

namespace signweave {
namespace {

using inflection::kDegree;
using inflection::slot;

using Eigen::Vector3f;

constexpr float kMissAllowed = 0.001f;           // metres
constexpr float kBendRounding = 0.1f * kDegree;  // radians
/// Less than kDepthOfHandAllowed, because not every frame is examined. Metres.
constexpr float kDepthAllowed = kDepthOfHandAllowed - 0.002f;
constexpr float kBeyond = 3e-4f;  // metres
constexpr int kPushes = 4;
constexpr int kBisections = 6;
constexpr std::array kTrunkTurns = {0.0f, 0.5f, 1.0f};               // shares of kTrunkShare
constexpr std::array kSwivels = {0.0f, 0.25f, -0.25f, 0.5f, -0.5f};  // radians
constexpr std::array kReliefs = {0.25f, 0.5f, 0.75f, 1.0f};

const char* word(Side side) {
  return side == Side::left ? "left" : "right";
}

float beyond_limits(const WristBend& bend, const WristBend& captured) {
  const WristLimits limits = widened(human_wrist(), captured);
  return std::max({bend.flexion - limits.flexion.most, -bend.flexion - limits.extension.most,
                   bend.deviation - limits.radial.most, -bend.deviation - limits.ulnar.most});
}

/// What is wrong with a change, at its worst sample.
struct Faults {
  float missed = 0, bent = 0, deep = 0;  ///< metres, radians, metres; beyond what is allowed
  Side missed_side = Side::right, bent_side = Side::right, deep_side = Side::right;
  Obstacle in = Obstacle::head;
  Vector3f out = Vector3f::Zero();  ///< unit, the stroke's axes
  bool none() const noexcept { return missed <= 0 && bent <= 0 && deep <= 0; }
};

class Fitter {
 public:
  Fitter(StrokeChanger& changer, const CapturedStroke& stroke)
      : changer_(changer), stroke_(stroke), pose_(changer.skeleton()) {}

  Faults examine(const StrokeChange& change) {
    set_paths(change);
    Faults worst;
    for (const CapturedStroke::Sample& sample : stroke_.samples) examine(change, sample, worst);
    return worst;
  }

  /// Moves the hands out of the body as far as needed and allowed. Returns what is left; sets the change.
  Faults push_out(const std::function<StrokeChange(const Vector3f& pushed)>& make, StrokeChange& change) {
    Vector3f pushed = Vector3f::Zero();
    for (int i = 0;; ++i) {
      change = make(pushed);
      const Faults faults = examine(change);
      const Vector3f more = (faults.deep + kBeyond) * faults.out;
      if (faults.deep <= 0 || i == kPushes || (pushed + more).norm() > kMostPushed) return faults;
      pushed += more;
    }
  }

  void set_sizes(FittedChange& fitted) {
    set_paths(fitted.change);
    for (const CapturedStroke::Sample& sample : stroke_.samples) {
      apply(fitted.change, sample);
      for (const Side side : kSides) {
        if (!fitted.change.arms[slot(side)] || !changer_.has(side)) continue;
        const HandInSpace made = changer_.look(std::as_const(pose_).view(), stroke_.space, side);
        const HandInSpace& captured = sample.hands[slot(side)];
        fitted.moved_mm = std::max(fitted.moved_mm, 1000 * (made.palm - captured.palm).norm());
        const Eigen::Quaternionf turn = made.turn * captured.turn.conjugate();
        const float angle = 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
        fitted.turned_degrees = std::max(fitted.turned_degrees, angle / kDegree);
      }
    }
  }

  static std::string why(const Faults& faults) {
    if (faults.missed > 0) {
      return fmt::format("the {} hand would be {:.0f} cm beyond its reach", word(faults.missed_side),
                         std::max(1.0f, 100 * faults.missed));
    }
    if (faults.bent > 0) {
      return fmt::format("the {} wrist would bend {:.0f}° beyond its limits", word(faults.bent_side),
                         std::max(1.0f, faults.bent / kDegree));
    }
    return fmt::format("the {} hand would be {:.0f} mm deeper in the {} than captured", word(faults.deep_side),
                       std::max(1.0f, 1000 * faults.deep), name_of(faults.in));
  }

 private:
  void set_paths(const StrokeChange& change) {
    for (const Side side : kSides) {
      paths_[slot(side)] = change.arms[slot(side)] ? PathSpline(change.arms[slot(side)]->path) : PathSpline();
    }
  }
  StrokeChanger::Fit apply(const StrokeChange& change, const CapturedStroke::Sample& sample) {
    std::ranges::copy(sample.pose.rotations, pose_.rotations.begin());
    std::ranges::copy(sample.pose.translations, pose_.translations.begin());
    return changer_.apply(change, paths_, stroke_.space, 1, sample.time, pose_.view());
  }
  void examine(const StrokeChange& change, const CapturedStroke::Sample& sample, Faults& worst) {
    const StrokeChanger::Fit fit = apply(change, sample);
    HandMeter& meter = changer_.meter();
    for (const Side side : kSides) {
      if (!change.arms[slot(side)] || !changer_.has(side)) continue;
      if (const float missed = fit.missed[slot(side)] - kMissAllowed; missed > worst.missed) {
        worst.missed = missed;
        worst.missed_side = side;
      }
      const float bent = beyond_limits(changer_.bend(side), sample.bend[slot(side)]) - kBendRounding;
      if (bent > worst.bent) {
        worst.bent = bent;
        worst.bent_side = side;
      }
      if (!meter.has(side)) continue;
      meter.look(changer_.model(), side);
      for (const Obstacle obstacle : kBodyObstacles) {
        const Approach near = meter.to(side, obstacle);
        const float allowed =
            std::max(stroke_.depth[slot(side)][static_cast<std::size_t>(obstacle)], 0.0f) + kDepthAllowed;
        if (-near.clearance - allowed <= worst.deep) continue;
        worst.deep = -near.clearance - allowed;
        worst.deep_side = side;
        worst.in = obstacle;
        worst.out = stroke_.space.model_from_signer.conjugate() * near.away;
      }
    }
    if (change.together || !meter.has(Side::left) || !meter.has(Side::right)) return;
    meter.look(changer_.model(), Side::left);
    meter.look(changer_.model(), Side::right);
    HandsMeeting meeting;
    meter.meet(meeting);
    const float deep = meeting.depth - std::max(stroke_.meeting.depth, 0.0f) - kDepthAllowed;
    if (deep <= worst.deep) return;
    worst.deep = deep;
    worst.deep_side = change.arms[slot(Side::right)] ? Side::right : Side::left;
    worst.in = Obstacle::other_hand;
    worst.out = stroke_.space.model_from_signer.conjugate() * meter.to(worst.deep_side, Obstacle::other_hand).away;
  }

  StrokeChanger& changer_;
  const CapturedStroke& stroke_;
  std::array<PathSpline, 2> paths_;
  Pose pose_;
};

StrokeChange with(StrokeChange change, float yaw, float swivel) {
  change.trunk_yaw = yaw;
  for (const Side side : kSides) {
    if (change.arms[slot(side)]) change.arms[slot(side)]->swivel += side == Side::left ? -swivel : swivel;
  }
  return change;
}

}  // namespace

FittedChange fit_change(StrokeChanger& changer, const CapturedStroke& stroke, const MakeChange& make, float towards) {
  Fitter fitter(changer, stroke);
  FittedChange fitted;
  const float most_yaw = towards > 0 ? kTrunkShare * kDegree : towards < 0 ? -kTrunkShare * kDegree : 0;
  std::optional<Faults> first;
  Faults last;
  const auto take = [&](float share, float relief, float yaw, float swivel) {
    StrokeChange change;
    const auto pushed = [&](const Vector3f& by) { return with(make(share, relief, by), yaw, swivel); };
    last = fitter.push_out(pushed, change);
    if (!first) first = last;
    if (!last.none()) return false;
    fitted.change = std::move(change);
    fitted.share = share;
    fitted.relief = relief;
    return true;
  };
  const auto find = [&] {
    float last_yaw = -1;
    for (const float turned : kTrunkTurns) {
      const float yaw = turned * most_yaw;
      if (yaw == last_yaw) break;
      last_yaw = yaw;
      for (const float swivel : kSwivels) {
        if (take(1, 0, yaw, swivel)) return;
        // The elbow's swivel helps a wrist only.
        if (swivel == 0 && (last.missed > 0 || last.deep > 0)) break;
      }
    }
    for (const float relief : kReliefs) {
      if (take(1, relief, 0, 0) || (most_yaw != 0 && take(1, relief, most_yaw, 0))) return;
    }
    float reached = 0;
    float beyond = 1;
    for (int i = 0; i < kBisections; ++i) {
      const float share = (reached + beyond) / 2;
      bool found = false;
      for (const float relief : {0.0f, 0.5f, 1.0f}) {
        if ((found = take(share, relief, share * most_yaw, 0))) break;
      }
      (found ? reached : beyond) = share;
    }
    if (reached == 0) {
      fitted.change = make(0, 0, Vector3f::Zero());
      fitted.share = 0;
    }
  };
  find();
  if (fitted.share < 1 || fitted.relief > 0) fitted.why = Fitter::why(*first);
  fitter.set_sizes(fitted);
  return fitted;
}

}  // namespace signweave
