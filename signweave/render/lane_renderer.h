#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "signweave/render/junction.h"
#include "signweave/render/place_correction.h"
#include "signweave/render/plan.h"

/// Inside this module only.
namespace signweave {

class Renderer;
struct FoundPlace;

/// Shows runs of single channels over motion that was rendered for the whole body. Each run is rendered as if its clips
/// were of the whole body, and its channel's joints are taken from there. Used by one thread.
class LaneRenderer {
 public:
  /// The runs and everything that the settings point to must outlive it.
  LaneRenderer(std::span<const LaneRun> runs, const JunctionSettings& settings);
  ~LaneRenderer();

  /// Renders the whole body without runs.
  using RenderBody = std::function<void(FrameRange, Motion&)>;
  /// Replaces the joints of the runs' channels in output frames that show the whole body so far. The signs of
  /// quaternions are those of continuous lanes, whichever frames are rendered. Throws Error{corrupt}.
  void apply(OutputWindow window, const RenderBody& body);

  /// Finds the places of the hands of clips whose number is at least `first`; their runs must have no places yet. Clips
  /// whose rig has no body are left out. Throws Error{corrupt}.
  std::vector<FoundPlace> find_places(ClipId first, const RenderBody& body);

 private:
  /// The joints of a channel.
  struct Joints {
    std::vector<std::size_t> rotations;     ///< [joint]
    std::vector<std::size_t> translations;  ///< [translated joint]
  };
  struct Strand {
    const LaneRun* run = nullptr;
    std::unique_ptr<Renderer> renderer;
    std::optional<Motion> made = {};         ///< all frames of the run, once find_places needed them
    std::optional<JointSigns> turned = {};   ///< its own joints that are negated; none: not known yet
    std::optional<JointSigns> flipped = {};  ///< joints of its parent that are negated after it, until the next run
  };
  Joints joints_of(Channel channel) const;
  void apply(std::size_t strands, OutputWindow window, const RenderBody& body);
  PosesView frames_of(Strand& strand, FrameRange shown);
  void find_signs(std::size_t strand, const RenderBody& body);
  void correct(const LaneRun& run, FrameRange shown, const PosesView& source, OutputWindow window);
  bool shows_same(const LaneRun& run, std::size_t clip, Channel other) const noexcept;
  const Joints& joints(std::size_t strand) const noexcept {
    return joints_[static_cast<std::size_t>(strands_[strand].run->channel)];
  }

  JunctionSettings settings_;
  std::vector<Joints> joints_;       ///< [Channel]
  std::vector<Strand> strands_;      ///< in the order of the runs
  Motion shown_;                     ///< frames of one strand
  std::optional<ArmPlacer> placer_;  ///< none: the rig has no body
  std::vector<float> weights_;       ///< of a correction, [frame]
};

}  // namespace signweave
