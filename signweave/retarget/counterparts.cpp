#include "signweave/retarget/counterparts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "signweave/motion/degree.h"
#include "signweave/retarget/side_names.h"
#include "signweave/rig/joint_at.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kStillTurn = 2 * kDegree;
/// A direction to the left that differs by more than this from the signer's in the poses is one of another space.
/// (ours)
constexpr float kContradicts = 25 * kDegree;
/// The same for neck and head, which may be turned aside throughout a recording. (ours)
constexpr float kHeadContradicts = 50 * kDegree;
/// A direction to the left this near to a coordinate axis is that axis, because measured offsets and poses are not
/// quite symmetric, poses less so. (ours)
constexpr float kSnappedOffset = 15 * kDegree;
constexpr float kSnappedPose = 30 * kDegree;
/// Bones that miss the mirror image of the other side's by more than this show that axes are those of another space.
/// (ours)
constexpr float kMisfit = 25 * kDegree;
/// Offsets that differ by less than this, and by a tenth of their length, are mirror images. Metres. (ours)
constexpr float kSameOffset = 0.01f;

float turn_angle(const Quaternionf& a, const Quaternionf& b) {
  const Quaternionf turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

/// The angle between two lines, radians in [0, π/2]; 0 for a zero vector.
float line_angle(const Vector3f& a, const Vector3f& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// The coordinate axis that is within an angle of a direction, else the direction.
Vector3f snapped_to_axis(const Vector3f& direction, float within) {
  Eigen::Index most = 0;
  direction.cwiseAbs().maxCoeff(&most);
  const Vector3f axis = std::copysign(1.0f, direction[most]) * Vector3f::Unit(most);
  return line_angle(axis, direction) < within ? axis : direction;
}

/// Half a turn about an axis of length 1.
Quaternionf turn_about(const Vector3f& axis) {
  return {0, axis.x(), axis.y(), axis.z()};
}

std::optional<Part> opposite(Part part) {
  const auto number = static_cast<std::size_t>(part);
  if (number >= kNamedParts) {
    constexpr std::size_t kHand = kFingers.size() * kFingerPoints;
    return static_cast<Part>(number < kNamedParts + kHand ? number + kHand : number - kHand);
  }
  if (part < Part::left_eye) return std::nullopt;
  constexpr auto kFirst = static_cast<std::size_t>(Part::left_eye);
  return static_cast<Part>((number - kFirst) % 2 == 0 ? number + 1 : number - 1);
}

/// Which of a part's axes a mirror reverses: the one across the body for parts that use the trunk's axes, the third for
/// those along a bone. None if RigAxes has no axes of the part.
enum class Reversed { none, across, third };

Reversed reversed_axis(Part part, const RigMap& rig) {
  const auto has_limb = [&](Side side, Part upper, Part lower, Part end) {
    return rig.has(of(side, upper)) && rig.has(of(side, lower)) && rig.has(of(side, end));
  };
  const auto number = static_cast<std::size_t>(part);
  constexpr auto kFirst = static_cast<std::size_t>(Part::left_eye);
  Side side = (number - kFirst) % 2 == 0 ? Side::left : Side::right;
  if (number >= kNamedParts) side = number < kNamedParts + kFingers.size() * kFingerPoints ? Side::left : Side::right;
  const bool arm = number > static_cast<std::size_t>(Part::jaw) &&
                   has_limb(side, Part::left_upper_arm, Part::left_forearm, Part::left_hand);
  if (number >= kNamedParts) return arm ? Reversed::third : Reversed::none;
  switch (part) {
    case Part::left_clavicle:
    case Part::right_clavicle:
      return arm ? Reversed::third : Reversed::across;
    case Part::left_upper_arm:
    case Part::right_upper_arm:
    case Part::left_forearm:
    case Part::right_forearm:
    case Part::left_hand:
    case Part::right_hand:
      return arm ? Reversed::third : Reversed::none;
    case Part::left_thigh:
    case Part::right_thigh:
    case Part::left_shin:
    case Part::right_shin:
      return has_limb(side, Part::left_thigh, Part::left_shin, Part::left_foot) ? Reversed::third : Reversed::none;
    default:
      return Reversed::across;
  }
}

/// Pairs joints from the top downwards.
class Pairing {
 public:
  Pairing(const Skeleton& skeleton, const RigMap& rig, JointIndex top, const std::vector<UsualRotation>& usual)
      : skeleton_(skeleton),
        rig_(rig),
        axes_(skeleton, rig),
        left_(left_at_rest()),
        usual_(usual),
        found_(skeleton.joint_count()),
        part_(skeleton.joint_count()) {
    take_parts(top);
    for (JointIndex joint = top; joint < static_cast<JointIndex>(found_.size()); ++joint) {
      const JointIndex parent = skeleton.joint(joint).parent;
      if (joint == top) {
        set_middle(joint, turn_about(left_));
      } else if (parent != kNoJoint && found_[at(parent)].joint != kNoJoint) {
        take(joint, parent);
      }
    }
  }

  std::vector<Counterpart> result() && { return std::move(found_); }

 private:
  struct PartTurn {
    JointIndex joint = kNoJoint;
    std::optional<Quaternionf> turn;
  };

  bool is_below(JointIndex joint, JointIndex top) const {
    while (joint > top) joint = skeleton_.joint(joint).parent;
    return joint == top;
  }

  /// The unit vector from right to left at rest.
  Vector3f left_at_rest() const {
    Vector3f left = axes_.trunk() * Vector3f::UnitY();
    // The last pair counts: clavicles, which grow from the chest itself, else shoulders.
    for (const Part part : {Part::left_thigh, Part::left_upper_arm, Part::left_clavicle}) {
      if (!rig_.has(part) || !rig_.has(of(Side::right, part))) continue;
      const Vector3f across = axes_.place(part) - axes_.place(of(Side::right, part));
      if (across.norm() > 2 * kSameOffset) left = across.normalized();
    }
    return snapped_to_axis(left, kSnappedOffset);
  }

  /// The turn that a part's axes give.
  Quaternionf axes_turn(Part to, Part from, Reversed axis) const {
    const bool foot = to >= Part::left_foot && to <= Part::right_toes;
    if (axis == Reversed::across && !foot) return turn_about(left_);
    const Quaternionf half = axis == Reversed::across ? Quaternionf(0, 0, 1, 0) : Quaternionf(0, 0, 0, 1);
    return (axes_[to] * half * axes_[from].conjugate()).normalized();
  }

  /// Finds the counterparts that the map gives. A joint with several parts takes the first.
  void take_parts(JointIndex top) {
    for (std::size_t i = 0; i < kPartCount; ++i) {
      const auto part = static_cast<Part>(i);
      const Part other = opposite(part).value_or(part);
      if (!rig_.has(part) || !rig_.has(other)) continue;
      const JointIndex joint = rig_[part].joint;
      const JointIndex from = rig_[other].joint;
      if (rig_[part].offset != Vector3f::Zero() || rig_[other].offset != Vector3f::Zero()) continue;
      if (part_[at(joint)].joint != kNoJoint || !is_below(joint, top) || !is_below(from, top)) continue;
      if (part_[at(from)].joint != kNoJoint && part_[at(from)].joint != joint) continue;
      part_[at(joint)].joint = from;
      const Reversed axis = reversed_axis(part, rig_);
      if (axis != Reversed::none && reversed_axis(other, rig_) == axis) {
        part_[at(joint)].turn = axes_turn(part, other, axis);
      }
    }
  }

  const Quaternionf& parent_turn(JointIndex joint) const {
    const JointIndex parent = skeleton_.joint(joint).parent;
    return found_[at(parent)].turn;
  }

  /// The turn for which the usual rotations are mirror images, given that of the parent.
  Quaternionf usual_turn(JointIndex joint, JointIndex from) const {
    return (usual_[at(joint)].mean.conjugate() * parent_turn(joint) * usual_[at(from)].mean).normalized();
  }

  bool is_above_chest(JointIndex joint) const {
    return rig_.has(Part::neck) ? is_below(joint, rig_[Part::neck].joint)
                                : rig_.has(Part::head) && is_below(joint, rig_[Part::head].joint);
  }

  void set_middle(JointIndex joint, Quaternionf turn) {
    const Vector3f usual = snapped_to_axis(usual_[at(joint)].left, kSnappedPose);
    if (misfit(joint, joint, turn) > kMisfit) {
      turn = turn_about(left_of_children(joint));
    } else if (line_angle(usual, turn.vec()) > (is_above_chest(joint) ? kHeadContradicts : kContradicts) &&
               misfit(joint, joint, turn_about(usual)) <= kMisfit) {
      turn = turn_about(usual);
    }
    found_[at(joint)] = {joint, turn};
  }

  /// The turn of a pair: that of the axes unless bones show that these are of another space.
  Quaternionf pair_turn(JointIndex joint, JointIndex from, const std::optional<Quaternionf>& axes) const {
    Quaternionf best = axes.value_or(parent_turn(joint));
    float least = misfit(joint, from, best);
    if (least <= kMisfit) return best;
    for (const Quaternionf& other : {usual_turn(joint, from), parent_turn(joint)}) {
      if (misfit(joint, from, other) >= least) continue;
      best = other;
      least = misfit(joint, from, best);
    }
    return best;
  }

  /// Calls `use(offset, offset of the counterpart)` for each child of a joint whose counterpart is a child of `from`.
  template <class Use>
  void for_children(JointIndex joint, JointIndex from, Use&& use) const {
    for (JointIndex child = joint + 1; child < static_cast<JointIndex>(found_.size()); ++child) {
      const JointIndex other = part_[at(child)].joint;
      if (skeleton_.joint(child).parent != joint || other == kNoJoint) continue;
      if (skeleton_.joint(other).parent == from) use(skeleton_.joint(child).offset, skeleton_.joint(other).offset);
    }
  }

  /// The largest angle between a bone and the mirror image of the counterpart's; of a joint in the middle, between the
  /// lines from right to left. 0 if it has no such bones.
  float misfit(JointIndex joint, JointIndex from, const Quaternionf& turn) const {
    float most = 0;
    if (joint == from) {
      const Vector3f left = left_of_children(joint);
      if (left.isZero()) return 0;
      return line_angle(left, turn.vec());
    }
    for_children(joint, from, [&](const Vector3f& own, const Vector3f& others) {
      const Vector3f seen = -(turn * others);
      if (own.norm() > kSameOffset) most = std::max(most, std::atan2(own.cross(seen).norm(), own.dot(seen)));
    });
    return most;
  }

  /// The unit vector from right to left, up to its sign, between the children that are a pair and farthest apart; zero
  /// if there is none.
  Vector3f left_of_children(JointIndex joint) const {
    Vector3f left = Vector3f::Zero();
    for_children(joint, joint, [&](const Vector3f& own, const Vector3f& others) {
      if ((own - others).norm() > std::max(left.norm(), kSameOffset)) left = own - others;
    });
    return left.isZero() ? left : Vector3f(left.normalized());
  }

  void set_pair(JointIndex joint, JointIndex from, const Quaternionf& turn) {
    found_[at(joint)] = {from, turn};
    found_[at(from)] = {joint, turn.conjugate()};
  }

  void take(JointIndex joint, JointIndex parent) {
    if (found_[at(joint)].joint != kNoJoint) return;
    const PartTurn& part = part_[at(joint)];
    const bool in_middle = found_[at(parent)].joint == parent;
    if (part.joint == joint) {
      if (in_middle) set_middle(joint, part.turn.value_or(parent_turn(joint)));
    } else if (part.joint != kNoJoint) {
      set_pair(joint, part.joint, pair_turn(joint, part.joint, part.turn));
    } else if (const JointIndex from = same_place(joint, found_[at(parent)].joint); from == joint) {
      set_middle(joint, usual_[at(joint)].still ? usual_turn(joint, joint) : parent_turn(joint));
    } else if (from != kNoJoint) {
      const bool still = usual_[at(joint)].still && usual_[at(from)].still;
      set_pair(joint, from, still ? usual_turn(joint, from) : parent_turn(joint));
    }
  }

  /// The free child of `parent` below which the counterparts of the parts below `joint` are; kNoJoint if there is none.
  JointIndex same_parts(JointIndex joint, JointIndex parent) const {
    for (JointIndex below = joint + 1; below < static_cast<JointIndex>(found_.size()); ++below) {
      if (part_[at(below)].joint == kNoJoint || !is_below(below, joint)) continue;
      JointIndex other = part_[at(below)].joint;
      while (other > parent && skeleton_.joint(other).parent != parent) other = skeleton_.joint(other).parent;
      const bool free = other > parent && part_[at(other)].joint == kNoJoint && found_[at(other)].joint == kNoJoint;
      return free ? other : kNoJoint;
    }
    return kNoJoint;
  }

  /// The free child of a joint that is the mirror image of `joint`: by the parts below it, by name, else the one whose
  /// offset is nearest.
  JointIndex same_place(JointIndex joint, JointIndex parent) const {
    if (const JointIndex other = same_parts(joint, parent); other != kNoJoint) return other;
    const auto name = other_side(skeleton_.joint(joint).name);
    const Vector3f wanted = -(parent_turn(joint).conjugate() * skeleton_.joint(joint).offset);
    const bool in_middle = parent == skeleton_.joint(joint).parent;
    JointIndex nearest = kNoJoint;
    float least = kSameOffset + 0.1f * wanted.norm();
    for (JointIndex child = parent + 1; child < static_cast<JointIndex>(found_.size()); ++child) {
      if (skeleton_.joint(child).parent != parent || found_[at(child)].joint != kNoJoint) continue;
      if (part_[at(child)].joint != kNoJoint) continue;
      if (name && child != joint && skeleton_.joint(child).name == *name) return child;
      const float distance = (skeleton_.joint(child).offset - wanted).norm();
      if (name || distance > least || (distance == least && child != joint)) continue;
      least = distance;
      nearest = child;
    }
    return nearest != kNoJoint || name || !in_middle ? nearest : joint;
  }

  const Skeleton& skeleton_;
  const RigMap& rig_;
  RigAxes axes_;
  Vector3f left_;  ///< to the signer's left where every rotation is the identity, unit
  const std::vector<UsualRotation>& usual_;
  std::vector<Counterpart> found_;
  std::vector<PartTurn> part_;
};

}  // namespace

std::vector<UsualRotation> usual_rotations(const Motion& motion) {
  std::vector<UsualRotation> usual(motion.skeleton().joint_count());
  for (std::size_t joint = 0; joint < usual.size(); ++joint) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const Eigen::Vector4d turn = motion.pose(frame).rotations[joint].coeffs().cast<double>();
      if (turn.allFinite()) sum += sum.dot(turn) < 0 ? Eigen::Vector4d(-turn) : turn;
    }
    if (sum.norm() > 1e-3) usual[joint].mean = Quaternionf(Eigen::Vector4f(sum.normalized().cast<float>()));
    usual[joint].still = true;
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const Quaternionf& turn = motion.pose(frame).rotations[joint];
      if (turn.coeffs().allFinite() && turn_angle(usual[joint].mean, turn) > kStillTurn) usual[joint].still = false;
    }
  }
  return usual;
}

std::vector<Counterpart> counterparts(const Skeleton& skeleton, const RigMap& rig, JointIndex top,
                                      const std::vector<UsualRotation>& usual) {
  return Pairing(skeleton, rig, top, usual).result();
}

}  // namespace signweave
