#include "signweave/formats/gltf/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace signweave::gltf {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kSameScale = 1e-4;      // relative: exporters' rounding, reported from 1e-6 on
constexpr double kShearSlack = 1e-5;     // cosine between the axes of a matrix
constexpr float kStillRotation = 1e-6f;  // a component of a quaternion
constexpr double kStillPlace = 5e-7;     // metres

bool is_uniform(const Vector3d& scale) {
  return scale.maxCoeff() - scale.minCoeff() <= kSameScale * scale.cwiseAbs().maxCoeff();
}

std::string scale_text(const Vector3d& scale) {
  return fmt::format("{:.6g}, {:.6g}, {:.6g}", scale.x(), scale.y(), scale.z());
}

/// A node as the take leaves it where nothing changes.
struct NodeStill {
  Vector3d translation;
  Quaterniond rotation;
  Vector3d scale;
  const Curve* translation_curve = nullptr;
  const Curve* rotation_curve = nullptr;
  const Curve* scale_curve = nullptr;
};

/// Visits the nodes from the roots down, with the scales above each.
class SpaceWalk {
 public:
  SpaceWalk(const Content& content, const Take& take, std::vector<Notice>& notices)
      : content_(content), take_(take), notices_(notices) {}

  /// The state above a node: its children's own translations are multiplied by `scale`; also the node that made the
  /// scale differ by axis.
  struct Above {
    Vector3d scale;
    std::size_t origin = kNoNode;
  };

  NodeStill still(std::size_t node, const Vector3d& metres) const {
    const NodeRest rest = rest_of(content_, node);
    const NodeCurves& curves = take_.nodes[node];
    if (rest.sheared) refuse(node, "its matrix shears, which no joint can; apply it before export");
    NodeStill still{rest.translation, rest.rotation, rest.scale};
    const double unit = metres.cwiseAbs().maxCoeff();
    if (curves.translation) {
      const auto most = static_cast<float>(kStillPlace / std::max(unit, 1e-12));
      if (changes(*curves.translation, most)) still.translation_curve = curves.translation;
      const std::span<const float> first = curves.translation->key(0);
      still.translation = {first[0], first[1], first[2]};
    }
    if (curves.rotation) {
      if (changes(*curves.rotation, kStillRotation)) still.rotation_curve = curves.rotation;
      still.rotation = unit_rotation(curves.rotation->key(0));
    }
    if (curves.scale) {
      const std::span<const float> first = curves.scale->key(0);
      const float most =
          static_cast<float>(kSameScale) * std::max({std::abs(first[0]), std::abs(first[1]), std::abs(first[2])});
      if (changes(*curves.scale, most)) still.scale_curve = curves.scale;
      still.scale = {first[0], first[1], first[2]};
    }
    return still;
  }

  /// The state above the children of a node that has any. `shared`: all joints are below it.
  Above below(std::size_t node, NodeStill still, const Above& above, bool shared) {
    if (still.scale_curve) {
      const Curve& curve = *still.scale_curve;
      if (!shared) {
        refuse(node, fmt::format("its scale changes ({}), and not every joint is below it; bake it before export",
                                 curve.place));
      }
      for (std::size_t key = 0; key < curve.key_count(); ++key) {
        const std::span<const float> value = curve.key(key);
        const Vector3d scale(value[0], value[1], value[2]);
        if (is_uniform(scale) && scale.minCoeff() > 1e-9) continue;
        refuse(node,
               fmt::format("its scale changes to {} ({}), and no joint below can follow what is not the same along "
                           "all axes and above 0; bake it before export",
                           scale_text(scale), curve.place));
      }
      notices_.push_back({content_.name, fmt::format("{}: its scale changes ({}); that was baked into where the joints "
                                                     "below it are",
                                                     node_text(content_, node), curve.place)});
      still.scale = Vector3d::Ones();
    }
    const Vector3d turned = turned_scale(node, still, above);
    const Vector3d scale = turned.cwiseProduct(still.scale);
    if (!(scale.cwiseAbs().minCoeff() > 1e-9) || !scale.allFinite()) {
      refuse(node, fmt::format("scaled by {}, so nothing is left of what is below it", scale_text(still.scale)));
    }
    if (is_uniform(scale)) {
      const double mean = scale.mean();
      if (const double off = (scale.maxCoeff() - scale.minCoeff()) / std::abs(mean); off > 1e-6) {
        notices_.push_back(
            {content_.name, fmt::format("{}: its scale differs by {:.1g} from axis to axis; the mean was "
                                        "taken",
                                        node_text(content_, node), off)});
      }
      return {Vector3d::Constant(mean), kNoNode};
    }
    if (!is_uniform(still.scale)) {
      notices_.push_back({content_.name, fmt::format("{}: its scale {} was multiplied into what is below it",
                                                     node_text(content_, node), scale_text(still.scale))});
      return {scale, node};
    }
    return {scale, above.origin};
  }

  /// The scale above a node along its own axes. Only if these are the parent's, in any order, is there no shear.
  Vector3d turned_scale(std::size_t node, const NodeStill& still, const Above& above) const {
    if (is_uniform(above.scale)) return above.scale;
    const Matrix3d turn = still.rotation.toRotationMatrix();
    const Matrix3d scale = turn.transpose() * above.scale.asDiagonal() * turn;
    const Matrix3d off = scale - Matrix3d(scale.diagonal().asDiagonal());
    const bool along = off.cwiseAbs().maxCoeff() <= kShearSlack * above.scale.cwiseAbs().maxCoeff();
    if (still.rotation_curve || !along) {
      const std::size_t origin = above.origin == kNoNode ? node : above.origin;
      refuse(origin, fmt::format("it scales each axis by another number, which shears {} as it turns; apply the scale "
                                 "before export",
                                 node_text(content_, node)));
    }
    return scale.diagonal();
  }

