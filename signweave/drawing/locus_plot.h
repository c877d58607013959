#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "signweave/drawing/locus_marks.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// Where a palm is at both ends of one stroke; signer-centred, shoulder widths.
struct StrokeEnds {
  Eigen::Vector3f begin = Eigen::Vector3f::Zero();
  Eigen::Vector3f end = Eigen::Vector3f::Zero();
  std::string label;  ///< shown when the pointer is over it
};

/// The tokens of one gloss.
struct LocusPanel {
  std::string title;
  std::vector<StrokeEnds> tokens;
};

/// Draws the signing space from the front, as the addressee sees it, and from above, with the ends of strokes, as an
/// SVG: a row for each gloss, an open circle for each begin, a filled one for each end, and a line between them. The
/// signer's left is on the right in both; from above, the signer looks down the page. `body` gives the heights; loci
/// outside the picture or beyond kFarthestDrawn are left out. Text of any script is escaped; tokens must be finite.
std::string locus_plot(std::span<const LocusPanel> panels, const SignerBody& body, std::span<const MarkedLocus> loci);

}  // namespace signweave
