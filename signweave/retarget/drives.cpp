#include "signweave/retarget/drives.h"

#include "signweave/rig/joint_at.h"

#include <algorithm>
#include <string_view>

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// A joint on a chain and its position along the chain, in [0, 1].
struct ChainJoint {
  JointIndex joint;
  float along;
};

class Builder {
 public:
  Builder(const Skeleton& source, const RigMap& source_rig, const RigAxes& source_axes, const Character& character,
          const RigAxes& axes)
      : source_(source), from_(source_rig), from_axes_(source_axes), character_(character), axes_(axes) {
    made_.joints.resize(character.skeleton->joint_count());
  }

  Drives build() {
    trunk();
    for (const Side side : kSides) {
      arm(side);
      leg(side);
      fingers(side);
    }
    for (const Part part : {Part::head, Part::jaw, Part::left_eye, Part::right_eye}) drive_part(part);
    return std::move(made_);
  }

 private:
  const Skeleton& target() const { return *character_.skeleton; }
  const RigMap& to() const { return character_.rig; }
  Quaternionf correction(Part part) const { return from_axes_[part] * axes_[part].conjugate(); }

  void drive(JointIndex joint, JointIndex from, const Quaternionf& correction) {
    made_.joints[at(joint)] = {from, from, 0, correction, correction};
  }
  void drive_part(Part part) {
    if (from_.has(part) && to().has(part)) drive(to()[part].joint, from_[part].joint, correction(part));
  }

