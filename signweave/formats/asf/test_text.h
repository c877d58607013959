#pragma once

#include <string>

/// For tests: small skeletons as text.
namespace signweave::asf {

struct OneBone {
  std::string angle = "deg";
  std::string length_unit = "1";
  std::string order = "TX TY TZ";
  std::string root = "position 0 0 0";
  std::string axis = "0 0 0 XYZ";
  std::string dof = "rx ry rz";  ///< empty for none
};

/// A root with the child bone `bone` along x, 2 long.
inline std::string one_bone(const OneBone& of) {
  return ":version 1.10\n:units\nlength " + of.length_unit + "\nangle " + of.angle + "\n:root\norder " + of.order +
         "\naxis XYZ\n" + of.root + "\n:bonedata\nbegin\nname bone\ndirection 1 0 0\nlength 2\naxis " + of.axis + "\n" +
         (of.dof.empty() ? "" : "dof " + of.dof + "\n") + "end\n:hierarchy\nbegin\nroot bone\nend\n";
}

/// The same, with `last` as the child of `bone` along y, 1 long.
inline std::string two_bones(const std::string& axis, const std::string& dof, const std::string& first_dof = "rz") {
  std::string text = one_bone({.dof = first_dof});
  text.insert(text.find(":hierarchy"),
              "begin\nname last\ndirection 0 1 0\nlength 1\naxis " + axis + "\ndof " + dof + "\nend\n");
  return text.replace(text.find("root bone\n"), 10, "root bone\nbone last\n");
}

}  // namespace signweave::asf
