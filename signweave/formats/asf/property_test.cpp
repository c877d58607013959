// A skeleton and its frames are generated, written as text and read. The positions of all joints and tips are then
// compared with an evaluator in this file, which follows each bone up to the root with matrices of double precision.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "signweave/formats/asf/asf.h"
#include "signweave/motion/kinematics.h"

namespace signweave::asf {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct DrawnBone {
  int parent = -1;  ///< the root is 0
  Vector3d direction = Vector3d::Zero();
  double length = 0;
  Vector3d axis = Vector3d::Zero();  ///< for the root, its orientation
  std::string order = "XYZ";
  std::vector<std::string> dofs;
};

struct DrawnSkeleton {
  std::vector<DrawnBone> bones;
  Vector3d position = Vector3d::Zero();
  double length_unit = 1;
  bool radians = false;      ///< of the skeleton
  bool amc_radians = false;  ///< of the frames
  bool crlf = false;
  bool z_up = false;
  std::vector<std::vector<std::vector<double>>> frames;  ///< [frame][bone][dof]
  std::vector<std::vector<int>> orders;                  ///< [frame], of the bones
};

constexpr double kUnit = 0.05;  ///< metres

double drawn_number(double size) {
  return size * *rc::gen::inRange(-100'000, 100'001) / 100'000.0;
}
Vector3d drawn_vector(double size) {
  const double x = drawn_number(size);
  const double y = drawn_number(size);
  return {x, y, drawn_number(size)};
}

template <typename T>
std::vector<T> shuffled(std::vector<T> values) {
  for (std::size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[*rc::gen::inRange<std::size_t>(0, i)]);
  }
  return values;
}

std::vector<std::string> drawn_dofs(std::vector<std::string> all, std::size_t least) {
  all = shuffled(std::move(all));
  all.resize(*rc::gen::inRange<std::size_t>(least, all.size() + 1));
  return all;
}

DrawnSkeleton draw() {
  DrawnSkeleton drawn;
  drawn.radians = *rc::gen::arbitrary<bool>();
  drawn.amc_radians = *rc::gen::arbitrary<bool>();
  drawn.crlf = *rc::gen::arbitrary<bool>();
  drawn.z_up = *rc::gen::arbitrary<bool>();
  drawn.length_unit = *rc::gen::element(1.0, 0.45, 2.54);
  drawn.position = drawn_vector(10 * drawn.length_unit);
  const double turn = drawn.radians ? std::numbers::pi : 180.0;
  const int count = *rc::gen::inRange(1, 9);
  for (int i = 0; i < count; ++i) {
    DrawnBone bone;
    bone.parent = i == 0 ? -1 : *rc::gen::inRange(0, i);
    bone.order = *rc::gen::element<std::string>("XYZ", "XZY", "YXZ", "yzx", "ZXY", "ZYX");
    bone.axis = drawn_vector(turn);
    bone.dofs = i == 0 ? drawn_dofs({"TX", "TY", "TZ", "RX", "RY", "RZ"}, 1)
                       : drawn_dofs({"tx", "ty", "tz", "rx", "ry", "rz", "l"}, 0);
    if (i > 0) {
      bone.length = std::abs(drawn_number(10)) * drawn.length_unit;
      bone.direction = drawn_vector(1);
      bone.direction = bone.direction.norm() < 0.1 ? Vector3d(0, 1, 0) : Vector3d(bone.direction.normalized());
    }
    drawn.bones.push_back(bone);
  }
  const int frames = *rc::gen::inRange(1, 4);
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<std::vector<double>> numbers;
    std::vector<int> order;
    for (int i = 0; i < count; ++i) {
      const DrawnBone& bone = drawn.bones[static_cast<std::size_t>(i)];
      numbers.emplace_back();
      if (!bone.dofs.empty()) order.push_back(i);
      for (const std::string& dof : bone.dofs) {
        const bool turns = dof[0] == 'r' || dof[0] == 'R';
        const double size = turns ? 2 * (drawn.amc_radians ? std::numbers::pi : 180.0) : 5 * drawn.length_unit;
        numbers.back().push_back(drawn_number(size));
      }
    }
    drawn.frames.push_back(std::move(numbers));
    drawn.orders.push_back(shuffled(std::move(order)));
  }
  return drawn;
}

std::string bone_name(int i) {
  return i == 0 ? "root" : "bone" + std::to_string(i);
}

