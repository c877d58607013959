#pragma once

#include <string>
#include <string_view>

#include "signweave/formats/bvh.h"

/// What a BVH file does not say: which axis is up and how long its unit is. Part of formats/bvh, not for others.
namespace signweave::bvh {

struct Guess {
  UpAxis up = UpAxis::y;
  double unit = 0.01;          ///< metres per file unit
  bool up_certain = true;      ///< false where the body gives no clear answer
  bool unit_certain = true;    ///< false where another unit may well be meant
  bool unit_plausible = true;  ///< false where none of the units gives a human body: cm stands in
  double stature = 0;          ///< what the guess rests on: metres at `unit`, 0 where no head and feet were found
  bool upside_down = false;    ///< the head is below the feet on the guessed axis
};

/// Guesses from a motion that is still in the file's units and axes (at least one frame).
/// Up is the axis along which the head lies above the feet, on average over posed frames: a rest pose may point
/// anywhere. The unit is the one of m, cm, mm, inch and CMU's 5.64 cm that brings the summed bones from a foot to the
/// top of the head nearest to 1.7 m, within 1.0 to 2.3 m.
/// `up` is used for the fallback (the extent of the body) where it is known already.
Guess guess_space(const Motion& motion, std::optional<UpAxis> up);

/// "cm", "inch", "0.0564 m".
std::string unit_name(double unit);

}  // namespace signweave::bvh
