#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "signweave/query/example.h"
#include "signweave/query/movement.h"
#include "signweave/query/phase_query.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// The number of results of like(…) without a limit.
inline constexpr std::size_t kNearest = 20;

/// The place of a query whose segments like(…) orders; nullopt if the query has no like(…).
std::optional<std::size_t> ranked_place(const PhaseQuery& query) noexcept;
/// The example at that place, which must have one.
const Example& example_at(const PhaseQuery& query, std::size_t place) noexcept;

/// An example bound to one database. Borrows the movement. For one thread.
class RankedExample {
 public:
  /// Throws Error{not_found} if the recording, its motion or a named point does not exist, Error{bad_input} if the
  /// example lies outside the motion.
  RankedExample(const Example& example, const Segments& segments, const Movement* movement);

  const Shape& shape() const noexcept { return shape_; }
  /// Offers a span of a recording (numbered as in Segments) to a search for this example, unless its movement is not
  /// known or a quick test shows that it is too far.
  void offer(std::uint32_t id, std::uint32_t recording, TimeSpan span, NearestSearch& search);

 private:
  bool resample_point(const Point& point, std::uint32_t recording, FrameRange frames, PointShape& out) const;
  void load(std::uint32_t recording);

  const Movement* movement_;
  std::vector<Point> points_;
  std::vector<TracePoint> traced_;  ///< the same points if traces store all of them; else empty
  Shape shape_;
  Shape candidate_;
  std::optional<std::uint32_t> recording_;  ///< the one whose trace is loaded
  std::shared_ptr<const HandTrace> trace_;
  FrameClock clock_;
};

}  // namespace signweave