  [[noreturn]] void refuse(std::size_t node, const std::string& what) const {
    throw Error(ErrorCode::unsupported, fmt::format("{}: {}: {}", content_.name, node_text(content_, node), what));
  }

 private:
  const Content& content_;
  const Take& take_;
  std::vector<Notice>& notices_;
};

}  // namespace

NodeRest rest_of(const Content& content, std::size_t index) {
  const tinygltf::Node& node = content.model.nodes[index];
  const auto refuse = [&](const char* what) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}: {}", content.name, node_text(content, index), what));
  };
  NodeRest rest;
  if (!node.matrix.empty()) {
    const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    if (!matrix.allFinite()) refuse("its matrix is not finite");
    if (!matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-6))
      refuse("the last row of its matrix is not 0, 0, 0, 1");
    rest.translation = matrix.topRightCorner<3, 1>();
    Matrix3d turn = matrix.topLeftCorner<3, 3>();
    rest.scale = turn.colwise().norm();
    if (turn.determinant() < 0) rest.scale = -rest.scale;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(rest.scale[axis]) > 1e-12) turn.col(axis) /= rest.scale[axis];
    }
    rest.sheared = !(turn.transpose() * turn).isApprox(Matrix3d::Identity(), kShearSlack);
    rest.rotation = Quaterniond(turn).normalized();
    return rest;
  }
  if (!node.translation.empty()) rest.translation = Eigen::Map<const Vector3d>(node.translation.data());
  if (!node.scale.empty()) rest.scale = Eigen::Map<const Vector3d>(node.scale.data());
  if (!node.rotation.empty()) {
    rest.rotation.coeffs() = Eigen::Map<const Eigen::Vector4d>(node.rotation.data());
    const double norm = rest.rotation.norm();
    if (!(norm > 1e-6) || !std::isfinite(norm)) refuse("its rotation has no length");
    rest.rotation.coeffs() /= norm;
  }
  if (!rest.translation.allFinite() || !rest.scale.allFinite()) refuse("its numbers are not finite");
  return rest;
}

std::vector<JointPlace> joint_places(const Content& content, const NodeForest& forest, const Take& take,
                                     const std::vector<std::size_t>& joints, double unit,
                                     std::vector<Notice>& notices) {
  SpaceWalk walk(content, take, notices);
  std::vector<std::size_t> above_root;
  for (std::size_t at = forest.parent[joints[0]]; at != kNoNode; at = forest.parent[at]) above_root.push_back(at);
  SpaceWalk::Above above{Vector3d::Constant(unit), kNoNode};
  Vector3d moved = Vector3d::Zero();
  Quaterniond turned = Quaterniond::Identity();
  for (auto at = above_root.rbegin(); at != above_root.rend(); ++at) {
    const NodeStill still = walk.still(*at, above.scale);
    moved += turned * above.scale.cwiseProduct(still.translation);
    turned = (turned * still.rotation).normalized();
    above = walk.below(*at, still, above, true);
  }

  std::vector<JointIndex> joint_of(content.model.nodes.size(), kNoJoint);
  for (std::size_t i = 0; i < joints.size(); ++i) joint_of[joints[i]] = static_cast<JointIndex>(i);
  std::vector<bool> has_children(joints.size(), false);
  for (std::size_t i = 1; i < joints.size(); ++i) {
    has_children[static_cast<std::size_t>(joint_of[forest.parent[joints[i]]])] = true;
  }
  // Joint i and all joints before it form one chain, which has all others below it.
  std::vector<bool> shared(joints.size(), false);
  JointIndex highest = static_cast<JointIndex>(joints.size());  // of the parents of the joints after i
  for (std::size_t i = joints.size(); i-- > 0;) {
    shared[i] = highest >= static_cast<JointIndex>(i);
    if (i > 0) highest = std::min(highest, joint_of[forest.parent[joints[i]]]);
  }
  std::vector<SpaceWalk::Above> above_of(joints.size());
  std::vector<JointPlace> places;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    JointPlace place{.node = joints[i]};
    if (i > 0) place.parent = joint_of[forest.parent[joints[i]]];
    const SpaceWalk::Above& mine = i > 0 ? above_of[static_cast<std::size_t>(place.parent)] : above;
    const NodeStill still = walk.still(joints[i], mine.scale);
    if (i == 0) {
      place.moved = moved;
      place.turned = turned;
    }
    place.scaled = mine.scale;
    place.translation = still.translation;
    place.rotation = still.rotation;
    place.translation_curve = still.translation_curve;
    place.rotation_curve = still.rotation_curve;
    if (i > 0) {
      const std::size_t parent = joints[static_cast<std::size_t>(place.parent)];
      place.growth = places[static_cast<std::size_t>(place.parent)].growth;
      if (const Curve* const scale = walk.still(parent, mine.scale).scale_curve) place.growth.push_back(scale);
    }
    if (has_children[i]) {
      above_of[i] = walk.below(joints[i], still, mine, shared[i]);
    } else {
      (void)walk.turned_scale(joints[i], still, mine);
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace signweave::gltf
