#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signweave/drawing/locus_marks.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// What a contact sheet shows. Texts are UTF-8 of any script; invalid bytes are replaced.
struct ContactSheetOptions {
  std::vector<std::int64_t> frames;  ///< in order; if empty, `cells` frames spaced evenly over the motion
  std::vector<std::string>
      captions;  ///< [cell], below the figures; a long one is split at its " → "; missing ones show the frame's time
  std::size_t cells = 24;  ///< number of frames if `frames` is empty
  /// The maximum number of the given frames to show; 0 for all. The most important are kept, evenly spaced among those
  /// of equal importance, and the note gives both numbers.
  std::size_t most_cells = 0;
  std::vector<int> importance;  ///< [cell] of the given frames; higher values are kept first; missing ones are 0
  std::size_t columns = 6;
  double turn = 0;  ///< degrees by which figures are turned to their left: 90 shows them from their right side
  bool signing_space = false;     ///< the signer's heights and zones behind each figure (docs/signing-space.md)
  bool from_above = false;        ///< figures are seen from above, looking down the page, without heights and zones
  std::vector<MarkedLocus> loci;  ///< marked in front of each figure, where they are relative to the signer
  std::optional<RigMap> rig;      ///< which joint is which; if not given, the result of `map_rig`
  std::string title;              ///< a line above; empty for no title
  std::string note;               ///< a line below, such as "placeholder shapes, not LSF"; empty for no note
};

/// Draws a sheet of figures as an SVG document: the upper body from the front, as a signer's addressee sees it. All
/// cells have one scale in which the hands fit, except for the few that are much wider or higher than the rest. The
/// signer's right is blue, the left orange, hands in a stronger tone; more distant parts are paler. If the skeleton has
/// eyes or the motion has a face's scalar tracks, a face shows them. Sides, hands and head come from joint names; if
/// the names do not identify arms and hips, the body's shape does; what neither identifies is drawn in grey. The same
/// input gives the same bytes. Throws Error{bad_input} for a motion without frames, a frame outside the motion, or no
/// columns; Error{not_found} if a signing space, loci or a view from above is requested and the motion has no
/// shoulders.
std::string contact_sheet(const Motion& motion, const ContactSheetOptions& options = {});

}  // namespace signweave
