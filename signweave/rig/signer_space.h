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
/// Across: within half a shoulder width and a little of the middle, or beyond. Stored on disk: never renumber.
enum class Across : std::uint8_t { left = 0, centre = 1, right = 2 };
/// How far in front. Stored on disk: never renumber.
enum class Reach : std::uint8_t { near = 0, far = 1 };
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
  float near_reach = 0;  ///< z up to which a place is near, shoulder widths
  float arm_length = 0;  ///< shoulder to wrist, shoulder widths
};

/// None where the map lacks a shoulder (then `why_not` says what is missing).
std::optional<SignerBody> signer_body(const Motion& motion, const RigMap& rig);
/// Why there is no signer-centred space: "no left shoulder: name it in a mapping file"; empty where there is one.
std::string why_no_signer_space(const RigMap& rig);

/// The space of one pose. Robust to the signer turning: it turns about the vertical with the shoulders, does not lean
/// with the trunk, and where the shoulders stand one above the other (no direction across) it takes the trunk's.
SignerSpace signer_space(const SignerBody& body, const RigMap& rig, const ModelPose& pose) noexcept;

/// The zone of a place (shoulder widths, signer-centred space).
Zone zone_of(const Eigen::Vector3f& place, const SignerBody& body) noexcept;

}  // namespace signweave
