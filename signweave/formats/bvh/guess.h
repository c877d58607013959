#pragma once

#include <string>
#include <string_view>

#include "signweave/formats/bvh/bvh.h"

/// What a BVH file does not say: which axis is up and how long its unit is. Part of formats/bvh, not for others.
namespace signweave::bvh {

struct Guess {
  UpAxis up = UpAxis::y;
  double unit = 0.01;          ///< metres per file unit
  bool up_certain = true;      ///< false where the body gives no clear answer
  bool upside_down = false;    ///< the head is below the feet on the guessed axis
  double stature = 0;          ///< metres at `unit`: the bones from foot to head, or the extent of the body
  bool has_bones = true;       ///< false where no head and feet were found by name: the extent stands in
  bool unit_plausible = true;  ///< false where none of the units gives a human body: cm stands in
};

/// Guesses from a motion that is still in the file's units and axes (at least one frame).
/// Up is the axis along which the head lies above the feet, on average over posed frames: a rest pose may point
/// anywhere. The unit is the one of m, cm, mm, inch and CMU's 5.64 cm that brings the summed bones from a foot to the
/// top of the head nearest to 1.7 m, within 1.0 to 2.3 m.
/// Where the names of joints tell no head and feet, the extent of the posed body along y and z stands for both.
/// `up` is not guessed where it is given.
Guess guess_space(const Motion& motion, std::optional<UpAxis> up);

/// "cm", "inch", "0.0564 m".
std::string unit_name(double unit);

/// "cm (stature 1.71 m)": the unit and what speaks for it.
std::string unit_reason(const Guess& guess);

}  // namespace signweave::bvh
