#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "signweave/formats/gltf/joints.h"
#include "signweave/formats/gltf/take.h"
#include "signweave/motion/skeleton.h"

namespace signweave::gltf {

/// How one node becomes a joint, all scales taken out:
/// translation = (moved + turned * (scaled ∘ its own)) * growth, rotation = turned * its own. Metres.
struct JointPlace {
  std::size_t node = 0;
  JointIndex parent = kNoJoint;
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();               ///< not zero of the root only
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();    ///< not the identity of the root only
  Eigen::Vector3d scaled = Eigen::Vector3d::Ones();              ///< metres per unit of its translation
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< its own, where no curve changes it
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< its own, where no curve changes it
  const Curve* translation_curve = nullptr;                      ///< none where it does not change
  const Curve* rotation_curve = nullptr;
  std::vector<const Curve*> growth;  ///< scales above it that change, the same along all axes: their product

  /// Whether its translation changes over time.
  bool translated() const noexcept { return translation_curve != nullptr || !growth.empty(); }
  Eigen::Vector3d placed(const Eigen::Vector3d& own) const { return moved + turned * scaled.cwiseProduct(own); }
};

/// [joint] of the nodes that become joints. Nodes above the first are applied to it. Constant scales go into what is
/// below; those that differ by axis only where no shear comes of it, and then with a notice. A scale that changes goes
/// into the translations of what is below, with a notice, where it does so along all axes alike and every joint is
/// below it, is it, or is above it. Throws Error{unsupported}, naming the node, for other scales that change, for
/// shear, and for scales that differ by axis above what turns.
std::vector<JointPlace> joint_places(const Content& content, const NodeForest& forest, const Take& take,
                                     const std::vector<std::size_t>& joints, double unit, std::vector<Notice>& notices);

/// A node's transform by itself, without any animation.
struct NodeRest {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  bool sheared = false;  ///< its matrix is no rotation and scale

  Eigen::Affine3d matrix() const { return Eigen::Translation3d(translation) * rotation * Eigen::Scaling(scale); }
};

/// Throws Error{bad_input} where its numbers are not finite, its rotation has no length or its matrix has a
/// perspective.
NodeRest rest_of(const Content& content, std::size_t index);

}  // namespace signweave::gltf
