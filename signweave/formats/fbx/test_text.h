#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// FBX 7.4 as text, for tests.
namespace signweave::fbx::test {

inline constexpr std::int64_t kSecond = 46'186'158'000;

struct TestCurve {
  std::vector<std::int64_t> ticks;
  std::vector<double> values;
  std::string attributes;  ///< KeyAttrFlags and so on, as text
};

struct TestNode {
  std::string name;
  std::string type = "LimbNode";
  int parent = -1;
  std::string properties;  ///< lines of Properties70, in addition to those below
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d scaling = Eigen::Vector3d::Ones();
  std::array<std::array<TestCurve, 3>, 3> curves{};  ///< translation, rotation, scaling by x, y, z; no ticks: none
};

struct TestFile {
  std::vector<TestNode> nodes;
  std::string settings = axes(1, 1, 2, 1, 0, 1) + unit(1) + time_mode(6);
  std::string stack;         ///< lines of the stack's Properties70
  std::string more_objects;  ///< in addition to the nodes and take 1
  std::string more_links;

  static std::string number(const char* name, double value) {
    return fmt::format("    P: \"{}\", \"double\", \"Number\", \"\",{:.17g}\n", name, value);
  }
  static std::string whole(const char* name, std::int64_t value) {
    return fmt::format("    P: \"{}\", \"int\", \"Integer\", \"\",{}\n", name, value);
  }
  static std::string vector(const char* name, const Eigen::Vector3d& value) {
    return fmt::format("    P: \"{}\", \"Vector3D\", \"Vector\", \"\",{:.17g},{:.17g},{:.17g}\n", name, value.x(),
                       value.y(), value.z());
  }
  static std::string axes(int up, int up_sign, int front, int front_sign, int coord, int coord_sign) {
    return whole("UpAxis", up) + whole("UpAxisSign", up_sign) + whole("FrontAxis", front) +
           whole("FrontAxisSign", front_sign) + whole("CoordAxis", coord) + whole("CoordAxisSign", coord_sign);
  }
  static std::string unit(double factor) { return number("UnitScaleFactor", factor); }
  static std::string time_mode(int mode) { return whole("TimeMode", mode); }
};

inline std::string text_of(const TestCurve& curve) {
  const auto list = [](const auto& numbers) {
    std::string text = fmt::format("*{} {{\n      a: ", numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) text += fmt::format("{}{}", i == 0 ? "" : ",", numbers[i]);
    return text + "\n    }\n";
  };
  return "    KeyTime: " + list(curve.ticks) + "    KeyValueFloat: " + list(curve.values) + curve.attributes;
}

inline std::string text_of(const TestFile& file) {
  std::string objects = "  AnimationStack: 1, \"AnimStack::first\", \"\" {\n   Properties70:  {\n" + file.stack +
                        "   }\n  }\n  AnimationLayer: 2, \"AnimLayer::base\", \"\" {\n  }\n";
  std::string links = "  C: \"OO\",2,1\n";
  constexpr std::array<const char*, 3> kKinds{"Lcl Translation", "Lcl Rotation", "Lcl Scaling"};
  std::int64_t next = 100'000;
  for (std::size_t i = 0; i < file.nodes.size(); ++i) {
    const TestNode& node = file.nodes[i];
    const auto id = static_cast<std::int64_t>(1000 + i);
    objects += fmt::format("  Model: {}, \"Model::{}\", \"{}\" {{\n   Version: 232\n   Properties70:  {{\n", id,
                           node.name, node.type) +
               TestFile::vector(kKinds[0], node.translation) + TestFile::vector(kKinds[1], node.rotation) +
               TestFile::vector(kKinds[2], node.scaling) + node.properties + "   }\n   Shading: T\n  }\n";
    links += fmt::format("  C: \"OO\",{},{}\n", id, node.parent < 0 ? 0 : 1000 + node.parent);
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const auto& curves = node.curves[kind];
      if (curves[0].ticks.empty() && curves[1].ticks.empty() && curves[2].ticks.empty()) continue;
      const std::int64_t curve_node = next++;
      objects += fmt::format("  AnimationCurveNode: {}, \"AnimCurveNode::\", \"\" {{\n  }}\n", curve_node);
      links += fmt::format("  C: \"OO\",{},2\n  C: \"OP\",{},{}, \"{}\"\n", curve_node, curve_node, id, kKinds[kind]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (curves[axis].ticks.empty()) continue;
        objects += fmt::format("  AnimationCurve: {}, \"AnimCurve::\", \"\" {{\n    Default: 0\n", next) +
                   text_of(curves[axis]) + "  }\n";
        links += fmt::format("  C: \"OP\",{},{}, \"d|{}\"\n", next++, curve_node, "XYZ"[axis]);
      }
    }
  }
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n  FBXVersion: 7400\n}\nGlobalSettings:  {\n  Properties70: "
         " {\n" +
         file.settings + "  }\n}\nObjects:  {\n" + objects + file.more_objects + "}\nConnections:  {\n" + links +
         file.more_links + "}\n";
}

}  // namespace signweave::fbx::test
