#include "demo/sheets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/drawing/contact_sheet.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

constexpr const char* kNote = "synthetic motion: placeholder shapes, not LSF";

/// A right hand on a stand, fingers up.
std::shared_ptr<const Skeleton> lone_hand(const Signer& signer) {
  const SideJoints& side = signer.right;
  std::vector<Joint> joints = {{"Stand", kNoJoint, {0, 0, 0}, true}};
  Joint hand = signer.skeleton->joint(side.hand);
  hand.parent = 0;
  hand.offset = Vector3f::Zero();
  joints.push_back(hand);
  std::vector<Tip> tips;
  for (const auto& finger : side.fingers) {
    JointIndex parent = 1;
    for (const JointIndex joint : finger) {
      Joint copy = signer.skeleton->joint(joint);
      copy.parent = parent;
      joints.push_back(copy);
      parent = static_cast<JointIndex>(joints.size()) - 1;
    }
    for (const Tip& tip : signer.skeleton->tips()) {
      if (tip.joint == finger.back()) tips.push_back({parent, tip.offset});
    }
  }
  return std::make_shared<const Skeleton>(std::move(joints), std::move(tips));
}

}  // namespace

std::string stroke_sheet(const SyntheticRecording& recording) {
  ContactSheetOptions options;
  options.columns = 8;
  options.title = recording.name + ": begin and end of every stroke";
  options.note = kNote;
  for (const PlacedSign& sign : recording.timeline.signs) {
    options.frames.push_back(sign.stroke_begin);
    options.captions.push_back(fmt::format("{} [", sign.shape->gloss));
    options.frames.push_back(sign.stroke_end);
    options.captions.push_back(fmt::format("{} ]", sign.shape->gloss));
  }
  return contact_sheet(recording.motion, options);
}

std::string sentence_sheet(const SyntheticRecording& recording, std::size_t sentence, double turn,
                           double figures_per_second) {
  ContactSheetOptions options;
  options.columns = 10;
  options.note = kNote;
  options.turn = turn;
  const Timeline& timeline = recording.timeline;
  const double step = std::max(1.0, timeline.rate.hertz() / figures_per_second);
  std::size_t number = 0;
  std::vector<const PlacedSign*> signs;
  for (std::size_t i = 0; i < timeline.signs.size(); ++i) {
    if (number == sentence) signs.push_back(&timeline.signs[i]);
    if (ends_unit(timeline, i)) ++number;
  }
  if (signs.empty()) return contact_sheet(recording.motion, options);
  options.title = recording.name + ":";
  for (const PlacedSign* sign : signs) options.title += fmt::format(" {}", sign->shape->gloss);
  for (int k = 0;; ++k) {
    const auto frame = static_cast<std::int64_t>(std::llround(static_cast<double>(signs.front()->begin) + k * step));
    if (frame >= signs.back()->end) break;
    const auto sign = std::find_if(signs.begin(), signs.end(), [&](const PlacedSign* one) { return frame < one->end; });
    const bool stroke = frame >= (*sign)->stroke_begin && frame <= (*sign)->stroke_end;
    options.frames.push_back(frame);
    options.captions.push_back(stroke ? std::string((*sign)->shape->gloss)
                                      : fmt::format("{:.2f} s", static_cast<double>(frame) / timeline.rate.hertz()));
  }
  return contact_sheet(recording.motion, options);
}

std::string handshape_sheet() {
  const Signer signer = make_signer();
  Motion motion(lone_hand(signer), {100, 1}, 2 * kHandshapes);
  ContactSheetOptions options;
  options.columns = 10;
  options.title = "Handshapes of the synthetic signer";
  options.note = "placeholder shapes, not LSF";
  // In the rest pose the right hand points to −x with the palm down: fingers up, palm to the viewer.
  const auto turn = [](float degrees, const Vector3f& axis) {
    return Eigen::Quaternionf(Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis));
  };
  Eigen::Matrix3f axes;
  axes.col(0) = -Vector3f::UnitY();
  axes.col(1) = -Vector3f::UnitZ();
  axes.col(2) = Vector3f::UnitX();
  const Eigen::Quaternionf up(axes);
  for (int i = 0; i < 2 * kHandshapes; ++i) {
    const auto shape = static_cast<Handshape>(i / 2);
    const MutablePoseView pose = motion.pose(i);
    pose.rotations[1] = turn(i % 2 == 0 ? 0.0f : -65.0f, Vector3f::UnitY()) * up;
    const FingerRotations fingers = finger_rotations(angles_of(shape), Side::right);
    std::size_t joint = 2;
    for (const auto& finger : fingers) {
      for (const Eigen::Quaternionf& rotation : finger) pose.rotations[joint++] = rotation;
    }
    options.frames.push_back(i);
    options.captions.emplace_back(name_of(shape));
  }
  return contact_sheet(motion, options);
}

}  // namespace signweave::demo
