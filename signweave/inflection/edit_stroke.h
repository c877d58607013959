#pragma once

#include <span>

#include "signweave/inflection/fit_change.h"
#include "signweave/space/change.h"
#include "signweave/space/locus.h"

namespace signweave {

/// Moves, turns and scales a stroke as SpaceChange says: the palm goes to h + move + turn · scale · size · (palm − h₀),
/// h₀ its place in the stroke's first frame and h that of the movement scaled by `size` about its middle; the hand
/// turns with it. Hands that touch keep to each other; if both move without touching, each goes by the same map.
FittedChange edit_stroke(StrokeChanger& changer, const CapturedStroke& stroke, const SpaceChange& change);

/// Takes the hand along some places with its captured handshape, smoothly and as fast as it moved in the capture; it
/// turns about the vertical with its path, unless `keeps_turn`. Needs at least two places.
FittedChange take_along(StrokeChanger& changer, const CapturedStroke& stroke, std::span<const Locus> places,
                        bool keeps_turn);

/// Takes the movement past a place: the palm is there halfway through the stroke. The movement turns as the hand does,
/// about the vertical, by the difference of the places' azimuths, unless `keeps_turn`.
FittedChange take_past(StrokeChanger& changer, const CapturedStroke& stroke, const Locus& place, bool keeps_turn);

}  // namespace signweave
