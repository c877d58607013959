#include "signweave/formats/bvh_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
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
constexpr double kCommonSmallest = 1.3;  // bones end at ankle and head joint in some skeletons
constexpr double kCommonTallest = 2.1;
constexpr std::int64_t kFramesSeen = 50;

/// Joints whose names hold one of these parts, in any case.
JointSet joints_named(const Skeleton& skeleton, std::initializer_list<std::string_view> parts) {
  JointSet found;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const std::string name = fold_case(skeleton.joints()[i].name);
    const bool named = std::any_of(parts.begin(), parts.end(),
                                   [&](std::string_view part) { return name.find(part) != std::string::npos; });
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

/// How long each bone is (the way from a joint's parent), and how high and wide the posed body is, in file units.
struct Measures {
  std::vector<double> bones;                          ///< [joint]
  Eigen::Vector3d upright = Eigen::Vector3d::Zero();  ///< mean direction from the feet to the head
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();   ///< mean size of the box around all joints and tips
};

Eigen::Vector3d centre(const JointSet& joints, const ModelPose& pose) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const JointIndex joint : joints) sum += pose.positions[static_cast<std::size_t>(joint)].cast<double>();
  return sum / static_cast<double>(joints.size());
}

Measures measure(const Motion& motion, const JointSet& head, const JointSet& feet) {
  const Skeleton& skeleton = motion.skeleton();
  Measures result;
  result.bones.assign(skeleton.joint_count(), 0.0);
  const std::int64_t step = std::max<std::int64_t>(1, motion.frame_count() / kFramesSeen);
  double seen = 0;
  ModelPose model;
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += step) {
    const PoseView pose = motion.pose(frame);
    to_model_space(skeleton, pose, model);
    std::size_t translation = 0;
    for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
      const Joint& joint = skeleton.joints()[i];
      // Where the file moves a joint, its OFFSET need not be a bone at all.
      const Eigen::Vector3f& local = joint.translated ? pose.translations[translation++] : joint.offset;
      if (i > 0) result.bones[i] += local.cast<double>().norm();
    }
    Eigen::Vector3d low = model.positions[0].cast<double>();
    Eigen::Vector3d high = low;
    const auto include = [&](const Eigen::Vector3f& point) {
      low = low.cwiseMin(point.cast<double>());
      high = high.cwiseMax(point.cast<double>());
    };
    for (const Eigen::Vector3f& position : model.positions) include(position);
    for (const Tip& tip : skeleton.tips()) include(position_of(tip, model));
    result.extent += high - low;
    if (!head.empty() && !feet.empty()) {
      const Eigen::Vector3d upright = centre(head, model) - centre(feet, model);
      if (upright.norm() > 0) result.upright += upright.normalized();
    }
    seen += 1;
  }
  for (double& bone : result.bones) bone /= seen;
  result.extent /= seen;
  result.upright /= seen;
  return result;
}

/// The summed bones between two joints.
double path_length(const Skeleton& skeleton, const std::vector<double>& bones, JointIndex a, JointIndex b) {
  double length = 0;
  while (a != b) {
    JointIndex& later = a > b ? a : b;  // parents come first, so the later one cannot be an ancestor of the other
    length += bones[static_cast<std::size_t>(later)];
    later = skeleton.joint(later).parent;
  }
  return length;
}

/// From a foot to the top of the head along the bones, in file units; the shortest of all such ways, since names such
/// as "ToeBase" and "HeadEnd" match too and only lengthen it.
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
  return result + std::min(crown, 0.25 * result);  // an eye or a camera may hang far off the head
}

}  // namespace

Guess guess_space(const Motion& motion, std::optional<UpAxis> up) {
  const Skeleton& skeleton = motion.skeleton();
  const JointSet head = first_of({joints_named(skeleton, {"head"}), joints_named(skeleton, {"neck"})});
  const JointSet feet = first_of({joints_named(skeleton, {"foot", "ankle"}), joints_named(skeleton, {"toe"})});
  const Measures measures = measure(motion, head, feet);

  Guess guess;
  const bool named = measures.upright.norm() > 0;
  const double along_y = named ? measures.upright.y() : measures.extent.y();
  const double along_z = named ? measures.upright.z() : measures.extent.z();
  guess.up = up.value_or(std::abs(along_z) > std::abs(along_y) ? UpAxis::z : UpAxis::y);
  const double lesser = std::min(std::abs(along_y), std::abs(along_z));
  const double greater = std::max(std::abs(along_y), std::abs(along_z));
  guess.up_certain = named ? lesser < 0.7 * greater && greater > 0.4 : lesser < 0.7 * greater;
  guess.upside_down = named && (guess.up == UpAxis::z ? along_z : along_y) < 0;

  const double by_bones = stature(skeleton, measures.bones, head, feet);
  const double length = by_bones > 0 ? by_bones : guess.up == UpAxis::z ? measures.extent.z() : measures.extent.y();
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
  guess.unit_certain = guess.unit_plausible && guess.stature > kCommonSmallest && guess.stature < kCommonTallest;
  return guess;
}

std::string unit_name(double unit) {
  for (const Unit& known : kUnits) {
    if (known.metres == unit) return std::string(known.name);
  }
  return fmt::format("{:g} m", unit);
}

}  // namespace signweave::bvh
