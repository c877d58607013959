#pragma once

#include <limits>
#include <string>
#include <vector>

namespace signweave {

/// A value with its interval; NaN if absent.
struct ErrorMark {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// Marks that belong together, such as those of one method.
struct ErrorRow {
  std::string name;
  std::vector<ErrorMark> marks;  ///< [position]
};

/// One plot: positions along the bottom, values upwards.
struct ErrorPanel {
  std::string title;
  std::vector<std::string> places;
  std::vector<ErrorRow> rows;
};

/// Draws panels one below another as an SVG: each row is a line through its marks, with a vertical bar at each for the
/// interval and its name at the right. Rows differ in colour, dash and name. Every mark shows its values when the
/// pointer is over it. The axis begins at 0. Text of any script is escaped.
std::string error_plot(const std::vector<ErrorPanel>& panels);

}  // namespace signweave
