#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// Guards always examine at least one frame in this many: in 0.07 s an arm moving as fast as in signing deviates from
/// the straight line between the two frames by about a centimetre at most.
inline std::int64_t knot_stride(FrameRate rate) noexcept {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(0.07 * rate.hertz()));
}

/// Adds knots until no two neighbours are more than `stride` frames apart and nothing can be hidden between them. Knots
/// are examined frames of a gap in ascending order, with their number in `frame`. `make(frame)` examines a frame;
/// `hides(a, b)` returns true if the frames between two knots may contain something that neither shows. `scratch` is
/// memory of the caller, so that nothing is allocated once it has grown. Returns true if knots were added.
template <class Knot, class Make, class Hides>
bool refine_knots(std::vector<Knot>& knots, std::vector<Knot>& scratch, std::int64_t stride, const Make& make,
                  const Hides& hides) {
  bool any = false;
  for (bool more = true; more; any |= more) {
    more = false;
    scratch.clear();
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      scratch.push_back(knots[i]);
      const std::int64_t between = knots[i + 1].frame - knots[i].frame;
      if (between < 2 || (between <= stride && !hides(knots[i], knots[i + 1]))) continue;
      more = true;
      // Whole strides first, so that the mandatory knots are evenly spaced.
      scratch.push_back(
          make(knots[i].frame + (between > stride ? std::max(stride, between / 2 / stride * stride) : between / 2)));
    }
    scratch.push_back(knots.back());
    if (more) std::swap(knots, scratch);
  }
  return any;
}

/// Calls `use(frame)` for each of the `count` frames that is not a knot.
template <class Knot, class Use>
void for_each_between_knots(const std::vector<Knot>& knots, std::int64_t count, const Use& use) {
  std::size_t next = 1;  // the first is the left border
  for (std::int64_t frame = 0; frame < count; ++frame) {
    if (knots[next].frame == frame) {
      ++next;
    } else {
      use(frame);
    }
  }
}

}  // namespace signweave
