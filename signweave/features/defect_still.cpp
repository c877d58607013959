#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave::defect {
namespace {

// All (ours): captured numbers tremble, so a joint that is followed at all changes in nearly every frame.
constexpr double kLong = 1.0;            // seconds of a stretch that counts
constexpr double kLive = 0.95;           // share of its other frames in which a joint must change
constexpr double kLeastElsewhere = 0.1;  // of the motion must be such other frames
constexpr double kRestless = 0.5;        // share of the moving joints that must change in nearly every frame
constexpr double kBodyMoves = 0.9;       // share of the stretch in which the body must move
constexpr std::int64_t kBodyPart = 4;    // a body moves where one in so many of its joints does
constexpr std::int64_t kAlike = 2;       // frames by which stretches of joints lost together may differ

bool same_bits(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) noexcept {
  return std::memcmp(a.coeffs().data(), b.coeffs().data(), sizeof(float) * 4) == 0;
}

}  // namespace

std::string names_of(const Skeleton& skeleton, const std::vector<JointIndex>& joints, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (i == most && joints.size() > most + 1) {
      return fmt::format("{} and {} more", text, joints.size() - most);
    }
    text += i == 0 ? "" : i + 1 == joints.size() ? " and " : ", ";
    text += printable(skeleton.joint(joints[i]).name);
  }
  return text;
}

StillWatch::StillWatch(const Motion& motion, const RigMap& rig)
    : motion_(motion),
      rig_(rig),
      shortest_(std::max<std::int64_t>(3, std::llround(kLong * motion.rate().hertz()))),
      joints_(motion.skeleton().joint_count()),
      in_long_runs_(motion.skeleton().joint_count(), 0),
      moving_(static_cast<std::size_t>(motion.frame_count()), 0) {}

void StillWatch::see(std::int64_t frame) {
  if (frame == 0) return;
  const PoseView before = motion_.pose(frame - 1);
  const PoseView now = motion_.pose(frame);
  std::uint32_t moving = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (same_bits(before.rotations[i], now.rotations[i])) continue;
    ++joints_[i].changes;
    ++moving;
    end_run(static_cast<JointIndex>(i), frame);
    joints_[i].since = frame;
  }
  moving_[static_cast<std::size_t>(frame)] =
      static_cast<std::uint16_t>(std::min<std::uint32_t>(moving, std::numeric_limits<std::uint16_t>::max()));
}

void StillWatch::end_run(JointIndex joint, std::int64_t end) {
  Joint& of = joints_[static_cast<std::size_t>(joint)];
  const FrameRange frames{of.since, end};
  if (frames.size() >= shortest_) {
    runs_.push_back({joint, frames});
    in_long_runs_[static_cast<std::size_t>(joint)] += frames.size() - 1;
  } else {
    of.short_still += frames.size() - 1;
  }
}

/// A value that a joint also has at other times is where it rests or where its range ends.
bool StillWatch::comes_back(const Run& run) const {
  const auto joint = static_cast<std::size_t>(run.joint);
  const Eigen::Quaternionf& held = motion_.pose(run.frames.begin).rotations[joint];
  for (std::int64_t frame = 0; frame < motion_.frame_count(); ++frame) {
    if (frame == run.frames.begin) frame = run.frames.end;
    if (frame >= motion_.frame_count()) break;
    if (same_bits(held, motion_.pose(frame).rotations[joint])) return true;
  }
  return false;
}

bool StillWatch::is_frozen(const Run& run, std::int64_t live) const {
  const Joint& joint = joints_[static_cast<std::size_t>(run.joint)];
  const std::int64_t elsewhere = joint.changes + joint.short_still;
  const auto steps = static_cast<double>(motion_.frame_count() - 1);
  if (static_cast<double>(elsewhere) < kLeastElsewhere * steps) return false;
  if (static_cast<double>(joint.changes) < kLive * static_cast<double>(elsewhere)) return false;
  std::int64_t moving = 0;
  for (std::int64_t frame = run.frames.begin + 1; frame < run.frames.end; ++frame) {
    const std::int64_t others = moving_[static_cast<std::size_t>(frame)];
    moving += others > 0 && others * kBodyPart >= live ? 1 : 0;
  }
  if (static_cast<double>(moving) < kBodyMoves * static_cast<double>(run.frames.size() - 1)) return false;
  return !comes_back(run);
}

