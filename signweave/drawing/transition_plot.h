#pragma once

#include <string>
#include <vector>

namespace signweave {

/// One transition as a bar. All times in milliseconds.
struct TransitionBar {
  std::string from;  ///< gloss
  std::string to;
  double begin = 0;        ///< annotation time, shown when the pointer is over the bar
  double retraction = 0;   ///< the bar's lower part
  double preparation = 0;  ///< its upper part
  double whole = 0;        ///< the remainder between the two parts is neither
};

/// The transitions of one recording.
struct TransitionPanel {
  std::string title;
  std::vector<TransitionBar> bars;  ///< in order
  double mean = 0;                  ///< of `whole`, milliseconds
  double deviation = 0;
  bool inferred = false;  ///< only `whole` is known: gaps between signs without phases
};

/// Draws the paper's figure 4 as an SVG: a panel for each recording with a bar for each transition, split into
/// retraction (below, dark) and preparation (above, light). The mean is a heavy line over a band of one standard
/// deviation to either side; the axis is in milliseconds, and all panels have one scale. Pairs of glosses are shown
/// under the bars if there is room for them; every bar shows its own when the pointer is over it. A panel of more than
/// kBarsPerRow bars continues in further rows. Text of any script is escaped.
std::string transition_plot(const std::vector<TransitionPanel>& panels);

inline constexpr std::size_t kBarsPerRow = 200;

}  // namespace signweave