  static std::vector<ChainJoint> places(const std::vector<JointIndex>& path, const RigAxes& axes) {
    std::vector<ChainJoint> result;
    float sum = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i > 0) sum += (axes.places()[at(path[i])] - axes.places()[at(path[i - 1])]).norm();
      result.push_back({path[i], sum});
    }
    for (ChainJoint& joint : result) joint.along = sum > 0 ? joint.along / sum : 0;
    return result;
  }

  /// Drives the target's chain from the source's: each joint by the source joint at the same relative position, or by
  /// the two around it.
  void drive_chain(const std::vector<ChainJoint>& chain, const std::vector<ChainJoint>& keys,
                   const Quaternionf& correction) {
    for (const ChainJoint& place : chain) {
      std::size_t next = 0;
      while (next < keys.size() && keys[next].along <= place.along + 1e-5f) ++next;
      const ChainJoint& first = keys[next == 0 ? 0 : next - 1];
      if (next == 0 || next == keys.size()) {
        drive(place.joint, first.joint, correction);
        continue;
      }
      const ChainJoint& second = keys[next];
      const float share = (place.along - first.along) / (second.along - first.along);
      made_.joints[at(place.joint)] = {first.joint, second.joint, share, correction, correction};
      if (share < 1e-4f) made_.joints[at(place.joint)].second = first.joint;
    }
  }

  /// Returns the chain's joints from one part to the next, without the last one.
  static std::vector<ChainJoint> limb(const Skeleton& skeleton, const RigMap& rig, const RigAxes& axes, Part from,
                                      Part to) {
    std::vector<ChainJoint> chain = places(path_between(skeleton, rig[from].joint, rig[to].joint), axes);
    if (!chain.empty()) chain.pop_back();
    return chain;
  }
  bool both_have(Part a, Part b) const { return from_.has(a) && from_.has(b) && to().has(a) && to().has(b); }

  /// Returns whether the source has extra joints between the two parts.
  bool drive_limb(Part from, Part to_part) {
    if (!both_have(from, to_part)) return false;
    const auto keys = limb(source_, from_, from_axes_, from, to_part);
    const auto chain = limb(target(), to(), axes_, from, to_part);
    if (keys.empty()) return false;
    drive_chain(chain, keys, correction(from));
    return keys.size() > 1;
  }

  void trunk() {
    const auto low = [](const RigMap& rig) {
      for (const Part part : {Part::pelvis, Part::spine, Part::chest}) {
        if (rig.has(part)) return rig[part].joint;
      }
      return kNoJoint;
    };
    const auto high = [](const RigMap& rig) {
      for (const Part part : {Part::chest, Part::spine, Part::pelvis}) {
        if (rig.has(part)) return rig[part].joint;
      }
      return kNoJoint;
    };
    const JointIndex from_low = low(from_) == kNoJoint ? 0 : low(from_);
    const JointIndex from_high = high(from_) == kNoJoint ? from_low : high(from_);
    const JointIndex to_low = low(to()) == kNoJoint ? 0 : low(to());
    const JointIndex to_high = high(to()) == kNoJoint ? to_low : high(to());
    const Quaternionf turn = from_axes_.trunk() * axes_.trunk().conjugate();
    // Joints above the pelvis follow it.
    for (JointIndex joint = to_low; joint != kNoJoint; joint = target().joint(joint).parent) {
      drive(joint, from_low, turn);
    }
    const auto or_one = [](const std::vector<JointIndex>& path, JointIndex one) {
      return path.empty() ? std::vector<JointIndex>{one} : path;
    };
    const auto keys = places(or_one(path_between(source_, from_low, from_high), from_low), from_axes_);
    drive_chain(places(or_one(path_between(target(), to_low, to_high), to_low), axes_), keys, turn);
    // The neck is interpolated between chest and head. Without a head in the source it stays fixed to the trunk.
    if (!from_.has(Part::head) || !to().has(Part::head)) {
      made_.missing.emplace_back("no head: it stays fixed to the trunk");
      return;
    }
    auto up =
        places(or_one(path_between(source_, from_high, from_[Part::head].joint), from_[Part::head].joint), from_axes_);
    auto neck = places(path_between(target(), to_high, to()[Part::head].joint), axes_);
    if (neck.empty()) return;
    neck.erase(neck.begin());
    drive_chain(neck, up, turn);
  }

  void arm(Side side) {
    const auto i = static_cast<std::size_t>(side);
    const Part collar = of(side, Part::left_clavicle);
    const Part shoulder = of(side, Part::left_upper_arm);
    const Part elbow = of(side, Part::left_forearm);
    const Part wrist = of(side, Part::left_hand);
    if (both_have(collar, shoulder)) {
      const bool sideways = from_axes_.collar_is_lateral(side) && axes_.collar_is_lateral(side);
      const Quaternionf turn = sideways ? from_axes_.trunk() * axes_.trunk().conjugate() : correction(collar);
      const auto keys = limb(source_, from_, from_axes_, collar, shoulder);
      if (!keys.empty()) drive_chain(limb(target(), to(), axes_, collar, shoulder), keys, turn);
      made_.collar[i] = !keys.empty();
    }
    if (!both_have(shoulder, elbow) || !both_have(elbow, wrist)) {
      made_.missing.push_back(std::string("no ") + (side == Side::left ? "left" : "right") + " arm: it stays at rest");
      return;
    }
    made_.upper_twist[i] = drive_limb(shoulder, elbow);
    made_.lower_twist[i] = drive_limb(elbow, wrist);
    drive_part(wrist);
  }

  void leg(Side side) {
    const Part thigh = of(side, Part::left_thigh);
    const Part shin = of(side, Part::left_shin);
    const Part foot = of(side, Part::left_foot);
    drive_limb(thigh, shin);
    drive_limb(shin, foot);
    if (both_have(shin, foot)) {
      drive_part(foot);
      drive_part(of(side, Part::left_toes));
    } else if (to().has(foot)) {
      made_.missing.push_back(std::string("no ") + (side == Side::left ? "left" : "right") + " leg: it stays at rest");
    }
  }

  void fingers(Side side) {
    if (!from_.has(of(side, Part::left_hand)) || !to().has(of(side, Part::left_hand))) return;
    for (const Finger finger : kFingers) {
      bool any = false;
      for (std::size_t i = 0; i + 1 < kFingerPoints; ++i) {
        const Part part = finger_part(side, finger, static_cast<FingerPoint>(i));
        if (!from_.has(part) || !to().has(part)) continue;
        drive_part(part);
        any |= i > 0;
      }
      if (any || !to().has(finger_part(side, finger, FingerPoint::proximal))) continue;
      static constexpr std::array<std::string_view, 5> kNames = {"thumb", "index", "middle", "ring", "little"};
      made_.missing.push_back("no " + std::string(side == Side::left ? "left " : "right ") +
                              std::string(kNames[static_cast<std::size_t>(finger)]) + " finger: it stays at rest");
    }
  }

  const Skeleton& source_;
  const RigMap& from_;
  const RigAxes& from_axes_;
  const Character& character_;
  const RigAxes& axes_;
  Drives made_;
};

}  // namespace

std::vector<JointIndex> path_between(const Skeleton& skeleton, JointIndex upper, JointIndex lower) {
  std::vector<JointIndex> path;
  for (JointIndex joint = lower; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
    path.push_back(joint);
    if (joint == upper) {
      std::reverse(path.begin(), path.end());
      return path;
    }
  }
  return {};
}

Drives drives_of(const Skeleton& source, const RigMap& source_rig, const RigAxes& source_axes,
                 const Character& character, const RigAxes& axes) {
  return Builder(source, source_rig, source_axes, character, axes).build();
}

}  // namespace signweave
