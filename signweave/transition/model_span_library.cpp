#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "signweave/transition/fill.h"
#include "signweave/transition/learned.h"
#include "signweave/transition/model.h"

namespace signweave {
namespace {

/// Deviations of one joint of a captured span from the kriged trajectory, per frame; they are zero at the borders.
class Strays {
 public:
  Strays(const Gap& gap, PosesView captured, const Motion& kriged)
      : gap_(gap), captured_(captured), kriged_(kriged), frames_(static_cast<std::size_t>(gap.count) + 2) {
    frames_.front() = frames_.back() = Eigen::Vector3f::Zero();
  }
  /// At kPoints equal steps.
  void append(std::size_t joint, std::vector<Eigen::Vector3f>& out) {
    const Eigen::Quaternionf back = middle_of(gap_.left().rotations[joint], gap_.right().rotations[joint]).conjugate();
    for (std::int64_t frame = 0; frame < gap_.count; ++frame) {
      const Eigen::Quaternionf made = kriged_.pose(frame).rotations[joint];
      // With the quaternion's sign of the trajectory that it is added to: otherwise a rotation half a turn from the
      // middle would deviate by a whole turn.
      Eigen::Quaternionf real = captured_.pose(frame).rotations[joint];
      if (real.dot(made) < 0) real.coeffs() *= -1.0f;
      frames_[static_cast<std::size_t>(frame) + 1] = rotation_vector(back * real) - rotation_vector(back * made);
    }
    for (std::size_t point = 0; point < CapturedSpan::kPoints; ++point) {
      const double at = static_cast<double>((point + 1) * (frames_.size() - 1)) / (CapturedSpan::kPoints + 1);
      const auto before = static_cast<std::size_t>(at);
      const auto part = static_cast<float>(at - static_cast<double>(before));
      out.push_back(frames_[before] + part * (frames_[before + 1] - frames_[before]));
    }
  }

 private:
  const Gap& gap_;
  PosesView captured_;
  const Motion& kriged_;
  std::vector<Eigen::Vector3f> frames_;
};

}  // namespace

bool is_of(const SpanLibrary& library, const Skeleton& skeleton) noexcept {
  return std::ranges::equal(library.joints, skeleton.joints(),
                            [](const Joint& a, const Joint& b) { return a.parent == b.parent && a.name == b.name; });
}

void describe_span(const Gap& gap, GapScratch& scratch, std::vector<float>& traits) {
  const std::size_t joints = gap.before.joints();
  traits.assign(joints * CapturedSpan::kTraitsOfJoint, 0.0f);
  Sides sides;
  sides.hertz = gap.rate.hertz();
  sides.seconds = GapTime(gap).seconds();
  for (std::size_t joint = 0; joint < joints; ++joint) {
    see_joint(gap, joint, scratch);
    sides.before = scratch.before;
    sides.after = scratch.after;
    const auto seen = traits_of(sides);
    float* out = traits.data() + joint * CapturedSpan::kTraitsOfJoint;
    for (std::size_t trait = 0; trait < kTraits; ++trait) {
      const float weight = trait == 0 ? 1.0f : 0.5f;
      for (int axis = 0; axis < 3; ++axis) *out++ = weight * seen[trait][axis];
    }
  }
}

bool keep_span(std::size_t recording, const Gap& gap, PosesView captured, GapScratch& scratch,
               std::vector<std::shared_ptr<SpanLibrary>>& libraries) {
  assert(captured.frames == gap.count);
  auto library = std::ranges::find_if(libraries, [&](const auto& one) { return is_of(*one, *gap.skeleton); });
  if (library != libraries.end() && (*library)->spans.size() >= kMostSpans) return false;
  Motion kriged;
  // Only the skeleton's counts are used here, and no reference to it is stored.
  kriged.reset(std::shared_ptr<const Skeleton>(std::shared_ptr<const Skeleton>(), gap.skeleton), gap.rate, gap.count);
  // Without spans this is the kriged trajectory without limits, to which deviations are added.
  static const TransitionModel kNoSpans;
  fill_recorded({.gap = gap, .model = kNoSpans, .scratch = scratch}, kriged.poses({0, gap.count}));
  CapturedSpan span;
  span.recording = recording;
  span.seconds = static_cast<float>(gap.duration().count());
  describe_span(gap, scratch, span.traits);
  const std::size_t joints = captured.joints();
  span.strays.reserve(joints * CapturedSpan::kPoints);
  Strays strays(gap, captured, kriged);
  for (std::size_t joint = 0; joint < joints; ++joint) strays.append(joint, span.strays);
  const bool sound = std::ranges::all_of(span.traits, [](float value) { return std::isfinite(value); }) &&
                     std::ranges::all_of(span.strays, [](const Eigen::Vector3f& stray) { return stray.allFinite(); });
  if (!sound) return false;
  if (library == libraries.end()) {
    libraries.push_back(std::make_shared<SpanLibrary>());
    library = std::prev(libraries.end());
    (*library)->joints.assign(gap.skeleton->joints().begin(), gap.skeleton->joints().end());
  }
  (*library)->spans.push_back(std::move(span));
  return true;
}

struct SpanCollector::State {
  std::vector<std::shared_ptr<SpanLibrary>> libraries;
  std::shared_ptr<const ResidualModel> residuals;
  GapScratch scratch;
};

SpanCollector::SpanCollector() : state_(std::make_unique<State>()) {}
SpanCollector::~SpanCollector() = default;

bool SpanCollector::add(const Gap& gap, PosesView captured) {
  return keep_span(0, gap, captured, state_->scratch, state_->libraries);
}

void SpanCollector::set_residuals(std::shared_ptr<const ResidualModel> residuals) {
  state_->residuals = std::move(residuals);
}

std::shared_ptr<const TransitionModel> SpanCollector::take_model() {
  auto model = std::make_shared<TransitionModel>(default_transition_model());
  model->libraries.assign(state_->libraries.begin(), state_->libraries.end());
  state_->libraries.clear();
  model->residuals = state_->residuals;
  return model;
}

}  // namespace signweave
