#include "signweave/formats/gltf/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "signweave/motion/kinematics.h"

namespace signweave::gltf {
namespace {

using Eigen::Quaterniond;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr std::int64_t kBlockFrames = 64;  // of all joints: as many as fit into a processor's cache

std::string joint_name(const Content& content, std::size_t node) {
  const std::string& name = content.model.nodes[node].name;
  return name.empty() ? fmt::format("node {}", node) : name;
}

/// Our writer names a tip's node "Hand tip", or "Hand tip 2" for a second one.
bool is_tip_name(std::string_view name) {
  while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.remove_suffix(1);
  return name.ends_with(" tip") || name.ends_with(" tip ");
}

/// Removes the tips from the joints.
std::vector<Tip> take_tips(const Content& content, std::vector<JointPlace>& places) {
  std::vector<Tip> tips;
  if (!content.is_ours()) return tips;
  std::vector<bool> carries(places.size(), false);
  for (const JointPlace& place : places) {
    if (place.parent != kNoJoint) carries[static_cast<std::size_t>(place.parent)] = true;
  }
  std::vector<JointIndex> number(places.size(), kNoJoint);
  std::vector<JointPlace> kept;
  for (std::size_t i = 0; i < places.size(); ++i) {
    JointPlace& place = places[i];
    if (place.parent != kNoJoint) place.parent = number[static_cast<std::size_t>(place.parent)];
    const bool still = !place.translated() && !place.rotation_curve && place.rotation.vec().isZero(1e-7);
    if (i > 0 && !carries[i] && still && is_tip_name(content.model.nodes[place.node].name)) {
      tips.push_back({place.parent, place.placed(place.translation).cast<float>()});
      continue;
    }
    number[i] = static_cast<JointIndex>(kept.size());
    kept.push_back(place);
  }
  places = std::move(kept);
  return tips;
}

/// Writes the rotations of one joint.
class RotationFiller {
 public:
  RotationFiller(const JointPlace& place, const Timing& timing)
      : place_(&place),
        reader_(place.rotation_curve
                    ? std::optional<CurveReader>(std::in_place, *place.rotation_curve, timing.rate.frame_time().count())
                    : std::nullopt),
        still_(Quaterniond(place.turned * place.rotation).normalized().cast<float>()),
        as_keys_(place.rotation_curve && place.rotation_curve->times->one_a_frame && place.turned.vec().isZero(0)) {}

  /// `out` is the joint's rotation in frame `begin`; successive frames are `stride` apart. Each rotation is in the
  /// hemisphere of the previous one, as with `keep_hemisphere`, without a second pass over the motion.
  void fill(std::int64_t begin, std::int64_t end, Quaternionf* out, std::size_t stride) {
    if (!reader_) {
      for (std::int64_t frame = begin; frame < end; ++frame, out += stride) *out = still_;
    } else if (as_keys_) {
      for (std::int64_t frame = begin; frame < end; ++frame, out += stride) {
        const std::span<const float> key = place_->rotation_curve->key(static_cast<std::size_t>(frame));
        const Quaternionf rotation(key[3], key[0], key[1], key[2]);
        // A rotation that is already unit keeps its bits, so that what we wrote is read back unchanged.
        const bool unit = std::abs(rotation.squaredNorm() - 1) < 1e-6f;
        *out = nearest_to_last(unit ? rotation : unit_rotation(key).cast<float>());
      }
    } else {
      for (std::int64_t frame = begin; frame < end; ++frame, out += stride) {
        const Quaterniond rotation = place_->turned * reader_->rotation_at(static_cast<double>(frame));
        *out = nearest_to_last(rotation.normalized().cast<float>());
      }
    }
  }

 private:
  Quaternionf nearest_to_last(Quaternionf rotation) {
    if (last_.dot(rotation) < 0) rotation.coeffs() = -rotation.coeffs();
    last_ = rotation;
    return rotation;
  }

