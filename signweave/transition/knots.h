#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// Guards examine one frame of this many at least, whatever they find: in 0.07 s an arm that turns as fast as signers'
/// do leaves the line between both frames by about a centimetre at most.
inline std::int64_t knot_stride(FrameRate rate) noexcept {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(0.07 * rate.hertz()));
}

/// Adds knots, examined frames of a gap in ascending order with their number in `frame`, until none are farther apart
/// than `stride` and nothing can be hidden between two of them. `make(frame)` examines another, `hides(a, b)` says
/// whether the frames between two knots may have what neither shows. `scratch` is memory of the caller's, so that
/// nothing is allocated once it has grown. Returns whether there are more knots now.
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
      // Whole strides first, so that the knots that are added anyway lie evenly.
      scratch.push_back(
          make(knots[i].frame + (between > stride ? std::max(stride, between / 2 / stride * stride) : between / 2)));
    }
    scratch.push_back(knots.back());
    if (more) std::swap(knots, scratch);
  }
  return any;
}

/// Calls `use(frame)` for each of so many frames that is no knot.
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
