#include "signweave/motion_db/quantise.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "signweave/core/error.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion_db/bones.h"
#include "signweave/motion_db/grid.h"

// Every run of frames (grid.h) is quantised separately. A joint's step is s · w: w depends on the length of the bone
// that it turns, and s, the same for all joints, is the largest for which all points stay within the tolerance. Parents
// are quantised first, and a joint that moves aims at its original rotation in model space, so that errors do not
// accumulate along a chain. Finally single joints are made coarser if there is room.

namespace signweave::motion_db {

namespace {

/// The range of scales that are tried, in quarters of an octave.
constexpr int kFinest = -32;
constexpr int kCoarsest = 14;

/// The fraction of its own position error that a joint compensates at the other end of its bone by a rotation. Full
/// compensation would make slowly moving joints tremble.
constexpr float kCompensation = 0.7f;

/// Quaternions whose squared norm differs from 1 by more than this are not rotations and are stored raw.
constexpr float kMostOff = 1e-3f;
/// If the component to be dropped comes closer to 0, it cannot be restored accurately enough.
constexpr float kLeastDropped = 0.01f;

bool same_bits(const Eigen::Vector3f& a, const Eigen::Vector3f& b) noexcept {
  return std::memcmp(a.data(), b.data(), sizeof(float) * 3) == 0;
}
double distance(const Eigen::Vector3f& a, const Eigen::Vector3f& b) noexcept {
  return (a.cast<double>() - b.cast<double>()).norm();
}
/// True if two points are within the distance. NaN points are near if they are the same.
bool is_near(const Eigen::Vector3f& a, const Eigen::Vector3f& b, double tolerance) noexcept {
  return distance(a, b) <= tolerance || same_bits(a, b);
}
bool is_unit(const Eigen::Quaternionf& q) noexcept {
  return std::fabs(q.squaredNorm() - 1.0f) <= kMostOff;
}

/// A grid of values.
struct Grid {
  float step = 0;
  double inverse = 0;
  explicit Grid(int level) : step(step_of(level)), inverse(1.0 / static_cast<double>(step)) {}
};

/// A number's position on a grid. NaN and too large numbers have none.
struct OnGrid {
  float value = 0;
  bool ok = false;
};
OnGrid on_grid(float value, const Grid& grid) noexcept {
  const double steps = static_cast<double>(value) * grid.inverse;
  if (!(std::fabs(steps) < 2'097'151.0)) return {};
  return {static_cast<float>(std::lrint(steps)) * grid.step, true};
}

/// One run of frames being quantised.
class QuantisedRun {
 public:
  QuantisedRun(const Motion& original, const Bones& bones, double tolerance)
      : original_(original), bones_(bones), skeleton_(original.skeleton()), tolerance_(tolerance) {}

  /// Quantises the run and writes it to `result`. The search starts at `scale`, which is set to where it ended.
  void quantise(FrameRange frames, int& scale, Motion& result);

 private:
  struct JointState {
    Dropped dropped;
    float weight = 0;  ///< weight of its rotation
    int level = 0, translation_level = 0;
    bool raw = false, translation_raw = false;
    bool moves = false, translation_moves = false;
    std::array<float, 4> middle{}, range{};
    std::array<float, 3> translation_middle{}, translation_range{};
  };

  std::size_t count() const { return static_cast<std::size_t>(frames_.size()); }
  Eigen::Quaternionf rotation(std::size_t t, std::size_t joint) const {
    return original_.pose(frames_.begin + static_cast<std::int64_t>(t)).rotations[joint];
  }
  Eigen::Vector3f translation(std::size_t t, std::size_t which) const {
    return original_.pose(frames_.begin + static_cast<std::int64_t>(t)).translations[which];
  }

  void measure(std::size_t joint);
  void place(std::size_t joint);
  void place_translation(std::size_t joint, std::size_t which);
  void place_rotation(std::size_t joint);
  bool joint_is_near(std::size_t joint) const;
  bool all_near() const;
  bool try_scale(int scale);
  bool restore_failing();
  void coarsen();