  const JointPlace* place_;
  std::optional<CurveReader> reader_;
  Quaternionf still_;
  Quaternionf last_ = Quaternionf(0, 0, 0, 0);  ///< of the previous frame; zero before the first
  bool as_keys_;
};

/// Writes the translations of one joint.
class TranslationFiller {
 public:
  TranslationFiller(const JointPlace& place, const Timing& timing) : place_(&place) {
    const double frame_seconds = timing.rate.frame_time().count();
    if (place.translation_curve) own_.emplace(*place.translation_curve, frame_seconds);
    for (const Curve* growth : place.growth) growth_.emplace_back(*growth, frame_seconds);
  }

  Vector3f at(double frame) {
    Eigen::Vector3d result = place_->placed(own_ ? own_->vector_at(frame) : place_->translation);
    for (CurveReader& growth : growth_) result *= growth.vector_at(frame).mean();
    return result.cast<float>();
  }

  /// `out` is the translation in frame `begin`; successive frames are `stride` apart.
  void fill(std::int64_t begin, std::int64_t end, Vector3f* out, std::size_t stride) {
    for (std::int64_t frame = begin; frame < end; ++frame, out += stride) *out = at(static_cast<double>(frame));
  }

 private:
  const JointPlace* place_;
  std::optional<CurveReader> own_;
  std::vector<CurveReader> growth_;
};

}  // namespace

Motion motion_of(const Content& content, std::vector<JointPlace>& places, const Timing& timing, Budget& budget,
                 const std::function<void(double)>& progress) {
  std::vector<Tip> tips = take_tips(content, places);
  std::vector<Joint> joints;
  for (const JointPlace& place : places) {
    const Vector3f offset = place.growth.empty() ? Vector3f(place.placed(place.translation).cast<float>())
                                                 : TranslationFiller(place, timing).at(0);
    if (!offset.allFinite()) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("{}: {}: it is too far away", content.name, node_text(content, place.node)));
    }
    joints.push_back({.name = joint_name(content, place.node),
                      .parent = place.parent,
                      .offset = offset,
                      .translated = place.translated()});
  }
  const auto skeleton = std::make_shared<const Skeleton>(std::move(joints), std::move(tips));
  const std::size_t joint_count = places.size();
  const std::size_t translated = skeleton->translation_count();
  budget.spend(static_cast<std::uint64_t>(timing.frames),
               joint_count * sizeof(Quaternionf) + translated * sizeof(Vector3f),
               fmt::format("{} frames of {} joints", timing.frames, joint_count));

  std::vector<RotationFiller> turns;
  std::vector<TranslationFiller> moves;
  for (const JointPlace& place : places) {
    turns.emplace_back(place, timing);
    if (place.translated()) moves.emplace_back(place, timing);
  }
  Motion motion;
  motion.reset(skeleton, timing.rate, timing.frames);
  for (std::int64_t begin = 0; begin < timing.frames; begin += kBlockFrames) {
    const std::int64_t end = std::min(begin + kBlockFrames, timing.frames);
    const MutablePoses poses = motion.poses({begin, end});
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
      turns[joint].fill(begin, end, poses.rotations.data() + joint, joint_count);
    }
    for (std::size_t i = 0; i < translated; ++i) {
      moves[i].fill(begin, end, poses.translations.data() + i, translated);
    }
    if (progress && begin / kBlockFrames % 64 == 0) {
      progress(static_cast<double>(begin) / static_cast<double>(timing.frames));
    }
  }
  for (const Vector3f& translation : motion.translations()) {
    if (translation.allFinite()) continue;
    throw Error(ErrorCode::bad_input, fmt::format("{}: a joint moves too far away for a float", content.name));
  }
  assert(keeps_hemisphere(motion));
  return motion;
}

float size_of_first_pose(const Motion& motion) {
  const ModelPose pose = to_model_space(motion.skeleton(), std::as_const(motion).pose(0));
  Vector3f low = pose.positions[0];
  Vector3f high = pose.positions[0];
  for (const Vector3f& position : pose.positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  return (high - low).maxCoeff();
}

}  // namespace signweave::gltf
