#include "signweave/formats/gltf/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::gltf {

void require_finite(const Motion& motion) {
  const auto refuse = [](std::size_t frame, const std::string& what) {
    throw Error(ErrorCode::bad_input,
                fmt::format("frame {}: {} is not a finite number; glTF allows no other", frame, what));
  };
  const Skeleton& skeleton = motion.skeleton();
  const std::size_t joints = skeleton.joint_count();
  for (std::size_t i = 0; i < motion.rotations().size(); ++i) {
    const float square = motion.rotations()[i].squaredNorm();
    if (std::isfinite(square) && square > 1e-12f) continue;
    refuse(i / joints, "the rotation of '" + skeleton.joint(static_cast<JointIndex>(i % joints)).name + "'");
  }
  const auto moved = skeleton.translated_joints();
  for (std::size_t i = 0; i < motion.translations().size(); ++i) {
    if (motion.translations()[i].allFinite()) continue;
    refuse(i / moved.size(), "the translation of '" + skeleton.joint(moved[i % moved.size()]).name + "'");
  }
  for (const ScalarTrack& track : motion.tracks()) {
    for (std::size_t frame = 0; frame < track.values.size(); ++frame) {
      if (!std::isfinite(track.values[frame])) refuse(frame, "track '" + track.name + "'");
    }
  }
}

bool rotation_keys(const Motion& motion, std::size_t joint, std::vector<Eigen::Vector4f>& keys) {
  const std::size_t joints = motion.skeleton().joint_count();
  keys.resize(static_cast<std::size_t>(motion.frame_count()));
  for (std::size_t frame = 0; frame < keys.size(); ++frame) {
    const Eigen::Vector4d wanted = motion.rotations()[frame * joints + joint].coeffs().cast<double>();
    keys[frame] = wanted.normalized().cast<float>();
    // q and -q are the same rotation, but a viewer interpolates neighbours with the signs they have.
    if (frame > 0 && keys[frame].dot(keys[frame - 1]) < 0) keys[frame] *= -1;
  }
  return std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return key != keys[0]; });
}

bool translation_keys(const Motion& motion, std::size_t translated, std::vector<Eigen::Vector3f>& keys) {
  const std::size_t moved = motion.skeleton().translation_count();
  keys.resize(static_cast<std::size_t>(motion.frame_count()));
  for (std::size_t frame = 0; frame < keys.size(); ++frame)
    keys[frame] = motion.translations()[frame * moved + translated];
  return std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return key != keys[0]; });
}

std::string utf8(std::string text) {
  if (!is_utf8(text)) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }, '?');
  }
  return text;
}

}  // namespace signweave::gltf
