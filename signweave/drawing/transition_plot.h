#pragma once

#include <string>
#include <vector>

namespace signweave {

/// One transition as a bar. All in milliseconds.
struct TransitionBar {
  std::string from;  ///< gloss
  std::string to;
  double begin = 0;        ///< annotation time, for whoever points at the bar
  double retraction = 0;   ///< the bar's lower part
  double preparation = 0;  ///< its upper part
  double whole = 0;        ///< what is left of it between the parts is neither
};

/// The transitions of one recording.
struct TransitionPanel {
  std::string title;
  std::vector<TransitionBar> bars;  ///< in order
  double mean = 0;                  ///< of `whole`, milliseconds
  double deviation = 0;
  bool inferred = false;  ///< only the whole is known: gaps between signs without phases
};

/// The paper's figure 4 as an SVG: a panel for each recording, in it a bar for each transition, split into retraction
/// (below, dark) and preparation (above, light), the mean as a heavy line over a band of one standard deviation to
/// either side, milliseconds at the axis, all panels on one scale. Pairs of glosses stand under the bars where there is
/// room for them; every bar tells its own when it is pointed at. A panel of more than kBarsPerRow bars goes on in
/// further rows. Text of any script is escaped.
std::string transition_plot(const std::vector<TransitionPanel>& panels);

inline constexpr std::size_t kBarsPerRow = 200;

}  // namespace signweave