  const Motion& original_;
  const Bones& bones_;
  const Skeleton& skeleton_;
  double tolerance_;
  FrameRange frames_;
  std::vector<ModelPose> wanted_;  ///< [frame]
  std::vector<ModelPose> actual_;
  std::vector<Pose> poses_;  ///< [frame], quantised
  std::vector<JointState> joints_;
};

void QuantisedRun::measure(std::size_t joint) {
  JointState& state = joints_[joint] = {};
  std::array<float, 4> low{}, high{};
  bool unit = true;
  for (std::size_t t = 0; t < count(); ++t) {
    const Eigen::Quaternionf q = rotation(t, joint);
    unit = unit && is_unit(q);
    for (std::size_t c = 0; c < 4; ++c) {
      const float value = q.coeffs()[static_cast<Eigen::Index>(c)];
      low[c] = t == 0 ? value : std::min(low[c], value);
      high[c] = t == 0 ? value : std::max(high[c], value);
    }
  }
  float best = -1;
  for (std::size_t c = 0; c < 4; ++c) {
    state.range[c] = high[c] - low[c];
    state.middle[c] = 0.5f * (high[c] + low[c]);
    const float least = low[c] > 0 ? low[c] : -high[c];  // its least absolute value, if its sign is constant
    if (least <= best) continue;
    best = least;
    state.dropped = {static_cast<int>(c), high[c] < 0};
  }
  state.raw = !unit || !(best > kLeastDropped);
  // The error of the restored component grows as it gets closer to 0.
  state.weight = bones_.rotation_weight[joint] * std::min(1.0f, 2.0f * best);
  const std::optional<std::size_t> which = skeleton_.translation_of(static_cast<JointIndex>(joint));
  if (!which) return;
  for (std::size_t c = 0; c < 3; ++c) {
    float least = 0, most = 0;
    for (std::size_t t = 0; t < count(); ++t) {
      const float value = translation(t, *which)[static_cast<Eigen::Index>(c)];
      least = t == 0 ? value : std::min(least, value);
      most = t == 0 ? value : std::max(most, value);
    }
    state.translation_range[c] = most - least;
    state.translation_middle[c] = 0.5f * (most + least);
  }
}

/// Quantises the joint's translation in every frame, or leaves it raw.
void QuantisedRun::place_translation(std::size_t joint, std::size_t which) {
  JointState& state = joints_[joint];
  const Grid grid(state.translation_level);
  const JointIndex parent = skeleton_.joints()[joint].parent;
  bool still = true;
  for (const float range : state.translation_range) still = still && range <= 0.5f * grid.step;
  state.translation_moves = !still;
  bool kept = state.translation_raw;
  for (std::size_t t = 0; t < count() && !kept; ++t) {
    Eigen::Vector3f aim(state.translation_middle.data());
    if (!still) {
      aim = translation(t, which);
      if (parent != kNoJoint) {
        const auto at = static_cast<std::size_t>(parent);
        const Eigen::Quaternionf& turn = actual_[t].rotations[at];
        if (is_unit(turn)) aim = turn.conjugate() * (wanted_[t].positions[joint] - actual_[t].positions[at]);
      }
    }
    for (Eigen::Index c = 0; c < 3; ++c) {
      const OnGrid placed = on_grid(aim[c], grid);
      kept = kept || !placed.ok;
      poses_[t].translations[which][c] = placed.value;
    }
  }
  if (!kept) return;
  for (std::size_t t = 0; t < count(); ++t) poses_[t].translations[which] = translation(t, which);
}

void QuantisedRun::place_rotation(std::size_t joint) {
  JointState& state = joints_[joint];
  const Grid grid(state.level);
  const JointIndex parent = skeleton_.joints()[joint].parent;
  bool still = true;
  for (int i = 0; i < 3; ++i) {
    still = still && state.range[static_cast<std::size_t>(kept_component(state.dropped, i))] <= 0.5f * grid.step;
  }
  state.moves = !still;
  bool kept_raw = state.raw;
  for (std::size_t t = 0; t < count() && !kept_raw; ++t) {
    Eigen::Quaternionf aim(state.middle.data());
    if (!still) {
      aim = rotation(t, joint);
      if (parent != kNoJoint && is_unit(actual_[t].rotations[static_cast<std::size_t>(parent)])) {
        Eigen::Quaternionf turned = wanted_[t].rotations[joint];
        const Eigen::Vector3f bone = turned * bones_.middle[joint];
        // If the joint itself is off, rotating it moves its children closer to their positions.
        const Eigen::Vector3f off = wanted_[t].positions[joint] - actual_[t].positions[joint];
        if (bone.squaredNorm() > 1e-6f && off.squaredNorm() < 1e-2f * bone.squaredNorm()) {
          const Eigen::Vector3f half = 0.5f * kCompensation * bone.cross(off) / bone.squaredNorm();
          turned = Eigen::Quaternionf(1.0f, half.x(), half.y(), half.z()).normalized() * turned;
        }
        const Eigen::Quaternionf corrected =
            actual_[t].rotations[static_cast<std::size_t>(parent)].conjugate() * turned;
        if (corrected.dot(aim) < 0) {
          aim.coeffs() = -corrected.coeffs();
        } else {
          aim = corrected;
        }
      }
    }
    std::array<float, 3> kept{};
    for (int i = 0; i < 3; ++i) {
      const OnGrid placed = on_grid(aim.coeffs()[kept_component(state.dropped, i)], grid);
      kept_raw = kept_raw || !placed.ok;
      kept[static_cast<std::size_t>(i)] = placed.value;
    }
    poses_[t].rotations[joint] = restored(state.dropped, kept[0], kept[1], kept[2]);
  }
  if (!kept_raw) return;
  for (std::size_t t = 0; t < count(); ++t) poses_[t].rotations[joint] = rotation(t, joint);
}

/// Quantises a joint after its parents and computes it in model space as to_model_space does.
void QuantisedRun::place(std::size_t joint) {
  const std::optional<std::size_t> which = skeleton_.translation_of(static_cast<JointIndex>(joint));
  if (which) place_translation(joint, *which);
  const Joint& it = skeleton_.joints()[joint];
  const auto parent = static_cast<std::size_t>(it.parent);
  for (std::size_t t = 0; t < count(); ++t) {
    const Eigen::Vector3f& local = which ? poses_[t].translations[*which] : it.offset;
    ModelPose& got = actual_[t];
    if (it.parent == kNoJoint) {
      got.positions[joint] = local;
    } else {
      got.positions[joint] = got.positions[parent] + got.rotations[parent] * local;
    }
  }
  place_rotation(joint);
  for (std::size_t t = 0; t < count(); ++t) {
    const Eigen::Quaternionf& local = poses_[t].rotations[joint];
    actual_[t].rotations[joint] = it.parent == kNoJoint ? local : actual_[t].rotations[parent] * local;
  }
}

/// True if a joint and its tips are within the tolerance in every frame.
bool QuantisedRun::joint_is_near(std::size_t joint) const {
  for (std::size_t t = 0; t < count(); ++t) {
    if (!is_near(actual_[t].positions[joint], wanted_[t].positions[joint], tolerance_)) return false;
    for (const std::size_t i : bones_.tips[joint]) {
      const Tip& tip = skeleton_.tips()[i];
      if (!is_near(position_of(tip, actual_[t]), position_of(tip, wanted_[t]), tolerance_)) return false;
    }
  }
  return true;
}

bool QuantisedRun::all_near() const {
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    if (!joint_is_near(joint)) return false;
  }
  return true;
}

bool QuantisedRun::try_scale(int scale) {
  const float size = static_cast<float>(tolerance_) * std::exp2(0.25f * static_cast<float>(scale));
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    joints_[joint].level = level_below(size * joints_[joint].weight);
    joints_[joint].translation_level = level_below(size * bones_.translation_weight[joint]);
    place(joint);
  }
  return all_near();
}

