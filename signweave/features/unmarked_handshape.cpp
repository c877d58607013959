#include "signweave/features/unmarked_handshape.h"

#include <algorithm>
#include <array>

namespace signweave {
namespace {

// In the units of Handshape: 1 is 90 degrees. (ours; between the angles of the letters of the manual alphabet of ASL,
// as estimated from videos)
constexpr float kStraightBeyond = 0.25f;
constexpr float kStraightKnuckle = 0.5f;
constexpr float kClosed = 0.95f;  ///< knuckle and beyond together: a hooked finger has less
constexpr float kCurvedBeyond = 0.15f;
constexpr float kCurvedKnuckle = 0.8f;
constexpr float kCurvedAlike = 0.3f;
constexpr float kThumbOut = 0.4f;  ///< angle of thumb and index

struct Flexion {
  float knuckle = 0, beyond = 0;
  bool straight() const noexcept { return beyond < kStraightBeyond && knuckle < kStraightKnuckle; }
  bool closed() const noexcept { return knuckle + beyond > kClosed; }
  bool curved() const noexcept { return beyond > kCurvedBeyond && knuckle < kCurvedKnuckle; }
};

}  // namespace

bool is_unmarked(const Handshape& shape) noexcept {
  std::array<Flexion, 4> fingers;  // without the thumb
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    fingers[i] = {.knuckle = shape.values[3 * (i + 1)], .beyond = shape.values[3 * (i + 1) + 1]};
  }
  if (std::ranges::all_of(fingers, &Flexion::straight)) return true;  // B, 5
  if (std::ranges::all_of(fingers, &Flexion::closed)) return true;    // A, S, O
  const bool one = std::all_of(fingers.begin() + 1, fingers.end(), [](const Flexion& each) { return each.closed(); });
  if (fingers.front().straight() && one) return shape.values[5] < kThumbOut;
  const auto [least, most] = std::ranges::minmax(fingers, {}, &Flexion::beyond);
  return std::ranges::all_of(fingers, &Flexion::curved) && most.beyond - least.beyond < kCurvedAlike;  // C, O
}

bool handshapes_differ(const Handshape& a, const Handshape& b) noexcept {
  return distance(a, b) > kOtherHandshape;
}

}  // namespace signweave
