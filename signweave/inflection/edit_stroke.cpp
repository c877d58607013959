#include "signweave/inflection/edit_stroke.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "signweave/inflection/reach.h"
#include "signweave/inflection/slots.h"

namespace signweave {
namespace {

using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;
using inflection::kDegree;
using inflection::slot;

/// Points of the path along places.
constexpr std::size_t kAlongPoints = 33;
/// A hand that moves less than this in the capture gives no timing to a path. Metres. (ours)
constexpr float kGivesTiming = 0.1f;

Quaternionf turned(float degrees, const Vector3f& axis) {
  return Quaternionf(Eigen::AngleAxisf(degrees * kDegree, axis));
}

/// Rotations about forward, then left, then up.
Quaternionf turn_of(const std::array<float, 3>& degrees) {
  return turned(degrees[1], Vector3f::UnitY()) * turned(degrees[0], Vector3f::UnitX()) *
         turned(degrees[2], Vector3f::UnitZ());
}

Vector3f mean_palm(const CapturedStroke& stroke, const auto& palm) {
  Vector3f sum = Vector3f::Zero();
  for (const CapturedStroke::Sample& sample : stroke.samples) sum += palm(sample);
  return sum / static_cast<float>(stroke.samples.size());
}

StrokeChange with_arms(const CapturedStroke& stroke, bool both, bool together, ArmChange arm) {
  StrokeChange change{.arms = {}, .together = together};
  if (both) change.arms[slot(inflection::other(stroke.dominant))] = arm;
  change.arms[slot(stroke.dominant)] = std::move(arm);
  return change;
}

/// The share of the captured path that the hand has gone at a time of the stroke; smooth if it hardly moves.
class Timing {
 public:
  explicit Timing(const CapturedStroke& stroke) : stroke_(stroke) {
    for (std::size_t i = 0; i < stroke.samples.size(); ++i) {
      const float step =
          i == 0
              ? 0
              : (stroke.palm(stroke.samples[i], stroke.dominant) - stroke.palm(stroke.samples[i - 1], stroke.dominant))
                    .norm();
      gone_.push_back(i == 0 ? 0 : gone_.back() + step);
    }
  }
  float at(float time) const {
    if (gone_.back() < kGivesTiming) return time * time * (3 - 2 * time);
    std::size_t i = 1;
    while (i + 1 < gone_.size() && stroke_.samples[i].time < time) ++i;
    const float before = stroke_.samples[i - 1].time;
    const float share = std::clamp((time - before) / std::max(stroke_.samples[i].time - before, 1e-6f), 0.0f, 1.0f);
    return (gone_[i - 1] + share * (gone_[i] - gone_[i - 1])) / gone_.back();
  }

 private:
  const CapturedStroke& stroke_;
  std::vector<float> gone_;  ///< [sample] metres
};

/// A smooth curve through places, by the share of its length.
class Course {
 public:
  explicit Course(const std::vector<Vector3f>& places) {
    std::vector<PathPoint> points;
    for (const Vector3f& place : places) points.push_back({.shift = place});
    const PathSpline spline(points);
    constexpr int kSteps = 256;
    for (int i = 0; i <= kSteps; ++i) {
      at_.push_back(spline.at(static_cast<float>(i) / kSteps).shift);
      length_.push_back(i == 0 ? 0 : length_.back() + (at_[at_.size() - 1] - at_[at_.size() - 2]).norm());
    }
  }
  float length() const { return length_.back(); }
  Vector3f at(float share) const {
    const float wanted = std::clamp(share, 0.0f, 1.0f) * length_.back();
    const auto after = std::ranges::lower_bound(length_, wanted);
    const auto i = std::max<std::size_t>(static_cast<std::size_t>(after - length_.begin()), 1);
    const float step = std::max(length_[i] - length_[i - 1], 1e-9f);
    return at_[i - 1] + (wanted - length_[i - 1]) / step * (at_[i] - at_[i - 1]);
  }
  /// Radians; positive: to the left.
  float heading(float share) const {
    const Vector3f along = at(share + 0.02f) - at(share - 0.02f);
    return std::atan2(along.x(), along.z());
  }

