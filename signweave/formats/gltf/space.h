#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "signweave/formats/gltf/joints.h"
#include "signweave/formats/gltf/take.h"
#include "signweave/motion/skeleton.h"

namespace signweave::gltf {

/// How one node becomes a joint, with all scales factored out:
/// translation = (moved + turned * (scaled ∘ its own)) * growth, rotation = turned * its own. Metres.
struct JointPlace {
  std::size_t node = 0;
  JointIndex parent = kNoJoint;
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();               ///< nonzero for the root only
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();    ///< not the identity for the root only
  Eigen::Vector3d scaled = Eigen::Vector3d::Ones();              ///< metres per unit of its translation
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< its own, if no curve changes it
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< its own, if no curve changes it
  const Curve* translation_curve = nullptr;                      ///< null if it does not change
  const Curve* rotation_curve = nullptr;
  std::vector<const Curve*> growth;  ///< the product of these is the changing scale above it, the same along all axes

  /// Whether its translation changes over time.
  bool translated() const noexcept { return translation_curve != nullptr || !growth.empty(); }
  Eigen::Vector3d placed(const Eigen::Vector3d& own) const { return moved + turned * scaled.cwiseProduct(own); }
};

/// Returns [joint] for the nodes that become joints. Transforms of nodes above the first are applied to it. Constant
/// scales are applied to what is below; those that differ by axis only if no shear results, and then with a notice. A
/// scale that changes is applied to the translations of what is below, with a notice, if it is the same along all axes
/// and every joint is its node, or is above or below it. Throws Error{unsupported}, naming the node, for other changing
/// scales, for shear, and for scales that differ by axis above a node that turns.
std::vector<JointPlace> joint_places(const Content& content, const NodeForest& forest, const Take& take,
                                     const std::vector<std::size_t>& joints, double unit, std::vector<Notice>& notices);

/// A node's transform without any animation.
struct NodeRest {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  bool sheared = false;  ///< its matrix is not a rotation and scale

  Eigen::Affine3d matrix() const { return Eigen::Translation3d(translation) * rotation * Eigen::Scaling(scale); }
};

/// Throws Error{bad_input} if its numbers are not finite, its rotation has zero norm or its matrix has a perspective
/// part.
NodeRest rest_of(const Content& content, std::size_t index);

}  // namespace signweave::gltf
