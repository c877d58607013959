#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// The kinds of defects of a captured motion. Stored on disk: never renumber.
enum class DefectKind : std::uint8_t {
  t_pose = 0,        ///< frames in the T-pose: calibration, not signing
  frozen_joint = 1,  ///< a joint that moves at other times, or should move, stays bit-identical: a lost marker or glove
  jump = 2,          ///< a joint moves faster than a person can
  quaternion_flip = 3,  ///< adjacent frames in opposite hemispheres in the file
  permuted_root = 4,    ///< the root's columns are not what the file declares
  scale = 5,            ///< the body is too small or too large for a person, in metres
  not_finite = 6,       ///< values that are NaN or infinite
};
inline constexpr DefectKind kLastDefectKind = DefectKind::not_finite;
std::string_view name_of(DefectKind kind) noexcept;

/// One defect and its location.
struct Defect {
  DefectKind kind = DefectKind::jump;
  JointIndex joint = kNoJoint;  ///< kNoJoint: the whole body
  FrameRange frames;            ///< empty: the whole motion
  float value = 0;   ///< a jump's speed (m/s or rad/s, as stated in `text`), a scale defect's stature in metres
  std::string text;  ///< one line: the defect and how to fix it
  friend bool operator==(const Defect&, const Defect&) = default;
};

/// Returns the defects of a motion, sorted by kind, joint and frame. At most kMostDefects of one kind are reported
/// individually; the last one then says how many more there are.
std::vector<Defect> find_defects(const Motion& motion, const RigMap& rig);
inline constexpr std::size_t kMostDefects = 50;

}  // namespace signweave
