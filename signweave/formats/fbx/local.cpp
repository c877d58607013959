#include "signweave/formats/fbx/local.h"

#include <array>
#include <cmath>
#include <numbers>

namespace signweave::fbx {

Eigen::Quaterniond euler(const Eigen::Vector3d& degrees, int order) {
  // The axis that turns first is first here and last in the product.
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
  Eigen::Quaterniond result = Eigen::Quaterniond::Identity();
  for (const int axis : kOrders[static_cast<std::size_t>(order)]) {
    // Full turns are removed first: a quaternion of many turns would have no significant digits left.
    const double angle = std::remainder(degrees[axis], 720.0) * std::numbers::pi / 180;
    result = Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)) * result;
  }
  return result;
}

Local local_of(const Node& node, const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation,
               const Eigen::Vector3d& scaling) {
  Local local;
  local.rotation = euler(rotation, node.rotation_active ? node.rotation_order : 0);
  if (node.rotation_active) {
    local.rotation = euler(node.pre_rotation, 0) * local.rotation * euler(node.post_rotation, 0).conjugate();
  }
  local.rotation.normalize();
  const Eigen::Vector3d inner =
      node.scaling_offset + node.scaling_pivot - node.rotation_pivot - scaling.cwiseProduct(node.scaling_pivot);
  local.translation = translation + node.rotation_offset + node.rotation_pivot + local.rotation * inner;
  local.scaling = scaling;
  return local;
}

bool is_uniform(const Eigen::Vector3d& scaling) noexcept {
  return scaling.minCoeff() > 1e-9 && scaling.maxCoeff() - scaling.minCoeff() <= 1e-5 * scaling.maxCoeff();
}

Space::Space(const Settings& settings) {
  Eigen::Matrix3d ours = Eigen::Matrix3d::Zero();
  for (int row = 0; row < 3; ++row) {
    const auto index = static_cast<std::size_t>(row);
    ours(row, settings.axes[index]) = settings.signs[index];
  }
  mirrored_ = ours.determinant() < 0;
  if (mirrored_) ours.col(2) *= -1;
  turn_ = Eigen::Quaterniond(ours).normalized();
}

Eigen::Quaterniond Space::inside(const Eigen::Quaterniond& rotation) const noexcept {
  // A reflection along z reverses rotations about x and y.
  return mirrored_ ? Eigen::Quaterniond(rotation.w(), -rotation.x(), -rotation.y(), rotation.z()) : rotation;
}

Eigen::Vector3d Space::inside(const Eigen::Vector3d& place) const noexcept {
  return mirrored_ ? Eigen::Vector3d(place.x(), place.y(), -place.z()) : place;
}

}  // namespace signweave::fbx
