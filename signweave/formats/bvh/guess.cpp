#include "signweave/formats/bvh/guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <vector>

#include "signweave/core/text.h"
#include "signweave/motion/kinematics.h"

namespace signweave::bvh {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array kUnits = {Unit{"m", 1.0}, Unit{"cm", 0.01}, Unit{"mm", 0.001}, Unit{"inch", 0.0254},
                               Unit{"0.0564 m", 0.0564}};
constexpr double kUsualStature = 1.7;
constexpr double kSmallest = 1.0;
constexpr double kTallest = 2.3;
constexpr double kCommonSmallest = 1.3;  // in some skeletons the bones end at the ankle and at the head joint
constexpr double kCommonTallest = 2.1;
constexpr std::int64_t kFramesSeen = 50;

/// Joints whose names, in lower case, contain one of these parts.
JointSet joints_named(const std::vector<std::string>& names, std::initializer_list<std::string_view> parts) {
  JointSet found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool named = std::any_of(parts.begin(), parts.end(),
                                   [&](std::string_view part) { return names[i].find(part) != std::string::npos; });
    if (named) found.push_back(static_cast<JointIndex>(i));
  }
  return found;
}

JointSet first_of(std::initializer_list<JointSet> choices) {
  for (const JointSet& choice : choices) {
    if (!choice.empty()) return choice;
  }
  return {};
}

/// The length of each bone (from a joint's parent to the joint), in file units, and the orientation of the posed body.
struct Measures {
  std::vector<double> bones;                          ///< [joint]
  Eigen::Vector3d upright = Eigen::Vector3d::Zero();  ///< mean direction from the feet to the head
};

Eigen::Vector3d centre(const JointSet& joints, const ModelPose& pose) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const JointIndex joint : joints) sum += pose.positions[static_cast<std::size_t>(joint)].cast<double>();
  return sum / static_cast<double>(joints.size());
}

/// The step between the frames that are examined, which are evenly spaced.
std::int64_t frame_step(const Motion& motion) noexcept {
  return std::max<std::int64_t>(1, motion.frame_count() / kFramesSeen);
}

/// A joint on the path from the root to the head or to a foot.
struct PathJoint {
  std::size_t joint;
  std::size_t parent;  ///< the joint itself for the root
  std::optional<std::size_t> translation;
};

/// All joints on the paths from the root to those given, parents first.
std::vector<PathJoint> paths_to(const Skeleton& skeleton, const JointSet& head, const JointSet& feet) {
  std::vector<bool> wanted(skeleton.joint_count(), false);
  for (const JointSet* ends : {&head, &feet}) {
    for (JointIndex joint : *ends) {
      for (; joint != kNoJoint && !wanted[static_cast<std::size_t>(joint)]; joint = skeleton.joint(joint).parent) {
        wanted[static_cast<std::size_t>(joint)] = true;
      }
    }
  }
  std::vector<PathJoint> path_joints;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    const JointIndex parent = skeleton.joints()[i].parent;
    path_joints.push_back({i, parent == kNoJoint ? i : static_cast<std::size_t>(parent),
                           skeleton.translation_of(static_cast<JointIndex>(i))});
  }
  return path_joints;
}

Measures measure(const Motion& motion, const JointSet& head, const JointSet& feet) {
  const Skeleton& skeleton = motion.skeleton();
  Measures result;
  result.bones.assign(skeleton.joint_count(), 0.0);
  const bool named = !head.empty() && !feet.empty();
  const std::vector<PathJoint> path_joints = named ? paths_to(skeleton, head, feet) : std::vector<PathJoint>();
  double seen = 0;
  ModelPose model;
  model.rotations.resize(skeleton.joint_count());
  model.positions.resize(skeleton.joint_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += frame_step(motion)) {
    const PoseView pose = motion.pose(frame);
    // If the file moves a joint, its OFFSET need not be a bone.
    for (std::size_t i = 0; i < pose.translations.size(); ++i) {
      result.bones[static_cast<std::size_t>(skeleton.translated_joints()[i])] +=
          pose.translations[i].cast<double>().norm();
    }
    for (const PathJoint& path_joint : path_joints) {  // forward kinematics of these joints only
      const Eigen::Vector3f& local = path_joint.translation ? pose.translations[*path_joint.translation]
                                                            : skeleton.joints()[path_joint.joint].offset;
      const bool root = path_joint.parent == path_joint.joint;
      model.positions[path_joint.joint] =
          root ? local
               : Eigen::Vector3f(model.positions[path_joint.parent] + model.rotations[path_joint.parent] * local);
      model.rotations[path_joint.joint] = root ? pose.rotations[path_joint.joint]
                                               : model.rotations[path_joint.parent] * pose.rotations[path_joint.joint];
    }
    if (named) {
      const Eigen::Vector3d upright = centre(head, model) - centre(feet, model);
      if (upright.norm() > 0) result.upright += upright.normalized();
    }
    seen += 1;
  }
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const Joint& joint = skeleton.joints()[i];
    result.bones[i] = joint.translated ? result.bones[i] / seen : joint.offset.cast<double>().norm();
  }
  result.bones[0] = 0;  // the root has no parent
  result.upright /= seen;
  return result;
}

