#pragma once

#include <Eigen/Geometry>

#include "signweave/formats/fbx/scene.h"

/// FBX' transform of a node relative to its parent:
///   T · Roff · Rp · Rpre · R · Rpost⁻¹ · Rp⁻¹ · Soff · Sp · S · Sp⁻¹
/// The geometric transforms follow it and move only meshes, so they are not part of it.
namespace signweave::fbx {

/// The part of it that moves bones: a rotation, a translation, and a scale that is inherited by the children.
struct Local {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< file units
  Eigen::Vector3d scaling = Eigen::Vector3d::Ones();
};

/// A rotation of three angles in degrees, in FBX' order 0 to 5.
Eigen::Quaterniond euler(const Eigen::Vector3d& degrees, int order);

/// The node's transform with these three in place of its own.
Local local_of(const Node& node, const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation,
               const Eigen::Vector3d& scaling);

/// Whether a scale is the same along all axes, within the rounding of exporters (1e-5), and does not mirror.
bool is_uniform(const Eigen::Vector3d& scaling) noexcept;

/// Converts from the file's space to ours, except for metres: Y up, right-handed. A left-handed file is first mirrored
/// along its own last axis, then turned.
class Space {
 public:
  explicit Space(const Settings& settings);

  bool mirrored() const noexcept { return mirrored_; }
  /// A local rotation or position, mirrored if the file is.
  Eigen::Quaterniond inside(const Eigen::Quaterniond& rotation) const noexcept;
  Eigen::Vector3d inside(const Eigen::Vector3d& place) const noexcept;
  /// The rotation applied to nodes without a parent.
  const Eigen::Quaterniond& turn() const noexcept { return turn_; }

 private:
  bool mirrored_ = false;
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
};

}  // namespace signweave::fbx
