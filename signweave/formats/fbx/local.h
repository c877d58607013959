#pragma once

#include <Eigen/Geometry>

#include "signweave/formats/fbx/scene.h"

/// FBX' transform of a node against its parent:
///   T · Roff · Rp · Rpre · R · Rpost⁻¹ · Rp⁻¹ · Soff · Sp · S · Sp⁻¹
/// The geometric transforms stand after it and move meshes only, so they are no part of it.
namespace signweave::fbx {

/// What of it moves bones: a turn, a place, and a scale that passes on to the children.
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

/// Whether a scale is the same along all axes, up to what exporters round (1e-5), and does not mirror.
bool is_uniform(const Eigen::Vector3d& scaling) noexcept;

/// Our space from the file's: metres apart, Y up, right-handed. A left-handed file is mirrored first, along its own
/// last axis, then turned.
class Space {
 public:
  explicit Space(const Settings& settings);

  bool mirrored() const noexcept { return mirrored_; }
  /// A local rotation or place, mirrored where the file is.
  Eigen::Quaterniond inside(const Eigen::Quaterniond& rotation) const noexcept;
  Eigen::Vector3d inside(const Eigen::Vector3d& place) const noexcept;
  /// Turns what hangs from the scene itself.
  const Eigen::Quaterniond& turn() const noexcept { return turn_; }

 private:
  bool mirrored_ = false;
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
};

}  // namespace signweave::fbx
