#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

/// What a contact sheet shows. Texts are UTF-8 of any script; bytes that are none are replaced.
struct ContactSheetOptions {
  std::vector<std::int64_t> frames;   ///< which, in order; where none are given, `cells` frames evenly over the motion
  std::vector<std::string> captions;  ///< [cell], under the figures; where there are too few, the frame's time
  std::size_t cells = 24;             ///< how many frames where none are given
  std::size_t columns = 6;
  double turn = 0;    ///< degrees by which figures are turned to their left: 90 shows them from their right side
  std::string title;  ///< a line above, empty for none
  std::string note;   ///< a line below, empty for none, such as "placeholder shapes, not LSF"
};

/// A sheet of figures as an SVG document: the upper body from the front, as a signer's addressee sees it, all cells at
/// one scale with the hands inside. The signer's right is blue, the left orange, hands in a stronger tone; what is
/// farther away is paler. Where the skeleton has eyes there is a face, which shows the motion's scalar tracks. Sides,
/// hands, head are told by joint names; where those say nothing the figure is drawn in grey. The same input gives the
/// same bytes.
/// Throws Error{bad_input} for a motion without frames, a frame that it has not, or no columns.
std::string contact_sheet(const Motion& motion, const ContactSheetOptions& options = {});

}  // namespace signweave
