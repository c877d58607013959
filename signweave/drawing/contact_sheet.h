#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// What a contact sheet shows. Texts are UTF-8 of any script; bytes that are none are replaced.
struct ContactSheetOptions {
  std::vector<std::int64_t> frames;  ///< which, in order; where none are given, `cells` frames evenly over the motion
  std::vector<std::string>
      captions;  ///< [cell], under the figures, a long one in two lines about its " → "; too few: the frame's time
  std::size_t cells = 24;  ///< how many frames where none are given
  /// How many of the given frames are shown at most, 0 for all. The most important are kept, those of equal importance
  /// evenly, and the note says how many of how many there are.
  std::size_t most_cells = 0;
  std::vector<int> importance;  ///< [cell] of the given frames, more is kept rather; where there are too few, 0
  std::size_t columns = 6;
  double turn = 0;  ///< degrees by which figures are turned to their left: 90 shows them from their right side
  bool signing_space = false;  ///< the signer's heights and zones behind each figure (docs/signing-space.md)
  std::optional<RigMap> rig;   ///< which joint is what; where none is given, `map_rig` tells
  std::string title;           ///< a line above, empty for none
  std::string note;            ///< a line below, empty for none, such as "placeholder shapes, not LSF"
};

/// A sheet of figures as an SVG document: the upper body from the front, as a signer's addressee sees it, all cells at
/// one scale but those few that are much wider or higher than the rest, with the hands inside. The signer's right is
/// blue, the left orange, hands in a stronger tone; what is farther away is paler. Where the skeleton has eyes or the
/// motion has a face's scalar tracks there is a face, which shows them. Sides, hands, head are told by joint names,
/// arms and hips by the body's shape where those say nothing; what neither tells is drawn in grey. The same input gives
/// the same bytes. Throws Error{bad_input} for a motion without frames, a frame that it has not, or no columns;
/// Error{not_found} where a signing space is to be drawn and the motion has none.
std::string contact_sheet(const Motion& motion, const ContactSheetOptions& options = {});

}  // namespace signweave