std::string ended(const DrawnSkeleton& drawn, const std::string& text) {
  if (!drawn.crlf) return text;
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

std::string three(const Vector3d& v) {
  return fmt::format("{} {} {}", v.x(), v.y(), v.z());
}

std::string asf_text(const DrawnSkeleton& drawn) {
  const DrawnBone& root = drawn.bones[0];
  std::string text = fmt::format(
      ":version 1.10\n:units\n length {}\n angle {}\n:root\n order {}\n axis {}\n position {}\n", drawn.length_unit,
      drawn.radians ? "rad" : "deg", fmt::join(root.dofs, " "), root.order, three(drawn.position));
  text += fmt::format(" orientation {}\n:bonedata\n", three(root.axis));
  std::vector<int> order;
  for (int i = 1; i < static_cast<int>(drawn.bones.size()); ++i) order.push_back(i);
  for (const int i : shuffled(order)) {
    const DrawnBone& bone = drawn.bones[static_cast<std::size_t>(i)];
    text += fmt::format(" begin\n id {}\n name {}\n direction {}\n length {:e}\n axis {} {}\n", i, bone_name(i),
                        three(bone.direction), bone.length, three(bone.axis), bone.order);
    if (!bone.dofs.empty()) text += fmt::format(" dof {}\n", fmt::join(bone.dofs, " "));
    text += " end # of it\n";
  }
  text += ":hierarchy\n begin\n";
  for (const int i : shuffled(order)) {
    text += fmt::format(" {} {}\n", bone_name(drawn.bones[static_cast<std::size_t>(i)].parent), bone_name(i));
  }
  return ended(drawn, text + " end\n");
}

std::string amc_text(const DrawnSkeleton& drawn) {
  std::string text = fmt::format("# numbers\n:FULLY-SPECIFIED\n{}\n", drawn.amc_radians ? ":RADIANS" : ":DEGREES");
  for (std::size_t frame = 0; frame < drawn.frames.size(); ++frame) {
    text += fmt::format("{}\n", frame + 1);
    for (const int bone : drawn.orders[frame]) {
      text +=
          fmt::format("{} {}\n", bone_name(bone), fmt::join(drawn.frames[frame][static_cast<std::size_t>(bone)], " "));
    }
  }
  return ended(drawn, text);
}

Matrix3d about_axis(char axis, double radians) {
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  Matrix3d m;
  if (axis == 'x') m << 1, 0, 0, 0, c, -s, 0, s, c;
  if (axis == 'y') m << c, 0, s, 0, 1, 0, -s, 0, c;
  if (axis == 'z') m << c, -s, 0, s, c, 0, 0, 0, 1;
  return m;
}

char small(char c) {
  return static_cast<char>(c | 0x20);
}

Matrix3d axes_of(const DrawnBone& bone, bool radians) {
  Matrix3d m = Matrix3d::Identity();
  for (const char letter : bone.order) {
    const char axis = small(letter);
    m = Matrix3d(about_axis(axis, bone.axis[axis - 'x'] * (radians ? 1 : std::numbers::pi / 180)) * m);
  }
  return m;
}

/// A bone's own transform: parent_from_bone.
Eigen::Isometry3d local_of(const DrawnSkeleton& drawn, std::size_t frame, int index) {
  const auto at = static_cast<std::size_t>(index);
  const DrawnBone& bone = drawn.bones[at];
  const double radian = drawn.amc_radians ? 1 : std::numbers::pi / 180;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  for (std::size_t d = 0; d < bone.dofs.size(); ++d) {
    const double number = drawn.frames[frame][at][d];
    const char kind = small(bone.dofs[d][0]);
    if (kind == 'r') motion.linear() = Matrix3d(about_axis(small(bone.dofs[d][1]), number * radian) * motion.linear());
    if (kind == 't') motion.translation()[small(bone.dofs[d][1]) - 'x'] = number;
  }
  Eigen::Isometry3d axes = Eigen::Isometry3d::Identity();
  axes.linear() = axes_of(bone, drawn.radians);
  if (index == 0) return Eigen::Translation3d(drawn.position) * motion * axes;
  const auto on = static_cast<std::size_t>(bone.parent);
  const DrawnBone& parent = drawn.bones[on];
  double length = parent.length;
  for (std::size_t d = 0; d < parent.dofs.size(); ++d) {
    if (parent.dofs[d] == "l") length += drawn.frames[frame][on][d];
  }
  return Eigen::Translation3d(parent.direction * length) * axes * motion * axes.inverse();
}

Eigen::Isometry3d global_of(const DrawnSkeleton& drawn, std::size_t frame, int index) {
  Eigen::Isometry3d result = local_of(drawn, frame, index);
  for (int on = drawn.bones[static_cast<std::size_t>(index)].parent; on >= 0;
       on = drawn.bones[static_cast<std::size_t>(on)].parent) {
    result = local_of(drawn, frame, on) * result;
  }
  return result;
}

RC_GTEST_PROP(AsfProperty, JointsAndTipsAreWhereMatricesPutThem, ()) {
  const DrawnSkeleton drawn = draw();
  const std::string asf = asf_text(drawn);
  const std::string amc = amc_text(drawn);
  RC_LOG() << asf << amc;
  const ReadOptions options{
      .unit = kUnit, .up = drawn.z_up ? bvh::UpAxis::z : bvh::UpAxis::y, .rate = FrameRate{120, 1}};
  const Motion motion = read_text("drawn.asf", asf, "drawn.amc", amc, options).motion;
  RC_ASSERT(motion.frame_count() == static_cast<std::int64_t>(drawn.frames.size()));
  RC_ASSERT(motion.skeleton().joint_count() == drawn.bones.size());
  RC_ASSERT(keeps_hemisphere(motion));

  Matrix3d up = Matrix3d::Identity();
  if (drawn.z_up) up << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const double metres = kUnit / drawn.length_unit;
  for (std::size_t frame = 0; frame < drawn.frames.size(); ++frame) {
    const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(static_cast<std::int64_t>(frame)));
    for (int i = 0; i < static_cast<int>(drawn.bones.size()); ++i) {
      const Eigen::Isometry3d should = global_of(drawn, frame, i);
      const JointIndex joint = motion.skeleton().find(bone_name(i)).value();
      const auto at = static_cast<std::size_t>(joint);
      const Vector3d place = up * should.translation() * metres;
      RC_ASSERT((pose.positions[at].cast<double>() - place).norm() < 1e-5);
      const Matrix3d turn = up * should.linear() * up.transpose();
      const Eigen::Quaterniond is = pose.rotations[at].cast<double>().normalized();
      RC_ASSERT(is.angularDistance(Eigen::Quaterniond(turn)) * 180 / std::numbers::pi < 0.01);
      const bool has_child =
          std::any_of(drawn.bones.begin(), drawn.bones.end(), [&](const DrawnBone& bone) { return bone.parent == i; });
      const auto tip = std::find_if(motion.skeleton().tips().begin(), motion.skeleton().tips().end(),
                                    [&](const Tip& one) { return one.joint == joint; });
      RC_ASSERT((tip == motion.skeleton().tips().end()) == has_child);
      if (has_child) continue;
      const DrawnBone& bone = drawn.bones[static_cast<std::size_t>(i)];
      const Vector3d end = up * (should * (bone.direction * bone.length)) * metres;
      RC_ASSERT((position_of(*tip, pose).cast<double>() - end).norm() < 1e-5);
    }
  }
}

// The format does not contain the number of frames: a truncated file is refused, or leaves the preceding frames
// unchanged; only the last number may have lost digits.
RC_GTEST_PROP(AsfProperty, FramesCutOffAreFewerOrRefused, ()) {
  const DrawnSkeleton drawn = draw();
  const std::string asf = asf_text(drawn);
  const std::string amc = amc_text(drawn);
  const auto size = *rc::gen::inRange<std::size_t>(0, amc.size());
  const ReadOptions options{.unit = kUnit};
  const Motion whole = read_text("a", asf, "b", amc, options).motion;
  try {
    const Motion cut = read_text("a", asf, "b", std::string_view(amc).substr(0, size), options).motion;
    RC_ASSERT(cut.frame_count() > 0 && cut.frame_count() <= whole.frame_count());
    const FrameRange before{0, cut.frame_count() - 1};
    RC_ASSERT(same_bits(cut.slice(before), whole.slice(before)));
  } catch (const Error& error) {
    RC_ASSERT(error.code() == ErrorCode::bad_input);
  }
}

}  // namespace
}  // namespace signweave::asf