/// Restores the original bits of all values that move a point which is out of tolerance. False if there were none left
/// to restore.
bool QuantisedRun::restore_failing() {
  bool changed = false;
  const auto keep = [&](bool& raw) {
    changed = changed || !raw;
    raw = true;
  };
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    if (joint_is_near(joint)) continue;
    for (auto at = static_cast<JointIndex>(joint); at != kNoJoint; at = skeleton_.joint(at).parent) {
      JointState& state = joints_[static_cast<std::size_t>(at)];
      if (at != static_cast<JointIndex>(joint) || !bones_.tips[joint].empty()) keep(state.raw);
      if (skeleton_.joint(at).translated) keep(state.translation_raw);
    }
  }
  return changed;
}

/// Makes single joints coarser, in two passes from the ends of the chains inwards, as long as their descendants stay
/// within tolerance.
void QuantisedRun::coarsen() {
  for (std::size_t i = 2 * joints_.size(); i-- > 0;) {
    const std::size_t joint = i % joints_.size();
    JointState& state = joints_[joint];
    if (state.raw || !state.moves || !bones_.carries[joint]) continue;
    for (const int up : {4, 2, 1}) {
      if (state.level + up > kCoarsestLevel) continue;
      state.level += up;
      const std::vector<JointIndex>& below = bones_.below[joint];
      std::size_t placed = 0;
      bool near = true;
      while (near && placed < below.size()) {
        place(static_cast<std::size_t>(below[placed]));
        near = joint_is_near(static_cast<std::size_t>(below[placed]));
        ++placed;
      }
      if (near) break;
      state.level -= up;
      for (std::size_t k = 0; k < placed; ++k) place(static_cast<std::size_t>(below[k]));
    }
  }
}