/// The mean size of the box around all joints and tips, that is, the height and width of the posed body, in file units.
Eigen::Vector3d measure_extent(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();
  double seen = 0;
  ModelPose model;
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += frame_step(motion)) {
    to_model_space(skeleton, motion.pose(frame), model);
    Eigen::Vector3f low = model.positions[0];
    Eigen::Vector3f high = low;
    const auto include = [&](const Eigen::Vector3f& point) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    };
    for (const Eigen::Vector3f& position : model.positions) include(position);
    for (const Tip& tip : skeleton.tips()) include(position_of(tip, model));
    extent += high.cast<double>() - low.cast<double>();
    seen += 1;
  }
  return extent / seen;
}

/// The summed bone lengths between two joints.
double path_length(const Skeleton& skeleton, const std::vector<double>& bones, JointIndex a, JointIndex b) {
  double length = 0;
  while (a != b) {
    JointIndex& later = a > b ? a : b;  // parents come first, so the later one cannot be an ancestor of the other
    length += bones[static_cast<std::size_t>(later)];
    later = skeleton.joint(later).parent;
  }
  return length;
}

/// The length of the bones from a foot to the top of the head, in file units; the shortest of all such paths, because
/// names such as "ToeBase" and "HeadEnd" match too and only lengthen it.
double stature(const Skeleton& skeleton, const std::vector<double>& bones, const JointSet& head, const JointSet& feet) {
  double result = std::numeric_limits<double>::infinity();
  JointIndex top = kNoJoint;
  for (const JointIndex foot : feet) {
    for (const JointIndex joint : head) {
      const double length = path_length(skeleton, bones, foot, joint);
      if (length >= result) continue;
      result = length;
      top = joint;
    }
  }
  if (top == kNoJoint) return 0;
  double crown = 0;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    if (skeleton.joints()[i].parent == top) crown = std::max(crown, bones[i]);
  }
  for (const Tip& tip : skeleton.tips()) {
    if (tip.joint == top) crown = std::max(crown, static_cast<double>(tip.offset.norm()));
  }
  return result + std::min(crown, 0.25 * result);  // an eye or a camera may be far from the head
}

}  // namespace

Guess guess_space(const Motion& motion, std::optional<UpAxis> up) {
  const Skeleton& skeleton = motion.skeleton();
  std::vector<std::string> names;
  names.reserve(skeleton.joint_count());
  for (const Joint& joint : skeleton.joints()) names.push_back(fold_case(joint.name));
  const JointSet head = first_of({joints_named(names, {"head"}), joints_named(names, {"neck"})});
  const JointSet feet = first_of({joints_named(names, {"foot", "ankle"}), joints_named(names, {"toe"})});
  const Measures measures = measure(motion, head, feet);

  Guess guess;
  const bool named = measures.upright.norm() > 0;
  const double by_bones = stature(skeleton, measures.bones, head, feet);
  const Eigen::Vector3d extent = named && by_bones > 0 ? Eigen::Vector3d::Zero() : measure_extent(motion);
  const double along_y = named ? measures.upright.y() : extent.y();
  const double along_z = named ? measures.upright.z() : extent.z();
  guess.up = up.value_or(std::abs(along_z) > std::abs(along_y) ? UpAxis::z : UpAxis::y);
  const double lesser = std::min(std::abs(along_y), std::abs(along_z));
  const double greater = std::max(std::abs(along_y), std::abs(along_z));
  guess.up_certain = named ? lesser < 0.7 * greater && greater > 0.4 : lesser < 0.7 * greater;
  guess.upside_down = named && (guess.up == UpAxis::z ? along_z : along_y) < 0;

  const double length = by_bones > 0 ? by_bones : guess.up == UpAxis::z ? extent.z() : extent.y();
  guess.has_bones = by_bones > 0;
  guess.unit_plausible = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Unit& unit : kUnits) {
    const double metres = length * unit.metres;
    const double off = std::abs(std::log(metres / kUsualStature));
    if (!(metres >= kSmallest && metres <= kTallest) || off >= nearest) continue;
    nearest = off;
    guess.unit = unit.metres;
    guess.unit_plausible = true;
  }
  guess.stature = length * guess.unit;
  return guess;
}

std::string unit_name(double unit) {
  for (const Unit& known : kUnits) {
    if (known.metres == unit) return std::string(known.name);
  }
  return fmt::format("{:g} m", unit);
}

std::string unit_reason(const Guess& guess) {
  const std::string unit = unit_name(guess.unit);
  if (!guess.unit_plausible) {
    return fmt::format("{}, which makes the body {:.3g} m tall and may well be wrong,", unit, guess.stature);
  }
  if (!guess.has_bones) {
    return fmt::format("{} (no head and feet by name; extent {:.2f} m)", unit, guess.stature);
  }
  const bool usual = guess.stature > kCommonSmallest && guess.stature < kCommonTallest;
  return fmt::format("{} (stature {:.2f} m{})", unit, guess.stature, usual ? "" : ", which is unusual");
}

}  // namespace signweave::bvh
