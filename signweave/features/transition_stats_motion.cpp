#include <algorithm>

#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

using Phases = std::span<const PhaseFeatures>;

/// A path along consecutive phases: between the end of one and the begin of the next it is straight.
class PhasePath {
 public:
  PhasePath(std::size_t side, float shoulder_width) : side_(side), shoulder_width_(shoulder_width) {}

  /// Starts at a position, or continues to it in a straight line.
  void go_to(const PhaseFeatures& phase, HandAt HandOver::*at) {
    const HandOver& hand = hand_of(phase);
    const Eigen::Vector3f& place = (hand.*at).position;
    if (begun_) path_ += (place - last_).norm() * shoulder_width_;
    if (!begun_) first_ = place;
    begun_ = true;
    last_ = place;
  }
  /// Follows a whole phase.
  void go_through(const PhaseFeatures& phase) {
    go_to(phase, &HandOver::begin);
    path_ += hand_of(phase).path_length;
    last_ = hand_of(phase).end.position;
  }
  HandTravel travel() const {
    if (!known_ || !begun_) return {};
    return {.known = true,
            .displacement = static_cast<double>((last_ - first_).norm() * shoulder_width_),
            .path = static_cast<double>(path_)};
  }

 private:
  const HandOver& hand_of(const PhaseFeatures& phase) {
    known_ = known_ && phase.hands[side_].known;
    return phase.hands[side_];
  }

  std::size_t side_;
  float shoulder_width_;
  bool begun_ = false;
  bool known_ = true;
  Eigen::Vector3f first_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f last_ = Eigen::Vector3f::Zero();
  float path_ = 0;
};

bool is_stroke(const Phase& phase) {
  return phase.kind == PhaseKind::stroke;
}

}  // namespace

std::optional<TransitionMotion> motion_between(const Sign& from, Phases from_phases, const Sign& to, Phases to_phases,
                                               float shoulder_width) {
  const auto last = std::ranges::find_if(from.phases.rbegin(), from.phases.rend(), is_stroke);
  const auto first = std::ranges::find_if(to.phases, is_stroke);
  if (from.inferred || to.inferred || last == from.phases.rend() || first == to.phases.end()) return std::nullopt;
  if (from_phases.size() != from.phases.size() || to_phases.size() != to.phases.size()) return std::nullopt;
  const PhaseFeatures& left = from_phases[static_cast<std::size_t>(from.phases.rend() - last) - 1];
  const PhaseFeatures& reached = to_phases[static_cast<std::size_t>(first - to.phases.begin())];
  const Phases after = from_phases.last(static_cast<std::size_t>(last - from.phases.rbegin()));
  const Phases before = to_phases.first(static_cast<std::size_t>(first - to.phases.begin()));
  TransitionMotion motion;
  for (std::size_t side = 0; side < 2; ++side) {
    PhasePath retraction(side, shoulder_width);
    PhasePath preparation(side, shoulder_width);
    PhasePath whole(side, shoulder_width);
    retraction.go_to(left, &HandOver::end);
    whole.go_to(left, &HandOver::end);
    for (const PhaseFeatures& phase : after) {
      retraction.go_through(phase);
      whole.go_through(phase);
    }
    for (const PhaseFeatures& phase : before) {
      preparation.go_through(phase);
      whole.go_through(phase);
    }
    preparation.go_to(reached, &HandOver::begin);
    whole.go_to(reached, &HandOver::begin);
    motion.retraction[side] = retraction.travel();
    motion.preparation[side] = preparation.travel();
    motion.whole[side] = whole.travel();
  }
  const auto none = [](const HandTravel& travel) { return !travel.known; };
  if (std::ranges::all_of(motion.whole, none)) return std::nullopt;
  return motion;
}

}  // namespace signweave
