#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "signweave/drawing/body_plan.h"

namespace signweave {

/// One movement of the face: how far each vertex moves at weight 1.
struct FaceTarget {
  std::string name;                     ///< an ARKit name, such as "jawOpen"
  std::vector<Eigen::Vector3f> deltas;  ///< [vertex], metres
};

/// Brows, eyes and a mouth, drawn flat on the front of a head.
struct FaceMesh {
  std::vector<Eigen::Vector3f> positions;  ///< metres, in the plan's pose
  std::vector<Eigen::Vector3f> normals;    ///< unit
  std::vector<std::uint32_t> indices;      ///< three per triangle
  std::vector<FaceTarget> targets;
};

/// The names for which the drawn face has a target. Left and right are the person's own.
std::span<const char* const> face_target_names();

/// The face of a head, with targets of the given names (from face_target_names), in their order.
FaceMesh face_mesh(const HeadShape& head, const std::vector<std::string>& targets);

}  // namespace signweave
