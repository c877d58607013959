#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "signweave/render/plan.h"
#include "signweave/score/result.h"

namespace signweave {

/// Renders a plan: any frames of it, in any order, any number of times, always with the same bits; of clips whose
/// motion is put onto another skeleton up to the signs of quaternions. Belongs to one thread.
class Renderer {
 public:
  /// What the settings and the plan's clips point to must outlive it.
  Renderer(Plan plan, const JunctionSettings& settings);

  const Plan& plan() const noexcept { return plan_; }

  /// Makes the frames `frames`, which must lie in the plan, with their tracks; `out` then has these alone. Costs what
  /// they cost, and a transition of which any frame is asked for its whole: nothing more in a long score but, once, a
  /// few frames of every junction before them. Throws Error{corrupt}, Error{bad_input} for frames that are not in the
  /// plan.
  void render(FrameRange frames, Motion& out);
  /// The same of all frames, where `fetch` put those that were captured into `out` and gave back `used`.
  void render_fetched(Motion& out, std::vector<ScalarTrack> used);

 private:
  /// Clips of the plan that make some frames, and the frames that they are made with.
  struct Part {
    std::size_t first = 0;
    std::size_t last = 0;  ///< inclusive
    FrameRange frames;
  };
  Part part_with(FrameRange frames) const;
  const JointSigns& turned_in(std::size_t clip);
  void join_part(const Part& part, OutputWindow window, std::vector<ScalarTrack> used);

  Plan plan_;
  JunctionSettings settings_;
  JunctionFiller filler_;
  std::vector<std::string> tracks_;  ///< names: those that any of its clips has
  std::vector<JointSigns> turned_;   ///< [clip] as far as it was asked for
  JunctionScratch scratch_;
  Motion window_;
};

/// Puts the captured frames of a plan's clips where they lie, as they were captured, into `out`, which becomes as
/// long as the plan says. Returns the tracks that it had, for their memory. Throws Error{corrupt}.
std::vector<ScalarTrack> fetch(const Plan& plan, const JunctionSettings& settings, Motion& out);

/// Makes what a score says of its clips, which clips_of or the score's maker has: all of `out` but its
/// notices and declarations. Decides nothing. The memory of what `out` was is used again. Throws Error{bad_input} as
/// plan_of, Error{corrupt}.
void render(Score score, const std::vector<MotionClip>& clips, const JunctionSettings& settings, Synthesis& out);
/// The same by the renderer of the score's plan; `fetched`: what `fetch` gave back, where it has put the captured
/// frames into `out` already.
void render(Score score, Renderer& renderer, const std::vector<MotionClip>& clips,
            std::optional<std::vector<ScalarTrack>> fetched, Synthesis& out);

}  // namespace signweave
