#pragma once

#include <string>

#include "signweave/drawing/figure.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// Appends a signer's heights as labelled lines, and the borders of the zones across and in front, as SVG elements in a
/// cell of the given size in pixels. They turn with the signer: a plane seen edge-on is a line.
void draw_signing_space(const SignerBody& body, const SignerSpace& space, const FigureView& view, double width,
                        double height, std::string& out);

}  // namespace signweave
