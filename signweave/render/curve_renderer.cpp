#include "signweave/render/curve_renderer.h"

#include <algorithm>

#include "signweave/render/window.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

CurveRenderer::CurveRenderer(std::span<const AuthoredCurve> curves, const JunctionSettings& settings)
    : curves_(curves), settings_(settings) {
  const SignerModel& signer = settings.rig->signer;
  if (!signer.body) return;
  head_ = signer.rig[Part::head].joint;
  if (head_ == kNoJoint) return;
  const std::vector<JointIndex> needed = {head_, signer.rig[Part::left_upper_arm].joint,
                                          signer.rig[Part::right_upper_arm].joint, signer.body->trunk};
  chains_ = JointChains(*settings.skeleton, needed);
}

std::vector<std::string> CurveRenderer::tracks() const {
  std::vector<std::string> names;
  for (const AuthoredCurve& one : curves_) {
    for (std::string& name : tracks_of(one.curve)) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
    }
  }
  return names;
}

void CurveRenderer::apply(OutputWindow window) {
  std::vector<TrackSpan> tracks;
  std::vector<ScalarTrack> values = window.motion.take_tracks();
  for (ScalarTrack& track : values) tracks.push_back({track.name, track.values});
  for (const AuthoredCurve& one : curves_) {
    if (inside(one.at, window.frames()).empty()) continue;
    signweave::apply(one.curve, one.at, settings_.rate, window.frames(), tracks);
    if (one.curve.head.moves()) turn_head(one, window);
  }
  for (ScalarTrack& track : values) window.motion.add_track(std::move(track));
}

void CurveRenderer::turn_head(const AuthoredCurve& one, OutputWindow window) {
  if (head_ == kNoJoint) return;
  const auto head = static_cast<std::size_t>(head_);
  const JointIndex parent = settings_.skeleton->joints()[head].parent;
  const FrameRange shown = inside(one.at, window.frames());
  for (std::int64_t frame = shown.begin; frame < shown.end; ++frame) {
    const Eigen::Quaternionf turn = head_rotation(one.curve, one.at, settings_.rate, frame);
    if (turn.vec().isZero(0)) continue;
    const MutablePoseView pose = window.pose(frame);
    chains_.to_model_space(pose, pose_);
    const Eigen::Quaternionf axes =
        signer_space(*settings_.rig->signer.body, settings_.rig->signer.rig, pose_).model_from_signer;
    const Eigen::Quaternionf above =
        parent == kNoJoint ? Eigen::Quaternionf::Identity() : pose_.rotations[static_cast<std::size_t>(parent)];
    const Eigen::Quaternionf in_parent = above.conjugate() * (axes * turn * axes.conjugate()) * above;
    const Eigen::Quaternionf before = pose.rotations[head];
    Eigen::Quaternionf after = (in_parent * before).normalized();
    if (after.dot(before) < 0) after.coeffs() *= -1.0f;
    pose.rotations[head] = after;
  }
}

}  // namespace signweave
