#include "signweave/space/stroke_change.h"

namespace signweave {

bool operator==(const ArmChange& a, const ArmChange& b) noexcept {
  return a.linear == b.linear && a.from == b.from && a.to == b.to && a.turn.coeffs() == b.turn.coeffs() &&
         a.swivel == b.swivel && a.carry.coeffs() == b.carry.coeffs() && a.path == b.path;
}

}  // namespace signweave
