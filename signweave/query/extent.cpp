#include "signweave/query/extent.h"

namespace signweave {

std::uint32_t ExtentSum::include(const PointFrame& frame) noexcept {
  extent_.x.add(frame.position.x());
  extent_.height.add(frame.position.y());
  extent_.forward.add(frame.position.z());
  extent_.speed.add(frame.velocity.norm());
  extent_.acceleration.add(frame.acceleration);
  const HandState& state = frame.state;
  if (state.palm != Facing::unknown) {
    extent_.openness.add(state.openness);
    extent_.faces |= palm_bit(state.palm) | fingers_bit(state.fingers);
  }
  const std::uint32_t bits = bits_of(zone_of(frame.position, *body_));
  extent_.in |= bits;
  return bits;
}

Extent join(const Extent& a, const Extent& b) noexcept {
  Extent result = a;
  result.x.add(b.x);
  result.height.add(b.height);
  result.forward.add(b.forward);
  result.speed.add(b.speed);
  result.acceleration.add(b.acceleration);
  result.openness.add(b.openness);
  result.in |= b.in;
  result.into |= b.into;
  result.faces |= b.faces;
  return result;
}

}  // namespace signweave
