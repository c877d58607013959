#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "signweave/formats/fbx/fbx.h"
#include "signweave/formats/fbx/test_text.h"
#include "signweave/motion/kinematics.h"

namespace signweave::fbx {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::kSecond;
using test::TestFile;
using test::TestNode;

/// A number of at most `most` with three decimals, so that text and file hold the same value.
double some_number(int most) {
  return *rc::gen::inRange(-most * 1000, most * 1000 + 1) / 1000.0;
}
Vector3d some_vector(int most) {
  return {some_number(most), some_number(most), some_number(most)};
}

/// The matrix of a node according to the formula in FBX' documentation, independent of the reader.
struct Formula {
  Vector3d pre = Vector3d::Zero(), post = Vector3d::Zero(), rotation_offset = Vector3d::Zero(),
           rotation_pivot = Vector3d::Zero(), scaling_offset = Vector3d::Zero(), scaling_pivot = Vector3d::Zero();
  int order = 0;

  static Affine3d turned(const Vector3d& degrees, int order) {
    const auto about = [&](int axis) {
      return Affine3d(Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180, Vector3d::Unit(axis)));
    };
    switch (order) {  // the leftmost matrix turns last
      case 0:
        return about(2) * about(1) * about(0);
      case 1:
        return about(1) * about(2) * about(0);
      case 2:
        return about(0) * about(2) * about(1);
      case 3:
        return about(2) * about(0) * about(1);
      case 4:
        return about(1) * about(0) * about(2);
      default:
        return about(0) * about(1) * about(2);
    }
  }
  static Affine3d moved(const Vector3d& by) { return Affine3d(Eigen::Translation3d(by)); }

  Affine3d local(const Vector3d& translation, const Vector3d& rotation, const Vector3d& scaling) const {
    return moved(translation) * moved(rotation_offset) * moved(rotation_pivot) * turned(pre, 0) *
           turned(rotation, order) * turned(post, 0).inverse() * moved(rotation_pivot).inverse() *
           moved(scaling_offset) * moved(scaling_pivot) * Affine3d(Eigen::Scaling(scaling)) *
           moved(scaling_pivot).inverse();
  }
  std::string text() const {
    return TestFile::whole("RotationActive", 1) + TestFile::whole("RotationOrder", order) +
           TestFile::vector("PreRotation", pre) + TestFile::vector("PostRotation", post) +
           TestFile::vector("RotationOffset", rotation_offset) + TestFile::vector("RotationPivot", rotation_pivot) +
           TestFile::vector("ScalingOffset", scaling_offset) + TestFile::vector("ScalingPivot", scaling_pivot) +
           // Moves meshes only.
           TestFile::vector("GeometricTranslation", Vector3d(3, 4, 5)) +
           TestFile::vector("GeometricRotation", Vector3d(30, 40, 50));
  }
};

double value_at(const test::TestCurve& curve, std::int64_t tick, double otherwise) {
  if (curve.ticks.empty()) return otherwise;
  const auto next = std::upper_bound(curve.ticks.begin(), curve.ticks.end(), tick);
  if (next == curve.ticks.begin()) return curve.values.front();
  const auto key = static_cast<std::size_t>(next - curve.ticks.begin()) - 1;
  if (next == curve.ticks.end()) return curve.values.back();
  const double part =
      static_cast<double>(tick - curve.ticks[key]) / static_cast<double>(curve.ticks[key + 1] - curve.ticks[key]);
  return curve.values[key] + (curve.values[key + 1] - curve.values[key]) * part;
}

Vector3d vector_at(const TestNode& node, std::size_t kind, std::int64_t tick) {
  const Vector3d own = kind == 0 ? node.translation : kind == 1 ? node.rotation : node.scaling;
  Vector3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    result[axis] = value_at(node.curves[kind][i], tick, own[axis]);
  }
  return result;
}

/// Keys at some frames, at 30 a second from `begin`, possibly on some axes only.
void add_some_keys(TestNode& node, std::size_t kind, std::int64_t begin, int frames, int most) {
  for (test::TestCurve& curve : node.curves[kind]) {
    if (*rc::gen::inRange(0, 4) == 0) continue;
    for (int frame = 0; frame < frames; ++frame) {
      const bool end = frame == 0 || frame == frames - 1;
      if (!end && *rc::gen::inRange(0, 3) == 0) continue;
      curve.ticks.push_back(begin + frame * (kSecond / 30));
      curve.values.push_back(some_number(most));
    }
  }
}

struct Case {
  TestFile file;
  std::vector<Formula> formulas;
  std::int64_t begin = 0;
  int frames = 0;
};

