#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "signweave/motion/skeleton.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// Joints that move together; each group has its own timing and trajectory over a gap.
enum class JointGroup : std::uint8_t {
  body = 0,      ///< root, trunk, head, legs, and all joints of no other group
  left_arm = 1,  ///< from the clavicle to the wrist joint, including helper joints; without the fingers
  right_arm = 2,
  left_fingers = 3,  ///< the descendants of the wrist joint
  right_fingers = 4,
};
inline constexpr std::size_t kJointGroups = 5;
std::string_view name_of(JointGroup group) noexcept;

/// A set of groups.
class GroupSet {
 public:
  constexpr GroupSet() = default;
  constexpr GroupSet(std::initializer_list<JointGroup> groups) {
    for (const JointGroup group : groups) bits_ = static_cast<std::uint8_t>(bits_ | bit(group));
  }
  static constexpr GroupSet all() {
    return {JointGroup::body, JointGroup::left_arm, JointGroup::right_arm, JointGroup::left_fingers,
            JointGroup::right_fingers};
  }
  constexpr bool has(JointGroup group) const noexcept { return (bits_ & bit(group)) != 0; }
  constexpr bool empty() const noexcept { return bits_ == 0; }
  /// The intersection with the other set, and the difference.
  constexpr GroupSet within(GroupSet other) const noexcept { return of_bits(bits_ & other.bits_); }
  constexpr GroupSet without(GroupSet other) const noexcept { return of_bits(bits_ & ~other.bits_); }
  friend constexpr bool operator==(GroupSet, GroupSet) = default;

 private:
  static constexpr GroupSet of_bits(int bits) noexcept {
    GroupSet set;
    set.bits_ = static_cast<std::uint8_t>(bits);
    return set;
  }
  static constexpr std::uint8_t bit(JointGroup group) noexcept {
    return static_cast<std::uint8_t>(1u << static_cast<unsigned>(group));
  }
  std::uint8_t bits_ = 0;
};

constexpr JointGroup arm_of(Side side) noexcept {
  return side == Side::left ? JointGroup::left_arm : JointGroup::right_arm;
}
constexpr JointGroup fingers_of(Side side) noexcept {
  return side == Side::left ? JointGroup::left_fingers : JointGroup::right_fingers;
}

/// The role of a joint in the trajectory of a hand.
enum class JointRole : std::uint8_t {
  other = 0,      ///< none: head, legs
  trunk = 1,      ///< an ancestor of an arm
  shoulder = 2,   ///< the upper arm's joint
  elbow = 3,      ///< the forearm's
  other_arm = 4,  ///< clavicle, wrist, helpers
  finger = 5,
};
inline constexpr std::size_t kJointRoles = 6;

/// The group of each joint. A rig with unknown hands has one group, the body.
struct JointGroups {
  std::vector<JointGroup> of;                             ///< [joint]
  std::array<std::vector<JointIndex>, kJointGroups> all;  ///< [group] its joints, ascending
  std::vector<JointGroup> of_translation;                 ///< [translated joint]
  std::vector<JointRole> roles;                           ///< [joint]
  std::array<JointIndex, 2> wrists{kNoJoint, kNoJoint};   ///< [Side]; kNoJoint: this arm is unknown

  const std::vector<JointIndex>& operator[](JointGroup group) const noexcept {
    return all[static_cast<std::size_t>(group)];
  }
};
JointGroups joint_groups(const Skeleton& skeleton, const RigMap& rig);

}  // namespace signweave
