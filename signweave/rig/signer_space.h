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

/// Signer-centred space at one moment: the origin is between the shoulders, x points to the signer's left, y up, z
/// forward; the unit is the distance between the shoulders.
struct SignerSpace {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();                       ///< metres, model space
  Eigen::Quaternionf model_from_signer = Eigen::Quaternionf::Identity();  ///< rotates signer's axes to the model's
  float unit = 1;                                                         ///< metres; above 0

  /// Converts a point from model space (metres) to signer-centred space (shoulder widths).
  Eigen::Vector3f to_signer(const Eigen::Vector3f& point) const {
    return model_from_signer.conjugate() * (point - origin) / unit;
  }
  /// Rotates a direction or velocity from model space to the signer's axes; its length is unchanged.
  Eigen::Vector3f turn_to_signer(const Eigen::Vector3f& vector) const { return model_from_signer.conjugate() * vector; }
  Eigen::Vector3f to_model(const Eigen::Vector3f& point) const { return origin + model_from_signer * (unit * point); }
};

/// Named heights of a place relative to the body, lowest first. Stored on disk: never renumber.
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
/// Position across the body: within kCentre of the middle, or beyond. Stored on disk: never renumber.
enum class Across : std::uint8_t { left = 0, centre = 1, right = 2 };
/// Distance in front of the body. Stored on disk: never renumber.
enum class Reach : std::uint8_t { near = 0, far = 1 };
/// Slightly more than half a shoulder width. (ours)
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

/// Properties that are constant over a motion of one signer: sizes and heights.
struct SignerBody {
  float shoulder_width = 0;  ///< metres; median over the motion; above 0
  /// The y of each height's lower bound, shoulder widths, ascending; [below_waist] is minus infinity.
  std::array<float, 8> heights{};
  float near_reach = 0;         ///< the largest z of a near place, shoulder widths
  float arm_length = 0;         ///< from shoulder to wrist along the bones, shoulder widths
  JointIndex trunk = kNoJoint;  ///< the joint from which both arms grow
  /// The orientation of the signer's axes in the space of the joint `trunk`, measured while the shoulders determine
  /// them.
  Eigen::Quaternionf trunk_from_signer = Eigen::Quaternionf::Identity();
};

/// Measures a body over at most kBodyFrames frames, spread evenly. Heights come from the body's own joints if it has
/// them, otherwise from its proportions (docs/signing-space.md). Empty if the map lacks a shoulder, if the motion has
/// no frames, or if the distance between the shoulders is less than a fifth of the trunk, which no real shoulders have.
std::optional<SignerBody> signer_body(const Motion& motion, const RigMap& rig);
inline constexpr std::int64_t kBodyFrames = 240;
/// Why a map has no signer-centred space: "no left shoulder: name it in a mapping file"; empty if it has both
/// shoulders.
std::string why_no_signer_space(const RigMap& rig);

/// The space of one pose, determined by the shoulders and the joint `body.trunk`. It turns about the vertical with the
/// shoulders and does not lean with the trunk. The less the shoulders determine a direction across (one above the
/// other, or both at the same point), the more the trunk's own direction counts, without a step. NaN input still gives
/// a space.
SignerSpace signer_space(const SignerBody& body, const RigMap& rig, const ModelPose& pose) noexcept;

/// The zone of a place (signer-centred space, shoulder widths).
Zone zone_of(const Eigen::Vector3f& place, const SignerBody& body) noexcept;

}  // namespace signweave
