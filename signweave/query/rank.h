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

/// Where no limit is given, so many of the nearest are an answer to like(…).
inline constexpr std::size_t kNearest = 20;

/// The place of a query whose segments like(…) orders; none where it has none.
std::optional<std::size_t> ranked_place(const PhaseQuery& query) noexcept;
/// The example there. There must be one.
const Example& example_at(const PhaseQuery& query, std::size_t place) noexcept;

/// An example made ready for one database. Borrows the movement. For one thread.
class RankedExample {
 public:
  /// Throws Error{not_found} where the recording, its motion or a point that is named is not there, Error{bad_input}
  /// where the example lies outside of the motion.
  RankedExample(const Example& example, const Segments& segments, const Movement* movement);

  const Shape& shape() const noexcept { return shape_; }
  /// Offers a stretch of a recording (numbered as in Segments) to a search for this example, unless it is not known, or
  /// too far at a glance.
  void offer(std::uint32_t id, std::uint32_t recording, TimeSpan span, NearestSearch& search);

 private:
  bool resample_point(const Point& point, std::uint32_t recording, FrameRange frames, PointShape& out) const;
  void load(std::uint32_t recording);

  const Movement* movement_;
  std::vector<Point> points_;
  std::vector<TracePoint> traced_;  ///< the same where all of them are kept in traces; else empty
  Shape shape_;
  Shape candidate_;
  std::optional<std::uint32_t> recording_;  ///< whose trace is at hand
  std::shared_ptr<const HandTrace> trace_;
  FrameClock clock_;
};

}  // namespace signweave
