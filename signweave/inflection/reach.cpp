#include "signweave/inflection/reach.h"

#include <algorithm>

namespace signweave {
namespace {

/// The share of an arm's length that is used without need. (ours)
constexpr float kStretched = 0.95f;

}  // namespace

Eigen::Vector3f PalmReach::within(const Eigen::Vector3f& place) const noexcept {
  const auto nearer = [&](float share) { return Eigen::Vector3f(share * place.x(), place.y(), share * place.z()); };
  const auto reaches = [&](float share) { return (nearer(share) - shoulder).norm() <= most; };
  if (reaches(1)) return place;
  float inside = 0;
  float outside = 1;
  for (int i = 0; i < 12; ++i) {
    const float middle = (inside + outside) / 2;
    (reaches(middle) ? inside : outside) = middle;
  }
  return reaches(inside) ? nearer(inside) : place;
}

PalmReach reach_of(const StrokeChanger& changer, const CapturedStroke& stroke, Side side) {
  PalmReach reach{.shoulder = stroke.first(side).shoulder,
                  .most = kStretched * changer.body().arm_length * changer.body().shoulder_width};
  for (const CapturedStroke::Sample& sample : stroke.samples) {
    reach.most = std::max(reach.most, (stroke.palm(sample, side) - reach.shoulder).norm());
  }
  return reach;
}

}  // namespace signweave
