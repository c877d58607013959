#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "signweave/drawing/figure.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// A locus to mark in a drawing.
struct MarkedLocus {
  std::string name;                              ///< without "@"; of any script
  Eigen::Vector3f at = Eigen::Vector3f::Zero();  ///< signer-centred, shoulder widths
};

/// A locus that is farther away gets no room in a drawing, but is marked at its edge, shoulder widths.
inline constexpr float kFarthestDrawn = 1.6f;

/// Appends a ring with a cross and its name for each locus, as SVG elements in a cell of the given size in pixels. One
/// that lies outside the cell is a dashed ring at its edge.
void draw_loci(std::span<const MarkedLocus> loci, const SignerSpace& space, const FigureView& view, double width,
               double height, std::string& out);

/// A ring with a cross in it at a point in pixels; its name is to the right, or to the left of the ring.
struct LocusMark {
  double x = 0, y = 0;
  double size = 7;       ///< of the name, pixels
  bool outside = false;  ///< dashed
  bool name_to_left = false;
};
void draw_locus(const LocusMark& mark, std::string_view name, std::string& out);

}  // namespace signweave