 private:
  std::vector<Vector3f> at_;
  std::vector<float> length_;
};

/// The direction that turns with a path: the one in which the hand moved, or that of its fingers.
float captured_heading(const CapturedStroke& stroke, StrokeChanger& changer) {
  const CapturedStroke::Sample& first = stroke.samples.front();
  Vector3f along = stroke.palm(stroke.samples.back(), stroke.dominant) - stroke.palm(first, stroke.dominant);
  along.y() = 0;
  if (along.norm() < kGivesTiming && changer.meter().has_fingers(stroke.dominant)) {
    changer.meter().look(std::as_const(first.pose).view());
    along = stroke.space.model_from_signer.conjugate() * changer.meter().axes(stroke.dominant).fingers;
  }
  return std::atan2(along.x(), along.z());
}

}  // namespace

FittedChange edit_stroke(StrokeChanger& changer, const CapturedStroke& stroke, const SpaceChange& change) {
  const bool both = stroke.together();
  const auto palm = [&](const CapturedStroke::Sample& sample) { return stroke.palm(sample, stroke.dominant); };
  const Vector3f first = palm(stroke.samples.front());
  const Vector3f middle = mean_palm(stroke, palm);
  const Quaternionf turn = turn_of(change.turn);
  const Vector3f move = 0.01f * Vector3f(change.move.data());
  const Matrix3f linear = turn.toRotationMatrix() * Vector3f(change.scale.data()).asDiagonal() * change.size;
  const Vector3f to = middle + change.size * (first - middle) + move;
  const auto make = [&](float share, float relief, const Vector3f& pushed) {
    ArmChange arm;
    arm.linear = Matrix3f::Identity() + share * (linear - Matrix3f::Identity());
    arm.from = first;
    arm.to = first + share * (to - first) + pushed;
    arm.turn = Quaternionf::Identity().slerp((1 - relief) * share, turn);
    return with_arms(stroke, both, stroke.touch, std::move(arm));
  };
  return fit_change(changer, stroke, make, 0);
}

FittedChange take_along(StrokeChanger& changer, const CapturedStroke& stroke, std::span<const Locus> places,
                        bool keeps_turn) {
  const PalmReach reach = reach_of(changer, stroke, stroke.dominant);
  std::vector<Vector3f> points;
  for (const Locus& place : places) points.push_back(reach.within(changer.body().shoulder_width * place.at));
  const Course course(points);
  const Timing timing(stroke);
  const float heading = captured_heading(stroke, changer);
  const auto make = [&](float share, float relief, const Vector3f& pushed) {
    ArmChange arm;
    arm.linear = (1 - share) * Matrix3f::Identity();
    arm.to = pushed;
    float before = heading;
    for (std::size_t i = 0; i < kAlongPoints; ++i) {
      const float gone = timing.at(static_cast<float>(i) / (kAlongPoints - 1));
      PathPoint& point = arm.path.emplace_back();
      point.shift = share * course.at(gone);
      if (keeps_turn || course.length() < kGivesTiming) continue;
      before += std::remainder(course.heading(gone) - before, 2 * std::numbers::pi_v<float>);
      point.turn = Vector3f(0, (1 - relief) * share * (before - heading), 0);
    }
    return with_arms(stroke, stroke.together(), stroke.together(), std::move(arm));
  };
  return fit_change(changer, stroke, make, 0);
}

FittedChange take_past(StrokeChanger& changer, const CapturedStroke& stroke, const Locus& place, bool keeps_turn) {
  const CapturedStroke::Sample& halfway = stroke.samples[stroke.samples.size() / 2];
  const Vector3f palm = stroke.palm(halfway, stroke.dominant);
  const Vector3f wanted = reach_of(changer, stroke, stroke.dominant).within(changer.body().shoulder_width * place.at);
  const float yaw = keeps_turn ? 0
                               : std::remainder(std::atan2(wanted.x(), wanted.z()) - std::atan2(palm.x(), palm.z()),
                                                2 * std::numbers::pi_v<float>);
  const auto make = [&](float share, float relief, const Vector3f& pushed) {
    ArmChange arm;
    arm.turn = Quaternionf(Eigen::AngleAxisf((1 - relief) * share * yaw, Vector3f::UnitY()));
    arm.linear = Eigen::AngleAxisf(share * yaw, Vector3f::UnitY()).toRotationMatrix();
    arm.from = palm;
    arm.to = palm + share * (wanted - palm) + pushed;
    return with_arms(stroke, stroke.together(), stroke.together(), std::move(arm));
  };
  return fit_change(changer, stroke, make, yaw);
}

}  // namespace signweave
