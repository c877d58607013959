#include "signweave/motion/skeleton.h"

#include <algorithm>

#include "signweave/core/error.h"

namespace signweave {

Skeleton::Skeleton(std::vector<Joint> joints, std::vector<Tip> tips)
    : joints_(std::move(joints)), tips_(std::move(tips)) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorCode::bad_input, "skeleton: " + what); };
  if (joints_.empty() || joints_.size() > 65'535) refuse("1 to 65535 joints are allowed");
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    if ((i == 0) != (joint.parent == kNoJoint))
      refuse("only the first joint has no parent, '" + joint.name + "' is wrong");
    if (joint.parent < kNoJoint || joint.parent >= static_cast<JointIndex>(i)) {
      refuse("joint '" + joint.name + "' comes before its parent");
    }
    if (!joint.offset.allFinite()) refuse("the offset of '" + joint.name + "' is not finite");
    if (joint.translated) translated_.push_back(static_cast<JointIndex>(i));
  }
  for (const Tip& tip : tips_) {
    if (tip.joint < 0 || tip.joint >= static_cast<JointIndex>(joints_.size())) refuse("a tip names no joint");
    if (!tip.offset.allFinite()) refuse("the offset of a tip is not finite");
  }
}

std::optional<std::size_t> Skeleton::translation_of(JointIndex joint) const noexcept {
  const auto at = std::lower_bound(translated_.begin(), translated_.end(), joint);
  if (at == translated_.end() || *at != joint) return std::nullopt;
  return static_cast<std::size_t>(at - translated_.begin());
}

std::optional<JointIndex> Skeleton::find(std::string_view name) const noexcept {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].name == name) return static_cast<JointIndex>(i);
  }
  return std::nullopt;
}

std::optional<std::string> difference(const Skeleton& a, const Skeleton& b) {
  const std::size_t common = std::min(a.joint_count(), b.joint_count());
  for (std::size_t i = 0; i < common; ++i) {
    const Joint& left = a.joints()[i];
    const Joint& right = b.joints()[i];
    const std::string place = "joint " + std::to_string(i);
    if (left.name != right.name) return place + " is '" + left.name + "' in one and '" + right.name + "' in the other";
    if (left.parent != right.parent) return place + " '" + left.name + "' has another parent";
    if (left.translated != right.translated) return place + " '" + left.name + "' has a translation in one only";
  }
  if (a.joint_count() != b.joint_count()) {
    const Skeleton& longer = a.joint_count() > b.joint_count() ? a : b;
    return "joint '" + longer.joints()[common].name + "' is in one only";
  }
  return std::nullopt;
}

}  // namespace signweave
