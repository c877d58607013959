#include "signweave/formats/gltf/bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/formats/gltf/space.h"

namespace signweave::gltf {
namespace {

constexpr double kBindDegrees = 1;  // a smaller difference is exporters' rounding
constexpr double kBindMetres = 0.001;

/// The difference between two poses of one joint in its parent.
struct BindGap {
  double degrees = 0;
  double metres = 0;
  std::size_t node = kNoNode;  ///< where it is largest
};

Eigen::Matrix3d without_scale(const Eigen::Matrix3d& linear) {
  Eigen::Matrix3d turn = linear;
  for (int axis = 0; axis < 3; ++axis) turn.col(axis).normalize();
  return turn;
}

double degrees_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::Quaterniond off(Eigen::Matrix3d(without_scale(a).transpose() * without_scale(b)));
  return 2 * std::atan2(off.vec().norm(), std::abs(off.w())) * 180 / std::numbers::pi;
}

/// The bind poses of one skin.
class BindPoses {
 public:
  BindPoses(const Content& content, const NodeForest& forest, const tinygltf::Skin& skin, const Numbers& matrices)
      : content_(content), forest_(forest), from_model_(content.model.nodes.size()), bound_(from_model_.size(), false) {
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const auto node = static_cast<std::size_t>(skin.joints[i]);
      const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4f>(matrices.values.data() + 16 * i).cast<double>();
      const bool usable = matrix.allFinite() && std::abs(matrix.topLeftCorner<3, 3>().determinant()) > 1e-18;
      if (!usable && broken_++ == 0) first_broken_ = node;
      if (usable) from_model_[node].matrix() = matrix;
      bound_[node] = usable;
    }
  }

  std::size_t broken() const { return broken_; }
  std::size_t first_broken() const { return first_broken_; }

  BindGap largest_gap(const tinygltf::Skin& skin, double unit) const {
    BindGap largest;
    for (const int joint : skin.joints) {
      const auto node = static_cast<std::size_t>(joint);
      if (!bound_[node]) continue;
      Eigen::Affine3d rest = rest_of(content_, node).matrix();
      std::size_t above = forest_.parent[node];
      for (std::size_t steps = 0; above != kNoNode && !bound_[above] && steps < 64; ++steps) {
        rest = rest_of(content_, above).matrix() * rest;
        above = forest_.parent[above];
      }
      if (above == kNoNode || !bound_[above]) continue;
      const Eigen::Affine3d bind = from_model_[above] * from_model_[node].inverse();
      // In the parent joint's own units; its size in the model converts them to metres.
      const double size = std::cbrt(std::abs(from_model_[above].linear().determinant()));
      const double metres = (bind.translation() - rest.translation()).norm() / size * unit;
      const double degrees = degrees_between(bind.linear(), rest.linear());
      const bool larger = std::max(metres / kBindMetres, degrees / kBindDegrees) >
                          std::max(largest.metres / kBindMetres, largest.degrees / kBindDegrees);
      if (std::isfinite(metres) && std::isfinite(degrees) && larger) largest = {degrees, metres, node};
    }
    return largest;
  }

 private:
  const Content& content_;
  const NodeForest& forest_;
  std::vector<Eigen::Affine3d> from_model_;  ///< [node] joint from model
  std::vector<bool> bound_;                  ///< [node]
  std::size_t broken_ = 0;
  std::size_t first_broken_ = kNoNode;
};

}  // namespace

void check_bind_poses(const Content& content, const NodeForest& forest, Accessors& accessors, double unit,
                      std::vector<Notice>& notices) {
  // Many skins may refer to the same nodes: without a limit the time would grow with the square of a file's size.
  constexpr std::size_t kMostSkins = 64;
  constexpr std::size_t kMostBound = 65'535;
  std::size_t seen = 0;
  const auto& skins = content.model.skins;
  for (std::size_t i = 0; i < std::min(skins.size(), kMostSkins); ++i) {
    const tinygltf::Skin& skin = skins[i];
    if (skin.inverseBindMatrices < 0 || skin.joints.empty()) continue;
    seen += skin.joints.size();
    if (seen > kMostBound) return;
    const auto note = [&](const std::string& what) {
      notices.push_back({content.name, fmt::format("skin {}: {}; only the nodes were read", i, what)});
    };
    const Numbers matrices = accessors.read(skin.inverseBindMatrices, {.type = TINYGLTF_TYPE_MAT4});
    if (matrices.count < skin.joints.size()) {
      note(fmt::format("{} bind matrices for {} joints", matrices.count, skin.joints.size()));
      continue;
    }
    const BindPoses poses(content, forest, skin, matrices);
    if (poses.broken() > 0) {
      note(fmt::format("{} bind matrices are singular or not finite, such as that of {}", poses.broken(),
                       node_text(content, poses.first_broken())));
    }
    const BindGap gap = poses.largest_gap(skin, unit);
    if (gap.node != kNoNode && (gap.degrees > kBindDegrees || gap.metres > kBindMetres)) {
      note(fmt::format("its bind pose is not that of the nodes, by up to {:.1f} degrees and {:.1f} mm ({})",
                       gap.degrees, gap.metres * 1000, node_text(content, gap.node)));
    }
  }
}

}  // namespace signweave::gltf
