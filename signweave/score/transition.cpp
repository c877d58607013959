#include "signweave/score/transition.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace signweave {
namespace {

/// Context of a tenth of a second on either side: long enough to distinguish a velocity from noise.
std::int64_t context_frames(double frames_per_second) noexcept {
  return std::max<std::int64_t>(1, std::llround(0.1 * frames_per_second));
}

/// Keeps `total` frames of both sides together, in proportion to the captured frames; fewer if fewer were captured.
void keep(const TransitionRoom& room, std::int64_t total, TransitionCut& cut) noexcept {
  const std::int64_t both = room.retraction + room.preparation;
  if (both <= total) {
    cut.retraction_frames = room.retraction;
    cut.preparation_frames = room.preparation;
    return;
  }
  const double share = static_cast<double>(room.retraction) / static_cast<double>(both);
  cut.retraction_frames =
      std::clamp<std::int64_t>(std::llround(static_cast<double>(total) * share),
                               std::max<std::int64_t>(0, total - room.preparation), std::min(room.retraction, total));
  cut.preparation_frames = total - cut.retraction_frames;
}

/// A third of the transition, for changing from one pose to another. If it is much shorter, the hands jump.
std::int64_t third(const TransitionRoom& room) noexcept {
  return (room.length + 2) / 3;
}

}  // namespace

TransitionCut cut_with_gap(const TransitionRoom& room) noexcept {
  TransitionCut cut{.length = room.length, .blend_frames = context_frames(room.frames_per_second)};
  keep(room, room.length - third(room), cut);
  return cut;
}

namespace {

/// Reading "overlap": the p frames of each side are cross-faded, length = m_i + m_j − p, with p a third of the length.
/// If there are too few captured frames, or there is a pause, the middle third is generated as a gap.
TransitionCut cut_for_overlap(const TransitionRoom& room) {
  const std::int64_t faded = third(room);
  const std::int64_t total = room.length + faded;
  if (room.pause || room.retraction < faded || room.preparation < faded || room.retraction + room.preparation < total) {
    return cut_with_gap(room);
  }
  TransitionCut cut{.length = room.length, .blend_frames = faded};
  keep(room, total, cut);
  // Each side has to cover the whole cross-fade, and at most the transition.
  cut.retraction_frames = std::clamp(cut.retraction_frames, faded, room.length);
  cut.preparation_frames = total - cut.retraction_frames;
  return cut;
}

/// Reading "gap": at most a quarter of the transition is kept on each side, the rest is generated; p frames of context
/// give position and velocity at each border.
TransitionCut cut_for_gap(const TransitionRoom& room) {
  if (room.pause) return cut_with_gap(room);
  TransitionCut cut{.length = room.length, .blend_frames = context_frames(room.frames_per_second)};
  cut.retraction_frames = std::min(room.retraction, room.length / 4);
  cut.preparation_frames = std::min(room.preparation, room.length / 4);
  return cut;
}

/// The methods offered to users: the paper's readings, then all gap methods.
std::vector<TransitionMethod> make_table() {
  const GapMethod* const coasting = find_gap_method("gap");
  std::vector<TransitionMethod> table;
  for (const GapMethod& method : gap_methods()) {
    if (method.offered == Offered::signing && &method != coasting) {
      table.push_back({method.name, method.description, nullptr, &method});
    }
  }
  const TransitionMethod overlap{
      "overlap", "cross-fades the end of one retraction with the begin of the next preparation (the paper)",
      cut_for_overlap, coasting};
  const TransitionMethod gap{"gap", "generates the middle from pose and velocity at both borders (the paper)",
                             cut_for_gap, coasting};
  // The default is first.
  table.insert(table.begin() + (table.empty() ? 0 : 1), {overlap, gap});
  return table;
}

}  // namespace

std::string_view name_of(Timed part) noexcept {
  switch (part) {
    case Timed::body:
      return "body";
    case Timed::left:
      return "left";
    case Timed::right:
      return "right";
  }
  return "body";
}

GroupSet groups_of(Timed part) noexcept {
  if (part == Timed::left) return {JointGroup::left_arm, JointGroup::left_fingers};
  if (part == Timed::right) return {JointGroup::right_arm, JointGroup::right_fingers};
  return {JointGroup::body};
}

Timed timed_of(JointGroup group) noexcept {
  if (groups_of(Timed::left).has(group)) return Timed::left;
  return groups_of(Timed::right).has(group) ? Timed::right : Timed::body;
}

TransitionCut common_to(const TransitionCuts& cuts) noexcept {
  TransitionCut common = cuts.front();
  for (const TransitionCut& cut : cuts) {
    if (cut == cuts.front()) continue;
    // Parts with different cuts never cross-fade.
    common.retraction_frames = std::min(common.kept_after(), cut.kept_after());
    common.preparation_frames = std::min(common.kept_before(), cut.kept_before());
    common.waits = common.waits && cut.waits;
  }
  return common;
}

std::span<const TransitionMethod> transition_methods() {
  static const std::vector<TransitionMethod> table = make_table();
  return table;
}

const TransitionMethod* find_transition_method(std::string_view name) {
  for (const TransitionMethod& method : transition_methods()) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

float crossfade_weight(std::int64_t index, std::int64_t count) noexcept {
  const float t = static_cast<float>(index + 1) / static_cast<float>(count + 1);
  return t * t * (3.0f - 2.0f * t);
}

void go_over(float from, float to, std::span<float> values) noexcept {
  const auto count = static_cast<std::int64_t>(values.size());
  for (std::int64_t k = 0; k < count; ++k) {
    values[static_cast<std::size_t>(k)] = from + crossfade_weight(k, count) * (to - from);
  }
}

}  // namespace signweave
