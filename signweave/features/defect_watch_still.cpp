#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave::defect {
namespace {

// All values are ours: captured values fluctuate, so a tracked joint changes in nearly every frame.
constexpr double kLong = 1.0;            // minimum duration of a run that counts, seconds
constexpr double kLive = 0.95;           // fraction of its other frames in which a joint must change
constexpr double kLeastElsewhere = 0.1;  // minimum fraction of such other frames in the motion
constexpr double kRestless = 0.5;        // fraction of the moving joints that must change in nearly every frame
constexpr double kBodyMoves = 0.9;       // fraction of the run in which the body must move
constexpr std::int64_t kBodyPart = 4;    // a body moves if at least one in this many of its joints does
constexpr std::int64_t kAlike = 2;       // maximum difference in frames between runs of joints lost together

using Bits = std::array<std::uint32_t, 4>;

Bits bits_of(const Eigen::Quaternionf& rotation) noexcept {
  Bits bits;
  std::memcpy(bits.data(), rotation.coeffs().data(), sizeof bits);
  return bits;
}

bool same_bits(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) noexcept {
  return bits_of(a) == bits_of(b);
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
      joints_(motion.skeleton().joint_count()) {}

const Eigen::Quaternionf& StillWatch::rotation(std::int64_t index, JointIndex joint) const {
  return motion_.pose(shown_[static_cast<std::size_t>(index)]).rotations[static_cast<std::size_t>(joint)];
}

void StillWatch::see(std::int64_t frame) {
  const std::int64_t index = count();
  shown_.push_back(frame);
  moving_.push_back(0);
  if (index == 0) return;
  const PoseView before = motion_.pose(shown_[static_cast<std::size_t>(index - 1)]);
  const PoseView now = motion_.pose(frame);
  std::uint32_t moving = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (same_bits(before.rotations[i], now.rotations[i])) continue;
    ++joints_[i].changes;
    ++moving;
    end_run(static_cast<JointIndex>(i), index);
    joints_[i].since = index;
  }
  moving_.back() =
      static_cast<std::uint16_t>(std::min<std::uint32_t>(moving, std::numeric_limits<std::uint16_t>::max()));
}

void StillWatch::end_run(JointIndex joint, std::int64_t end) {
  Joint& of = joints_[static_cast<std::size_t>(joint)];
  const FrameRange steps{of.since, end};
  if (steps.size() >= shortest_) {
    runs_.push_back({joint, steps});
  } else {
    of.short_still += steps.size() - 1;
  }
}

/// A value that a joint also has at other times is its rest position or the end of its range.
void StillWatch::erase_recurring(std::vector<Run>& runs) const {
  if (runs.empty()) return;
  const JointIndex joint = runs.front().joint;
  std::vector<std::pair<Bits, std::int64_t>> times;  // number of frames with each held value, sorted by value
  for (const Run& run : runs) times.emplace_back(bits_of(rotation(run.steps.begin, joint)), 0);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const auto entry = [&](const Bits& bits) {
    return std::lower_bound(times.begin(), times.end(), bits,
                            [](const auto& held, const Bits& value) { return held.first < value; });
  };
  for (std::int64_t index = 0; index < count(); ++index) {
    const Bits bits = bits_of(rotation(index, joint));
    const auto held = entry(bits);
    if (held != times.end() && held->first == bits) ++held->second;
  }
  std::erase_if(runs, [&](const Run& run) {
    return entry(bits_of(rotation(run.steps.begin, joint)))->second > run.steps.size();
  });
}

/// Sorted by joint and frame.
std::vector<StillWatch::Run> StillWatch::frozen_runs() const {
  std::vector<Run> frozen;
  const auto steps = static_cast<double>(count() - 1);
  const auto live = static_cast<std::int64_t>(
      std::count_if(joints_.begin(), joints_.end(), [](const Joint& joint) { return joint.changes > 0; }));
  // If most joints rest now and then, the motion was animated or edited, and rests are part of it.
  const auto restless = std::count_if(joints_.begin(), joints_.end(), [&](const Joint& joint) {
    return static_cast<double>(joint.changes) >= kLive * steps;
  });
  if (static_cast<double>(restless) < kRestless * static_cast<double>(live)) return frozen;
  std::vector<Run> runs = runs_;
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.joint < b.joint; });
  const auto may_be_frozen = [&](const Run& run) {
    const Joint& joint = joints_[static_cast<std::size_t>(run.joint)];
    const std::int64_t elsewhere = joint.changes + joint.short_still;
    if (static_cast<double>(elsewhere) < kLeastElsewhere * steps) return false;
    if (static_cast<double>(joint.changes) < kLive * static_cast<double>(elsewhere)) return false;
    std::int64_t moving = 0;
    for (std::int64_t index = run.steps.begin + 1; index < run.steps.end; ++index) {
      const std::int64_t others = moving_[static_cast<std::size_t>(index)];
      moving += others > 0 && others * kBodyPart >= live ? 1 : 0;
    }
    return static_cast<double>(moving) >= kBodyMoves * static_cast<double>(run.steps.size() - 1);
  };
  for (std::size_t i = 0; i < runs.size();) {
    std::vector<Run> of_joint;
    const JointIndex joint = runs[i].joint;
    for (; i < runs.size() && runs[i].joint == joint; ++i) {
      if (may_be_frozen(runs[i])) of_joint.push_back(runs[i]);
    }
    erase_recurring(of_joint);
    frozen.insert(frozen.end(), of_joint.begin(), of_joint.end());
  }
  return frozen;
}

