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

/// How far a joint's trajectory may lie from the middle: as far as observed on both sides, then a diminishing share of
/// any excess, at most the role's margin. So no joint bends beyond what was captured. (ours)
struct JointReach {
  float seen = 0;
  float margin = 0;  ///< 0: no limit

  /// The factor that limits a vector of this squared length: 1 within `seen`, with zero slope there.
  [[gnu::always_inline]] float scale(float square) const noexcept {
    const float length = std::sqrt(square);
    const float over = (length - seen) / margin;
    const float kept = seen + margin * over / std::sqrt(1 + over * over);
    return margin > 0 && length > seen ? kept / length : 1.0f;
  }
};

/// The reaches of several joints.
struct JointReaches {
  std::vector<float> seen;
  std::vector<float> margins;
};

/// Memory of methods, reused from gap to gap so that nothing is allocated once it has grown. Its size depends on the
/// joints, the frames within kContext and the spans of the model, never on the length of a gap. More than fifteen
/// members, one buffer each.
struct GapScratch {
  std::vector<Eigen::Vector3f> before;        ///< one joint's trajectory up to the left border, backwards from it
  std::vector<Eigen::Vector3f> after;         ///< and forwards from the right border
  std::vector<Eigen::Vector3f> coefficients;  ///< [term] of one joint or translation
  std::vector<std::size_t> taken;             ///< joints, the last repeated to fill its block, then translations
  std::size_t joints = 0;                     ///< how many of `taken` are joints
  std::size_t turned = 0;                     ///< the same including padding, see curve_loops::kLanes
  std::array<std::vector<float>, 2> seen;     ///< before, after: [frame from the border][x y z][taken]
  std::array<std::vector<float>, 2> offsets;  ///< before, after: [x y z][taken] offset of a border, see quieten
  std::vector<float> last;                    ///< [x y z w][taken joint], used by see_all
  std::vector<float> vectors;                 ///< [term][x y z][taken]
  std::vector<float> middles;                 ///< [x y z w][taken joint]
  std::vector<float> made;                    ///< of one frame: [x y z w][taken joint], then of one axis [translation]
  std::vector<Eigen::Quaternionf> turns;      ///< rotations of both borders
  std::vector<float> row;                     ///< [term]
  JointReaches reaches;                       ///< [taken joint]
  std::vector<double> numbers;
  std::vector<float> traits;                           ///< of the gap, see CapturedSpan::traits
  std::vector<std::pair<float, std::size_t>> nearest;  ///< distance and index of captured spans
  std::array<CoastingRotations, 4> coasting;
  ArmScratch arms;

  bool fills_block(std::size_t i) const noexcept { return i >= joints && i < turned; }
};

/// The work of a method: the joints and translations of some groups, in every frame of the gap.
struct GapJob {
  const Gap& gap;
  const TransitionModel& model;
  GroupSet groups = GroupSet::all();
  GapScratch& scratch;
};

/// The commands that offer a method.
enum class Offered : std::uint8_t {
  signing,     ///< `sign` and `evaluate`
  evaluation,  ///< a baseline: `evaluate` only
};

/// What a method needs from a corpus; without it, it falls back to another method.
enum class Needs : std::uint8_t {
  nothing,
  spans,     ///< captured spans, see SpanCollector
  teaching,  ///< what is learned from the corpus's movements, see ResidualModel
};

/// A method of filling a gap. `name` is what a user types.
struct GapMethod {
  std::string_view name;
  std::string_view description;  ///< one line
  Offered offered = Offered::signing;
  Needs needs = Needs::nothing;
  /// Fills the job's groups in `out`, [frame of the gap], and leaves the others unchanged. Frame 0 follows the left
  /// border. Quaternions stay in one hemisphere from frame to frame, starting with the left border's. Cannot fail: a
  /// joint with non-finite input gets non-finite output, and the others are filled; if memory for the scratch runs out,
  /// the program terminates. Deterministic: the same input gives the same bits.
  void (*fill)(const GapJob& job, MutablePoses out) noexcept;
};

/// Every method, the default first. To add one, write its `fill` and a row in method.cpp.
std::span<const GapMethod> gap_methods() noexcept;
const GapMethod* find_gap_method(std::string_view name) noexcept;

}  // namespace signweave
