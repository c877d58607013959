#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// Signer-centred space at one moment: origin between the shoulders, x to the signer's left, y up, z forward, unit the
/// distance between the shoulders.
struct SignerSpace {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();                       ///< metres, model space
  Eigen::Quaternionf model_from_signer = Eigen::Quaternionf::Identity();  ///< turns signer's axes into the model's
  float unit = 1;                                                         ///< metres; above 0

  /// A point of model space (metres) in signer-centred space (shoulder widths).
  Eigen::Vector3f to_signer(const Eigen::Vector3f& point) const {
    return model_from_signer.conjugate() * (point - origin) / unit;
  }
  /// A direction or velocity of model space along the signer's axes; its length is kept.
  Eigen::Vector3f turn_to_signer(const Eigen::Vector3f& vector) const { return model_from_signer.conjugate() * vector; }
  Eigen::Vector3f to_model(const Eigen::Vector3f& point) const { return origin + model_from_signer * (unit * point); }
};

/// Named heights, lowest first: where on the body a place is. Stored on disk: never renumber.
enum class Height : std::uint8_t {
  below_waist = 0,
  waist = 1,
  chest = 2,
  shoulder = 3,
  chin = 4,
  mouth = 5,
  forehead = 6,
  above_head = 7,
};
/// Across: within kCentre of the middle, or beyond. Stored on disk: never renumber.
enum class Across : std::uint8_t { left = 0, centre = 1, right = 2 };
/// How far in front. Stored on disk: never renumber.
enum class Reach : std::uint8_t { near = 0, far = 1 };
/// Half a shoulder width and a little. (ours)
inline constexpr float kCentre = 0.6f;  ///< shoulder widths
struct Zone {
  Height height = Height::chest;
  Across across = Across::centre;
  Reach reach = Reach::near;
  friend bool operator==(Zone, Zone) = default;
};
std::string_view name_of(Height height) noexcept;
std::string_view name_of(Across across) noexcept;
std::string_view name_of(Reach reach) noexcept;

/// What does not change over a motion of one signer: sizes, heights.
struct SignerBody {
  float shoulder_width = 0;  ///< metres: median over the motion; above 0
  /// y of each height's lower border, shoulder widths, ascending; [below_waist] is minus infinity.
  std::array<float, 8> heights{};
  float near_reach = 0;         ///< z up to which a place is near, shoulder widths
  float arm_length = 0;         ///< shoulder to wrist along the bones, shoulder widths
  JointIndex trunk = kNoJoint;  ///< the joint from which both arms grow
  /// How the signer's axes stand in that joint's space while the shoulders tell them.
  Eigen::Quaternionf trunk_from_signer = Eigen::Quaternionf::Identity();
};

/// Measured over at most kBodyFrames frames, spread evenly. Heights come from the body's own joints
/// where it has such, else from its proportions (docs/signing-space.md). None where the map lacks a shoulder, of
/// a motion without frames, and where the shoulders lie nearer together than a fifth of the trunk: those are none.
std::optional<SignerBody> signer_body(const Motion& motion, const RigMap& rig);
inline constexpr std::int64_t kBodyFrames = 240;
/// Why a map gives no signer-centred space: "no left shoulder: name it in a mapping file"; empty where it has both.
std::string why_no_signer_space(const RigMap& rig);

/// The space of one pose, of which the shoulders and the joint `body.trunk` are looked at. It turns about the vertical
/// with the shoulders and does not lean with the trunk; the less the shoulders tell of a direction across (one above
/// the other, or in one place), the more the trunk's own counts, without a step. Numbers that are none give a space,
/// too.
SignerSpace signer_space(const SignerBody& body, const RigMap& rig, const ModelPose& pose) noexcept;

/// The zone of a place (shoulder widths, signer-centred space).
Zone zone_of(const Eigen::Vector3f& place, const SignerBody& body) noexcept;

}  // namespace signweave
