#pragma once

#include <string>
#include <string_view>

#include "signweave/formats/bvh/bvh.h"

/// Guesses what a BVH file does not say: which axis is up, and the length of its unit. Internal to formats/bvh.
namespace signweave::bvh {

struct Guess {
  UpAxis up = UpAxis::y;
  double unit = 0.01;          ///< metres per file unit
  bool up_certain = true;      ///< false if the body gives no clear answer
  bool upside_down = false;    ///< the head is below the feet on the guessed axis
  double stature = 0;          ///< metres at `unit`: the bone lengths from foot to head, or the extent of the body
  bool has_bones = true;       ///< false if head and feet were not found by name, so that the extent is used
  bool unit_plausible = true;  ///< false if no unit gives a human body, so that cm is used
};

/// Guesses from a motion of at least one frame that is still in the file's units and axes.
/// Up is the axis along which the head lies above the feet, averaged over posed frames, because a rest pose may point
/// anywhere. The unit is the one of m, cm, mm, inch and CMU's 5.64 cm for which the summed bone lengths from a foot to
/// the top of the head are nearest to 1.7 m, within 1.0 to 2.3 m.
/// If the joint names identify no head and feet, the extent of the posed body along y and z is used for both.
/// If `up` is given, it is not guessed.
Guess guess_space(const Motion& motion, std::optional<UpAxis> up);

/// "cm", "inch", "0.0564 m".
std::string unit_name(double unit);

/// "cm (stature 1.71 m)": the unit and the evidence for it.
std::string unit_reason(const Guess& guess);

}  // namespace signweave::bvh