Case some_case() {
  Case made;
  made.begin = *rc::gen::inRange(-3, 100) * (kSecond / 30);
  made.frames = *rc::gen::inRange(2, 7);
  const int count = *rc::gen::inRange(1, 7);
  const bool pivots = *rc::gen::arbitrary<bool>();
  for (int i = 0; i < count; ++i) {
    Formula formula;
    formula.order = *rc::gen::inRange(0, 6);
    if (*rc::gen::arbitrary<bool>()) formula.pre = some_vector(180);
    if (*rc::gen::arbitrary<bool>()) formula.post = some_vector(180);
    if (pivots) {
      formula.rotation_offset = some_vector(20);
      formula.rotation_pivot = some_vector(20);
      formula.scaling_offset = some_vector(20);
      formula.scaling_pivot = some_vector(20);
    }
    TestNode node{.name = fmt::format("Someone:bone{}", i)};
    node.parent = i == 0 ? -1 : *rc::gen::inRange(0, i);
    node.translation = some_vector(60);
    node.rotation = some_vector(400);
    if (*rc::gen::inRange(0, 3) == 0) node.scaling = Vector3d::Constant(*rc::gen::inRange(1, 300) / 100.0);
    node.properties = formula.text();
    if (*rc::gen::inRange(0, 4) == 0) add_some_keys(node, 0, made.begin, made.frames, 60);
    if (i == 0 || *rc::gen::inRange(0, 4) != 0) add_some_keys(node, 1, made.begin, made.frames, 400);
    made.file.nodes.push_back(std::move(node));
    made.formulas.push_back(formula);
  }
  // A take needs a key at its beginning and at its end.
  made.file.nodes[0].curves[1][0] = {.ticks = {made.begin, made.begin + (made.frames - 1) * (kSecond / 30)},
                                     .values = {some_number(300), some_number(300)},
                                     .attributes = {}};
  return made;
}

// Compares the whole transform at every frame with the formula's matrices, multiplied down the tree.
RC_GTEST_PROP(Fbx, EveryBoneStandsAndTurnsAsTheFormulaSays, ()) {
  const Case made = some_case();
  const double metres = *rc::gen::element(1.0, 2.54, 100.0);
  TestFile file = made.file;
  file.settings = TestFile::axes(1, 1, 2, 1, 0, 1) + TestFile::unit(metres) + TestFile::time_mode(6);
  const File read = read_bytes("made", test::text_of(file));
  RC_ASSERT(read.motion.frame_count() == made.frames);
  RC_ASSERT(read.motion.rate() == (FrameRate{30, 1}));
  RC_ASSERT(keeps_hemisphere(read.motion));

  for (int frame = 0; frame < made.frames; ++frame) {
    const std::int64_t tick = made.begin + frame * (kSecond / 30);
    std::map<std::string, Affine3d> expected;
    std::vector<Affine3d> globals;
    double size = 0;
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
      const TestNode& node = file.nodes[i];
      Affine3d global =
          made.formulas[i].local(vector_at(node, 0, tick), vector_at(node, 1, tick), vector_at(node, 2, tick));
      if (node.parent >= 0) global = globals[static_cast<std::size_t>(node.parent)] * global;
      globals.push_back(global);
      expected[node.name] = global;
      size = std::max(size, global.translation().norm() * metres / 100);
    }
    const ModelPose pose = to_model_space(read.motion.skeleton(), read.motion.pose(frame));
    for (std::size_t joint = 0; joint < read.motion.skeleton().joint_count(); ++joint) {
      const Affine3d& global = expected.at(read.motion.skeleton().joints()[joint].name);
      const Vector3d place = global.translation() * (metres / 100);
      // A hundredth of a millimetre in a body of two metres; for larger trees proportionally more, for the precision of
      // a float.
      const double most = 1e-5 * std::max(1.0, size / 2);
      RC_ASSERT((pose.positions[joint].cast<double>() - place).norm() < most);
      const Eigen::Quaterniond turn(Eigen::Matrix3d(global.linear() / std::cbrt(global.linear().determinant())));
      const double angle = turn.angularDistance(pose.rotations[joint].cast<double>()) * 180 / std::numbers::pi;
      RC_ASSERT(angle < 0.01);
    }
  }
}

// Whatever axes a file names, its bones are where those axes put them.
RC_GTEST_PROP(Fbx, AxesOfAnyKindAreTurnedToOurs, ()) {
  const Case made = some_case();
  std::array<int, 3> axes{0, 1, 2};
  const int turns = *rc::gen::inRange(0, 6);
  for (int i = 0; i < turns; ++i) std::next_permutation(axes.begin(), axes.end());
  std::array<int, 3> signs{};
  for (int& sign : signs) sign = *rc::gen::element(-1, 1);
  TestFile file = made.file;
  file.settings = TestFile::axes(1, 1, 2, 1, 0, 1) + TestFile::unit(1) + TestFile::time_mode(6);
  const File plain = read_bytes("plain", test::text_of(file));
  file.settings = TestFile::axes(axes[1], signs[1], axes[2], signs[2], axes[0], signs[0]) + TestFile::unit(1) +
                  TestFile::time_mode(6);
  const File turned = read_bytes("turned", test::text_of(file));
  for (std::int64_t frame = 0; frame < plain.motion.frame_count(); ++frame) {
    const ModelPose before = to_model_space(plain.motion.skeleton(), plain.motion.pose(frame));
    const ModelPose after = to_model_space(turned.motion.skeleton(), turned.motion.pose(frame));
    for (std::size_t joint = 0; joint < before.positions.size(); ++joint) {
      for (std::size_t row = 0; row < 3; ++row) {
        const double expected = static_cast<double>(before.positions[joint][axes[row]]) * signs[row];
        const double found = static_cast<double>(after.positions[joint][static_cast<Eigen::Index>(row)]);
        const double scale = std::max(1.0, static_cast<double>(before.positions[joint].norm()));
        RC_ASSERT(std::abs(expected - found) < 2e-5 * scale);
      }
    }
  }
}

}  // namespace
}  // namespace signweave::fbx
