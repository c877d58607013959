#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "signweave/features/hand_points.h"
#include "signweave/retarget/retarget.h"

namespace signweave {

/// Differences between a motion on a character and its source: one number per frame and hand (and finger).
struct RetargetFigures {
  std::vector<float> palm;     ///< between the palms' normals, degrees
  std::vector<float> fingers;  ///< between the directions from wrist to middle knuckle, degrees
  std::vector<float> thumb;    ///< difference in a fingertip's distance to the thumb tip, hand lengths
  std::vector<float> pinch;    ///< the same for fingertips near the thumb in the source: within 0.12 hand lengths
  std::vector<float> height;   ///< difference in the palm's height in signer-centred space, shoulder widths
  std::vector<float> held;     ///< the same, in the unit that the character's arms allow, if the arm is bent
  std::vector<float> place;    ///< difference in the palm's position, in that unit, if the arm is bent
  std::vector<float> hanging;  ///< difference in the palm's position if the arm is nearly straight: it stays so on arms
                               ///< of other lengths
  std::vector<float> inside;   ///< how deep a point of the hand is inside the body, metres
  std::vector<float> wrist;    ///< between forearm and hand, degrees
  std::vector<float> elbow;    ///< how far the elbow bends to the wrong side, as a fraction of the forearm; at least 0
  std::vector<float> step;     ///< a joint's rotation from one frame to the next, degrees