void QuantisedRun::quantise(FrameRange frames, int& scale, Motion& result) {
  frames_ = frames;
  wanted_.resize(count());
  actual_.resize(count());
  poses_.assign(count(), Pose(skeleton_));
  joints_.resize(skeleton_.joint_count());
  for (std::size_t t = 0; t < count(); ++t) {
    to_model_space(skeleton_, original_.pose(frames.begin + static_cast<std::int64_t>(t)), wanted_[t]);
    actual_[t] = wanted_[t];
  }
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) measure(joint);

  while (!try_scale(kFinest)) {
    if (!restore_failing()) return;  // cannot happen, as the original is within tolerance; `result` has it
  }
  // Searches for the largest scale that works, around that of the previous run.
  int good = kFinest;
  int bad = kCoarsest;
  int next = std::clamp(scale, kFinest + 1, kCoarsest - 1);
  for (int stride = 2; bad - good > 1; stride *= 2) {
    if (try_scale(next)) {
      good = next;
      next = bad < kCoarsest ? (good + bad) / 2 : std::min(good + stride, bad - 1);
    } else {
      bad = next;
      next = good > kFinest ? (good + bad) / 2 : std::max(bad - stride, good + 1);
    }
    next = std::clamp(next, good + 1, std::max(good + 1, bad - 1));
  }
  try_scale(good);
  scale = good;
  coarsen();

  // Verifies the poses as a reader will see them.
  ModelPose seen;
  for (std::size_t t = 0; t < count(); ++t) {
    to_model_space(skeleton_, poses_[t].view(), seen);
    for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
      if (!is_near(seen.positions[joint], wanted_[t].positions[joint], tolerance_)) return;
    }
    for (const Tip& tip : skeleton_.tips()) {
      if (!is_near(position_of(tip, seen), position_of(tip, wanted_[t]), tolerance_)) return;
    }
  }
  for (std::size_t t = 0; t < count(); ++t) {
    const MutablePoseView pose = result.pose(frames.begin + static_cast<std::int64_t>(t));
    std::ranges::copy(poses_[t].rotations, pose.rotations.begin());
    std::ranges::copy(poses_[t].translations, pose.translations.begin());
  }
}

}  // namespace

Motion quantise(const Motion& motion, float tolerance, const std::function<void(double fraction)>& progress) {
  if (!(tolerance > 0) || !std::isfinite(tolerance)) {
    throw Error(ErrorCode::bad_input, "compact: a tolerance must be a length above 0");
  }
  Motion original = motion;
  keep_hemisphere(original);
  Motion result = original;
  const Bones bones(original.skeleton());
  QuantisedRun run(original, bones, static_cast<double>(tolerance));
  int scale = 0;
  constexpr std::int64_t kFramesBetween = 64 * kRunFrames;
  for (std::int64_t begin = 0; begin < motion.frame_count(); begin += kRunFrames) {
    if (progress && begin % kFramesBetween == 0) {
      progress(static_cast<double>(begin) / static_cast<double>(motion.frame_count()));
    }
    run.quantise({begin, std::min(begin + kRunFrames, motion.frame_count())}, scale, result);
  }
  if (progress) progress(1.0);
  keep_hemisphere(result);  // if neighbours were half a turn apart
  return result;
}

double largest_distance(const Motion& a, const Motion& b) {
  assert(a.frame_count() == b.frame_count() && a.skeleton() == b.skeleton());
  const Skeleton& skeleton = a.skeleton();
  double largest = 0;
  ModelPose left, right;
  const auto compare = [&](const Eigen::Vector3f& p, const Eigen::Vector3f& q) {
    if (same_bits(p, q)) return;
    const double off = distance(p, q);
    largest = std::isnan(off) ? std::numeric_limits<double>::infinity() : std::max(largest, off);
  };
  for (std::int64_t frame = 0; frame < a.frame_count(); ++frame) {
    to_model_space(skeleton, a.pose(frame), left);
    to_model_space(skeleton, b.pose(frame), right);
    for (std::size_t i = 0; i < left.positions.size(); ++i) compare(left.positions[i], right.positions[i]);
    for (const Tip& tip : skeleton.tips()) compare(position_of(tip, left), position_of(tip, right));
  }
  return largest;
}

}  // namespace signweave::motion_db
