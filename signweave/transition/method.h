#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/motion/blend.h"
#include "signweave/transition/gap.h"
#include "signweave/transition/model.h"
#include "signweave/transition/residual.h"

namespace signweave {

/// How far a joint's way may lie from the middle: as far as it is seen on both sides, and then ever less of what more
/// is asked for, at most the role's margin. So no joint bends where nobody saw it bend. (ours)
struct JointReach {
  float seen = 0;
  float margin = 0;  ///< 0: no limit

  /// What a vector is to be taken times, by its squared length: 1 within `seen`, and level there.
  [[gnu::always_inline]] float scale(float square) const noexcept {
    const float length = std::sqrt(square);
    const float over = (length - seen) / margin;
    const float kept = seen + margin * over / std::sqrt(1 + over * over);
    return margin > 0 && length > seen ? kept / length : 1.0f;
  }
};

/// Those of some joints.
struct JointReaches {
  std::vector<float> seen;
  std::vector<float> margins;
};

/// Memory that methods use; kept from gap to gap, so that nothing is allocated once it has grown. How far it grows
/// depends on the joints, the frames within kContext and the spans of the model, never on how long a gap is.
/// More than fifteen members: a buffer each.
struct GapScratch {
  std::vector<Eigen::Vector3f> before;        ///< one joint's way up to the left border, backwards from it
  std::vector<Eigen::Vector3f> after;         ///< and from the right border on
  std::vector<Eigen::Vector3f> coefficients;  ///< [term] of one joint or translation
  std::vector<std::size_t> taken;  ///< joints, the last of them as often as fills their blocks, then translations
  std::size_t joints = 0;          ///< how many of them are joints
  std::size_t turned = 0;          ///< and how many with those that only fill blocks: see curve_loops::kLanes
  std::array<std::vector<float>, 2> seen;     ///< before, after: [frame from the border][x y z][taken]
  std::array<std::vector<float>, 2> offsets;  ///< before, after: [x y z][taken] how far a border is off, see quieten
  std::vector<float> last;                    ///< [x y z w][taken joint], while they are seen
  std::vector<float> ways;                    ///< [term][x y z][taken]
  std::vector<float> middles;                 ///< [x y z w][taken joint]
  std::vector<float> made;                    ///< of one frame: [x y z w][taken joint], then of one axis [translation]
  std::vector<Eigen::Quaternionf> turns;      ///< what `gap` has of both borders
  std::vector<float> row;                     ///< [term]
  JointReaches reaches;                       ///< [taken joint]
  std::vector<double> numbers;
  std::vector<float> traits;                           ///< of the gap, as captured spans have them
  std::vector<std::pair<float, std::size_t>> nearest;  ///< distance and index of captured spans
  std::array<CoastingRotations, 4> coasting;
  ArmScratch arms;

  bool fills_block(std::size_t i) const noexcept { return i >= joints && i < turned; }
};

/// What a method fills: the joints and translations of some groups, in every frame of the gap.
struct GapJob {
  const Gap& gap;
  const TransitionModel& model;
  GroupSet groups = GroupSet::all();
  GapScratch& scratch;
};

/// Who offers a method.
enum class Offered : std::uint8_t {
  signing,     ///< `sign` and `evaluate`
  evaluation,  ///< a baseline: `evaluate` alone
};

/// What of a corpus a method goes by; without it, it does nothing of its own.
enum class Needs : std::uint8_t {
  nothing,
  spans,     ///< captured ones: see SpanCollector
  teaching,  ///< what the corpus teaches of movements: see ResidualModel
};

/// One way to fill a gap. `name` is what a user types.
struct GapMethod {
  std::string_view name;
  std::string_view description;  ///< one line
  Offered offered = Offered::signing;
  Needs needs = Needs::nothing;
  /// Fills the job's groups in `out`, [frame of the gap], and leaves the others as they are. Frame 0 is the one after
  /// the left border. Quaternions keep one hemisphere from frame to frame, beginning with the left border's. Cannot
  /// fail: a joint whose numbers are not finite gets such, and the others are filled; where there is no memory left for
  /// the scratch, the program ends. The same input gives the same bits.
  void (*fill)(const GapJob& job, MutablePoses out) noexcept;
};

/// Every method, the default first. To add one, write its `fill` and a row in method.cpp.
std::span<const GapMethod> gap_methods() noexcept;
const GapMethod* find_gap_method(std::string_view name) noexcept;

}  // namespace signweave