void StillWatch::tell_frozen(std::vector<Defect>& out) const {
  const auto live = static_cast<std::int64_t>(
      std::count_if(joints_.begin(), joints_.end(), [](const Joint& joint) { return joint.changes > 0; }));
  // Where most joints rest now and then, the motion was drawn or edited, and rests are part of it.
  const auto restless = std::count_if(joints_.begin(), joints_.end(), [&](const Joint& joint) {
    return static_cast<double>(joint.changes) >= kLive * static_cast<double>(motion_.frame_count() - 1);
  });
  if (static_cast<double>(restless) < kRestless * static_cast<double>(live)) return;
  std::vector<Run> frozen;
  std::copy_if(runs_.begin(), runs_.end(), std::back_inserter(frozen),
               [&](const Run& run) { return is_frozen(run, live); });
  std::stable_sort(frozen.begin(), frozen.end(), [](const Run& a, const Run& b) { return a.joint < b.joint; });
  std::vector<bool> told(frozen.size(), false);
  for (std::size_t i = 0; i < frozen.size(); ++i) {
    if (told[i]) continue;
    std::vector<JointIndex> joints;
    FrameRange frames = frozen[i].frames;
    for (std::size_t k = i; k < frozen.size(); ++k) {  // lost together: told together
      if (told[k] || std::abs(frozen[k].frames.begin - frozen[i].frames.begin) > kAlike ||
          std::abs(frozen[k].frames.end - frozen[i].frames.end) > kAlike) {
        continue;
      }
      told[k] = true;
      joints.push_back(frozen[k].joint);
    }
    out.push_back({.kind = DefectKind::frozen_joint,
                   .joint = joints.front(),
                   .frames = frames,
                   .value = static_cast<float>(static_cast<double>(frames.size()) / motion_.rate().hertz()),
                   .text = fmt::format("{} {} still to the bit for {:.1f} s while the body moves: the capture lost {}",
                                       names_of(motion_.skeleton(), joints), joints.size() == 1 ? "keeps" : "keep",
                                       static_cast<double>(frames.size()) / motion_.rate().hertz(),
                                       joints.size() == 1 ? "it" : "them")});
  }
}

std::vector<JointIndex> StillWatch::signing_joints_that_never_move() const {
  std::vector<JointIndex> never;
  const auto look = [&](Part part) {
    const PartPlace& place = rig_[part];
    if (place.known() && joints_[static_cast<std::size_t>(place.joint)].changes == 0) never.push_back(place.joint);
  };
  for (const Part part : {Part::neck, Part::head}) look(part);
  for (const Side side : kSides) {
    for (const Part part : {Part::left_upper_arm, Part::left_forearm, Part::left_hand}) look(of(side, part));
    for (const Finger finger : kFingers) {
      for (const FingerPoint point : {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal}) {
        look(finger_part(side, finger, point));
      }
    }
  }
  std::sort(never.begin(), never.end());
  never.erase(std::unique(never.begin(), never.end()), never.end());
  return never;
}

std::vector<Defect> StillWatch::found() {
  std::vector<Defect> result;
  bool moves = false;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    end_run(static_cast<JointIndex>(i), motion_.frame_count());
    moves = moves || joints_[i].changes > 0;
  }
  // A motion too short or without any movement tells nothing.
  if (motion_.frame_count() < shortest_ || !moves) return result;
  const std::vector<JointIndex> never = signing_joints_that_never_move();
  if (!never.empty()) {
    Defect defect{.kind = DefectKind::frozen_joint};
    defect.text = fmt::format("{} never {}: not captured, so signs lack {}", names_of(motion_.skeleton(), never, 6),
                              never.size() == 1 ? "moves" : "move", never.size() == 1 ? "it" : "them");
    result.push_back(std::move(defect));
  }
  tell_frozen(result);
  return result;
}

}  // namespace signweave::defect
