#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/formats/bvh/bvh.h"

/// Small BVH texts for tests.
namespace signweave::bvh {

/// A root with six channels (positions, then ZXY), a JOINT per name in a chain under it with ZXY rotations, and the
/// given frames.
inline std::string chain(const std::vector<std::string>& names, const std::vector<std::string>& frames,
                         std::string_view frame_time = "0.01") {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition "
      "Zrotation Xrotation Yrotation\n";
  for (const std::string& name : names) {
    text += "JOINT " + name + "\n{\nOFFSET 0 10 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
  }
  text += "End Site\n{\nOFFSET 0 5 0\n}\n";
  for (std::size_t i = 0; i <= names.size(); ++i) text += "}\n";
  text += "MOTION\nFrames: " + std::to_string(frames.size()) + "\nFrame Time: " + std::string(frame_time) + "\n";
  for (const std::string& frame : frames) text += frame + "\n";
  return text;
}

/// A chain of which only the root moves: `declaration` is its CHANNELS line, `numbers` the only frame.
inline std::string one_joint(std::string_view declaration, std::string_view numbers,
                             std::string_view offset = "1 2 3") {
  return "HIERARCHY\nROOT R\n{\nOFFSET " + std::string(offset) + "\n" + std::string(declaration) +
         "\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n" + std::string(numbers) + "\n";
}

/// Reads without guesses: the file's axes are ours, its unit is the metre.
inline File read_plainly(std::string_view text) {
  return read_text("f.bvh", text, {.up = UpAxis::y, .unit = 1.0});
}

inline double degrees_between(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  const Eigen::Quaterniond turn = a.cast<double>().normalized().conjugate() * b.cast<double>().normalized();
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 57.29577951308232;
}

}  // namespace signweave::bvh
