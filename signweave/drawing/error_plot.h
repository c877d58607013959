#pragma once

#include <limits>
#include <string>
#include <vector>

namespace signweave {

/// A figure with its interval; not numbers where there is none.
struct ErrorMark {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// What belongs together, such as one method.
struct ErrorRow {
  std::string name;
  std::vector<ErrorMark> marks;  ///< [place]
};

/// One plot: places along the bottom, figures up.
struct ErrorPanel {
  std::string title;
  std::vector<std::string> places;
  std::vector<ErrorRow> rows;
};

/// Panels below each other as an SVG: for each row a line through its marks, an interval as an upright bar at each, its
/// name at the right. Rows are told apart by colour, dash and name. Every mark tells its figures when it is pointed at.
/// The axis begins at 0. Text of any script is escaped.
std::string error_plot(const std::vector<ErrorPanel>& panels);

}  // namespace signweave