/// Sorted by first frame. The runs must be sorted by joint and frame.
std::vector<StillWatch::Together> StillWatch::lost_together(std::vector<Run> frozen) const {
  struct Entry {
    FrameRange steps;
    std::size_t run;
  };
  const auto comes_before = [](const Entry& a, const Entry& b) {
    return std::tuple(a.steps.begin, a.steps.end, a.run) < std::tuple(b.steps.begin, b.steps.end, b.run);
  };
  std::vector<Entry> by_steps;
  for (std::size_t i = 0; i < frozen.size(); ++i) by_steps.push_back({frozen[i].steps, i});
  std::sort(by_steps.begin(), by_steps.end(), comes_before);
  std::vector<bool> reported(frozen.size(), false);
  std::vector<Together> result;
  for (std::size_t i = 0; i < frozen.size(); ++i) {
    if (reported[i]) continue;
    const FrameRange steps = frozen[i].steps;
    Together together{
        .frames = {shown_[static_cast<std::size_t>(steps.begin)], shown_[static_cast<std::size_t>(steps.end - 1)] + 1}};
    for (std::int64_t begin = steps.begin - kAlike; begin <= steps.begin + kAlike; ++begin) {
      auto at = std::lower_bound(by_steps.begin(), by_steps.end(), Entry{{begin, steps.end - kAlike}, 0}, comes_before);
      for (; at != by_steps.end() && at->steps.begin == begin && at->steps.end <= steps.end + kAlike; ++at) {
        if (reported[at->run]) continue;
        reported[at->run] = true;
        together.joints.push_back(frozen[at->run].joint);
      }
    }
    std::sort(together.joints.begin(), together.joints.end());
    result.push_back(std::move(together));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Together& a, const Together& b) { return a.frames.begin < b.frames.begin; });
  return result;
}

std::vector<JointIndex> StillWatch::motionless_signing_joints() const {
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

Found StillWatch::found() {
  Found result;
  bool moves = false;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    end_run(static_cast<JointIndex>(i), count());
    moves = moves || joints_[i].changes > 0;
  }
  // A motion that is too short or without any movement gives no information.
  if (count() < shortest_ || !moves) return result;
  const std::vector<JointIndex> never = motionless_signing_joints();
  if (!never.empty()) {
    Defect defect{.kind = DefectKind::frozen_joint};
    defect.text = fmt::format("{} never {}: not captured, so signs lack {}", names_of(motion_.skeleton(), never, 6),
                              never.size() == 1 ? "moves" : "move", never.size() == 1 ? "it" : "them");
    result.defects.push_back(std::move(defect));
  }
  for (const auto& [frames, joints] : lost_together(frozen_runs())) {
    if (result.defects.size() == kMostDefects) {
      ++result.more;
      continue;
    }
    const double seconds = static_cast<double>(frames.size()) / motion_.rate().hertz();
    result.defects.push_back(
        {.kind = DefectKind::frozen_joint,
         .joint = joints.front(),
         .frames = frames,
         .value = static_cast<float>(seconds),
         .text = fmt::format("{} {} exactly still for {:.1f} s while the body moves: the capture lost {}",
                             names_of(motion_.skeleton(), joints), joints.size() == 1 ? "keeps" : "keep", seconds,
                             joints.size() == 1 ? "it" : "them")});
  }
  return result;
}

}  // namespace signweave::defect
