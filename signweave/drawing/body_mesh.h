#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "signweave/drawing/body_plan.h"

namespace signweave {

/// Triangles, counter-clockwise seen from outside. Each vertex moves with one joint.
struct BodyMesh {
  std::vector<Eigen::Vector3f> positions;  ///< metres, in the plan's pose
  std::vector<Eigen::Vector3f> normals;    ///< unit
  std::vector<JointIndex> joints;          ///< [vertex]
  std::vector<std::uint32_t> indices;      ///< three per triangle
};

/// A person built from simple solids: a limb for each bone, a trunk, a head with a nose, flat palms. Parts that the
/// plan does not identify are drawn bone by bone.
BodyMesh body_mesh(const Skeleton& skeleton, const BodyPlan& plan);

}  // namespace signweave
