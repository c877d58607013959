#include "signweave/transition/wrist_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/motion/turn_between.h"

namespace signweave {
namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180;
/// Additional bend allowed beyond a border that exceeds the limits. Radians.
constexpr float kBeyondBorder = 5 * kDegree;

float limited(float bend, const BendLimit& limit) {
  if (!(bend > limit.freely)) return bend;
  const float margin = limit.most - limit.freely;
  const float over = (bend - limit.freely) / margin;
  return limit.freely + margin * over / std::sqrt(1 + over * over);
}

void widen(BendLimit& limit, float border) {
  limit.freely = std::max(limit.freely, border);
  limit.most = std::max(limit.most, border + kBeyondBorder);
}

}  // namespace

WristLimits human_wrist() noexcept {
  // Free up to the mean of men of 18 to 54 years: 76°, 75°, 22° and 36° (D. C. Boone and S. P. Azen, Normal range of
  // motion of joints in male subjects, J. Bone Joint Surg. 61-A, 1979). At most 13° and 8° beyond (ours): women of 18
  // to 59 years reach 93°, 86°, 18° and 41° on average (Macedo and Magee).
  return {.flexion = {76 * kDegree, 89 * kDegree},
          .extension = {75 * kDegree, 88 * kDegree},
          .radial = {22 * kDegree, 30 * kDegree},
          .ulnar = {36 * kDegree, 44 * kDegree}};
}

WristLimits widened(WristLimits limits, const WristBend& border) noexcept {
  widen(limits.flexion, border.flexion);
  widen(limits.extension, -border.flexion);
  widen(limits.radial, border.deviation);
  widen(limits.ulnar, -border.deviation);
  return limits;
}

WristBend wrist_bend(const Eigen::Vector3f& forearm, const HandAxes& hand) noexcept {
  const float palm = -forearm.dot(hand.palm);
  const float thumb = -forearm.dot(hand.thumb);
  const float sine = std::hypot(palm, thumb);
  const float angle = std::atan2(sine, forearm.dot(hand.fingers));
  const float scale = sine > 1e-6f ? angle / sine : 1.0f;
  return {scale * palm, scale * thumb};
}

WristBend limited(const WristBend& bend, const WristLimits& limits) noexcept {
  const auto between = [](float value, const BendLimit& up, const BendLimit& down) {
    return value > 0 ? limited(value, up) : -limited(-value, down);
  };
  return {between(bend.flexion, limits.flexion, limits.extension),
          between(bend.deviation, limits.radial, limits.ulnar)};
}

bool turn_within(const WristLimits& limits, const Eigen::Vector3f& forearm, const HandAxes& hand,
                 Eigen::Quaternionf& turn) noexcept {
  const WristBend bend = wrist_bend(forearm, hand);
  const WristBend kept = limited(bend, limits);
  if (kept.flexion == bend.flexion && kept.deviation == bend.deviation) return false;
  const float angle = std::hypot(kept.flexion, kept.deviation);
  const float share = angle > 1e-6f ? std::sin(angle) / angle : 1.0f;
  const Eigen::Vector3f wanted =
      std::cos(angle) * hand.fingers - share * (kept.flexion * hand.palm + kept.deviation * hand.thumb);
  if (!wanted.allFinite()) return false;
  turn = turn_between(wanted, forearm);
  return true;
}

}  // namespace signweave