  /// "NAME: palm 0.01 0.02 0.05°, …": median, 95th percentile and worst value of each.
  std::string line(const std::string& name) const;
};

/// An arm is bent if its wrist is nearer to the shoulder than this fraction of the arm's length: then the character's
/// arm reaches the position, whatever its own lengths (see kStretchFrom and kMostRatio in retarget.cpp).
inline constexpr float kBent = 0.9f / 1.14f;

/// The quantile at `share`; `values` must not be empty.
inline float quantile(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline std::string RetargetFigures::line(const std::string& name) const {
  const auto three = [](const std::vector<float>& values, float scale, int digits) {
    if (values.empty()) return std::string("none");
    return fmt::format("{:.{}f} {:.{}f} {:.{}f}", scale * quantile(values, 0.5), digits, scale * quantile(values, 0.95),
                       digits, scale * quantile(values, 1), digits);
  };
  return fmt::format(
      "{}: palm {} deg, hand {} deg, thumb {} hand lengths, near it {}, height {} widths, {} as its arms reach, place "
      "{}, straight arms {}, inside {} mm, wrist {} deg, elbow {}, step {} deg",
      name, three(palm, 1, 2), three(fingers, 1, 2), three(thumb, 1, 3), three(pinch, 1, 3), three(height, 1, 3),
      three(held, 1, 3), three(place, 1, 3), three(hanging, 1, 3), three(inside, 1000, 1), three(wrist, 1, 0),
      three(elbow, 1, 2), three(step, 1, 1));
}

inline float degrees_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi_v<float>;
}

/// The length from the wrist along the middle finger, metres.
inline float length_of(const HandPoints& hand) {
  const HandPoints::OneFinger& middle = hand.finger(Finger::middle);
  float sum = (middle.points[0] - hand.wrist).norm();
  for (std::size_t i = 1; i < middle.count; ++i) sum += (middle.points[i] - middle.points[i - 1]).norm();
  return sum;
}
inline Eigen::Vector3f tip_of(const HandPoints& hand, Finger finger) {
  return hand.finger(finger).points[hand.finger(finger).count - 1];
}

/// `shown` is the motion retargeted to the character, frame for frame. Both must have hands with all fingers.
inline RetargetFigures measure_retargeting(const Motion& motion, const SignerModel& signer, const Motion& shown,
                                           const Character& character) {
  using Eigen::Vector3f;
  RetargetFigures figures;
  const RigAxes axes(*character.skeleton, character.rig);
  BodySurface surface(character, axes);
  const RigMap& rig = character.rig;
  const float ratio = Retargeter(motion.skeleton(), signer, character).unit_ratio();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ModelPose from = to_model_space(motion.skeleton(), motion.pose(frame));
    const ModelPose to = to_model_space(*character.skeleton, shown.pose(frame));
    const SignerSpace there = signer_space(*signer.body, signer.rig, from);
    const SignerSpace here = signer_space(*character.body, rig, to);
    SignerSpace reached = here;
    reached.unit = there.unit * ratio;
    surface.place(to);
    for (const Side side : kSides) {
      HandPoints a;
      HandPoints b;
      HandPlaces(signer.rig, side).read(from, a);
      HandPlaces(rig, side).read(to, b);
      figures.palm.push_back(degrees_between(axes_of(a, side).palm, axes_of(b, side).palm));
      figures.fingers.push_back(degrees_between(axes_of(a, side).fingers, axes_of(b, side).fingers));
      for (const Finger finger : {Finger::index, Finger::middle, Finger::ring, Finger::little}) {
        const float gap_there = (tip_of(a, finger) - tip_of(a, Finger::thumb)).norm() / length_of(a);
        const float gap_here = (tip_of(b, finger) - tip_of(b, Finger::thumb)).norm() / length_of(b);
        figures.thumb.push_back(std::abs(gap_here - gap_there));
        if (gap_there < 0.12f) figures.pinch.push_back(std::abs(gap_here - gap_there));
      }
      figures.height.push_back(std::abs(there.to_signer(palm_of(a)).y() - here.to_signer(palm_of(b)).y()));
      const Vector3f off = there.to_signer(palm_of(a)) - reached.to_signer(palm_of(b));
      const Part shoulder = of(side, Part::left_upper_arm);
      const Part middle = of(side, Part::left_forearm);
      const auto there_at = [&](Part part) { return position_of(signer.rig[part], from); };
      const float arm = (there_at(middle) - there_at(shoulder)).norm() + (a.wrist - there_at(middle)).norm();
      if ((a.wrist - there_at(shoulder)).norm() < kBent * arm) {
        figures.held.push_back(std::abs(off.y()));
        figures.place.push_back(off.norm());
      } else {
        figures.hanging.push_back(off.norm());
      }
      float deepest = 0;
      for (const Finger finger : kFingers) {
        for (const FingerPoint point : {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::tip}) {
          const Vector3f out = surface.push_out(position_of(rig[finger_part(side, finger, point)], to), 0.008f);
          deepest = std::max(deepest, out.norm());
        }
      }
      figures.inside.push_back(deepest);
      const Part elbow = of(side, Part::left_forearm);
      const Vector3f lower = (b.wrist - position_of(rig[elbow], to)).normalized();
      figures.wrist.push_back(degrees_between(lower, axes_of(b, side).fingers));
      const auto upper = static_cast<std::size_t>(character.skeleton->joint(rig[elbow].joint).parent);
      const Vector3f bend = to.rotations[upper] * (axes[of(side, Part::left_upper_arm)] * Vector3f::UnitY());
      figures.elbow.push_back(std::max(-lower.dot(bend), 0.0f));
    }
    if (frame == 0) continue;
    for (std::size_t i = 0; i < character.skeleton->joint_count(); ++i) {
      const Eigen::Quaternionf turn = shown.pose(frame - 1).rotations[i].conjugate() * shown.pose(frame).rotations[i];
      figures.step.push_back(2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 180 / std::numbers::pi_v<float>);
    }
  }
  return figures;
}

/// The character NAME.glb built by studio/avatar, or its plain variant: in the folder given by SIGNWEAVE_CHARACTERS,
/// else in build/characters. Nullopt if it was not built.
inline std::optional<std::filesystem::path> built_character(const std::string& name, bool plain = false) {
  const char* given = std::getenv("SIGNWEAVE_CHARACTERS");
  const auto folder = given != nullptr ? std::filesystem::path(given)
                                       : std::filesystem::path(SIGNWEAVE_SOURCE_DIR) / "build/characters";
  const auto path = folder / (name + (plain ? ".plain.glb" : ".glb"));
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}
inline constexpr const char* kNoCharacter =
    "not run: no character (studio/avatar/build makes it; SIGNWEAVE_CHARACTERS names its folder)";

}  // namespace signweave
