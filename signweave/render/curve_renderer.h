#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/motion/kinematics.h"
#include "signweave/render/junction.h"
#include "signweave/score/score.h"

/// Inside this module only.
namespace signweave {

/// Shows authored movements over rendered frames. Used by one thread.
class CurveRenderer {
 public:
  /// The curves and everything that the settings point to must outlive it.
  CurveRenderer(std::span<const AuthoredCurve> curves, const JunctionSettings& settings);

  /// The tracks that the curves set, each once.
  std::vector<std::string> tracks() const;
  /// Applies the curves in their order to output frames and their tracks, which must include those of `tracks()`. A
  /// frame's result depends on that frame only.
  void apply(OutputWindow window);

 private:
  void turn_head(const AuthoredCurve& one, OutputWindow window);

  std::span<const AuthoredCurve> curves_;
  JunctionSettings settings_;
  JointIndex head_ = kNoJoint;
  JointChains chains_;  ///< the head, the shoulders and the trunk, with their ancestors
  ModelPose pose_;
};

}  // namespace signweave
