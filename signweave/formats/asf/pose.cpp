#include "signweave/formats/asf/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signweave::asf {
namespace {

bool has_length_dof(const Bone& bone) noexcept {
  return std::find(bone.dofs.begin(), bone.dofs.end(), Dof::l) != bone.dofs.end();
}

/// Whether a bone's head moves within its parent's space.
bool head_moves(const Figure& figure, const Bone& bone) noexcept {
  if (std::any_of(bone.dofs.begin(), bone.dofs.end(), is_translation)) return true;
  return bone.parent != kNoJoint && has_length_dof(figure.bones[static_cast<std::size_t>(bone.parent)]);
}

/// The position of a bone's head in its parent's space, at rest, in the file's numbers.
Eigen::Vector3d rest_head(const Figure& figure, const Bone& bone) noexcept {
  return bone.parent == kNoJoint ? figure.position : figure.bones[static_cast<std::size_t>(bone.parent)].tail;
}

}  // namespace

Eigen::Quaterniond turn_about(int axis, double angle, bool degrees) noexcept {
  const double half = (degrees ? angle * (std::numbers::pi / 180) : angle) / 2;
  Eigen::Quaterniond turn(std::cos(half), 0, 0, 0);
  turn.vec()[axis] = std::sin(half);
  return turn;
}

Eigen::Quaterniond rotation_of(const Turn& turn, bool degrees) noexcept {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  for (const int axis : turn.order) rotation = turn_about(axis, turn.angles[axis], degrees) * rotation;
  return rotation;
}

RestFigure rest_of(const Figure& figure) {
  RestFigure rest;
  std::vector<bool> has_child(figure.bones.size(), false);
  for (const Bone& bone : figure.bones) {
    if (bone.parent != kNoJoint) has_child[static_cast<std::size_t>(bone.parent)] = true;
    const Eigen::Vector3d head = rest_head(figure, bone) / figure.length_unit;
    rest.joints.push_back({.name = bone.name,
                           .parent = bone.parent,
                           .offset = head.cast<float>(),
                           .translated = head_moves(figure, bone)});
  }
  for (std::size_t i = 0; i < figure.bones.size(); ++i) {
    if (has_child[i]) continue;
    const Eigen::Vector3d tail = figure.bones[i].tail / figure.length_unit;
    rest.tips.push_back({.joint = static_cast<JointIndex>(i), .offset = tail.cast<float>()});
  }
  return rest;
}

Poser::Poser(const Figure& figure, bool degrees)
    : figure_(figure), degrees_(degrees), pieces_(figure.bones.size()), added_lengths_(figure.bones.size(), 0.0) {
  std::size_t column = 0;
  for (std::size_t i = 0; i < figure.bones.size(); ++i) {
    const Bone& bone = figure.bones[i];
    pieces_[i].column = column;
    pieces_[i].axis = rotation_of(bone.axis, figure.degrees);
    pieces_[i].turned = !bone.axis.angles.isZero(0);
    column += bone.dofs.size();
    translated_.push_back(head_moves(figure, bone));
  }
}

void Poser::apply(std::span<const double> numbers, MutablePoseView pose) {
  std::size_t translation = 0;
  for (std::size_t i = 0; i < figure_.bones.size(); ++i) {
    const Bone& bone = figure_.bones[i];
    const Piece& piece = pieces_[i];
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (std::size_t d = 0; d < bone.dofs.size(); ++d) {
      const double number = numbers[piece.column + d];
      if (is_rotation(bone.dofs[d])) {
        rotation = turn_about(axis_of(bone.dofs[d]), number, degrees_) * rotation;
      } else if (is_translation(bone.dofs[d])) {
        moved[axis_of(bone.dofs[d])] = number;
      } else {
        added_lengths_[i] = number;
      }
    }
    const bool root = bone.parent == kNoJoint;
    if (piece.turned) {
      rotation = root ? rotation * piece.axis : piece.axis * rotation * piece.axis.conjugate();
      if (!root) moved = piece.axis * moved;
    }
    pose.rotations[i] = rotation.normalized().cast<float>();
    if (!translated_[i]) continue;
    Eigen::Vector3d head = rest_head(figure_, bone) + moved;
    if (!root) {
      const auto parent = static_cast<std::size_t>(bone.parent);
      head += added_lengths_[parent] * figure_.bones[parent].direction;
    }
    pose.translations[translation++] = Eigen::Vector3d(head / figure_.length_unit).cast<float>();
  }
}

}  // namespace signweave::asf
