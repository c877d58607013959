#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/render/place_correction.h"
#include "signweave/render/plan.h"
#include "signweave/score/result.h"

namespace signweave {

class CurveRenderer;
class LaneRenderer;

/// The corrected place of the hand of a clip that only the lane of an arm shows.
struct FoundPlace {
  Channel channel = Channel::left;
  ClipId clip = 0;
  PlaceCorrection correction;
};

/// Renders a plan: any frames, in any order, any number of times, always with the same bits (for clips retargeted to
/// another skeleton, up to the signs of quaternions). Used by one thread.
class Renderer {
 public:
  enum class Tracks { shown, left_out };
  /// Everything that the settings and the plan's clips point to must outlive it.
  Renderer(Plan plan, const JunctionSettings& settings, Tracks tracks = Tracks::shown);
  /// The same for the joints of some groups: others are undefined. Without tracks.
  Renderer(Plan plan, const JunctionSettings& settings, GroupSet shown);
  ~Renderer();
  Renderer(Renderer&&) noexcept;

  const Plan& plan() const noexcept { return plan_; }

  /// Renders the frames `frames`, which must lie in the plan, with their tracks; `out` then contains only these. The
  /// cost is that of these frames, with every touched transition made completely; in a long score, additionally, a few
  /// frames of every earlier junction are read once. Throws Error{corrupt}, Error{bad_input} for frames outside the
  /// plan.
  void render(FrameRange frames, Motion& out);
  /// Renders the whole body of all frames into `body`, without what lanes and curves add, and finds the places of hands
  /// of clips whose number is at least `first`, see LaneRenderer::find_places. For the creator of a score, who then
  /// calls show_over with a renderer that has them.
  std::vector<FoundPlace> find_places(ClipId first, Motion& body);
  /// The same without rendering all frames first: for a score of which little is new.
  std::vector<FoundPlace> find_places(ClipId first);
  /// Keeps hands at the places that the score of this plan has now, after find_places.
  void take_places(const Score& score);
  /// Shows what lanes and curves add over all frames of the whole body.
  void show_over(Motion& body) { show_over(OutputWindow{body}); }
  /// Renders all frames, after `fetch` has put the captured ones into `out` and returned `used`.
  void render_fetched(Motion& out, std::vector<ScalarTrack> used);

 private:
  /// The clips that contribute to some frames, and the frames needed to make them.
  struct Section {
    std::size_t first = 0;
    std::size_t last = 0;  ///< inclusive
    FrameRange frames;
  };
  Section section_with(FrameRange frames) const;
  void render_body(FrameRange frames, Motion& out);
  void show_over(OutputWindow window);
  const JointSigns& turned_in(std::size_t clip);
  void join_section(const Section& section, OutputWindow window, std::vector<ScalarTrack> used);

  Plan plan_;
  JunctionSettings settings_;
  JunctionFiller filler_;
  std::unique_ptr<LaneRenderer> lanes_;    ///< of the plan's runs; null: there are none
  std::unique_ptr<CurveRenderer> curves_;  ///< null: there are none
  std::vector<std::string> tracks_;        ///< names of the tracks of all clips and curves
  std::vector<JointSigns> turned_;         ///< [clip] as far as computed
  JunctionScratch scratch_;
  Motion window_;
};

/// Reads the captured frames of a plan's clips, unchanged, to their positions in `out`, which is resized to the plan's
/// length. Returns the previous tracks of `out`, so that their memory can be reused. Throws Error{corrupt}.
std::vector<ScalarTrack> fetch(const Plan& plan, const JunctionSettings& settings, Motion& out);

/// Renders a score from its clips, which come from clips_of or the score's creator. Fills all of `out` except notices
/// and declarations. Makes no choices. The memory of `out` is reused. Throws Error{bad_input} as plan_of,
/// Error{corrupt}.
void render(Score score, const std::vector<MotionClip>& clips, const JunctionSettings& settings, Synthesis& out);
/// The same with the renderer of the score's plan if `out.motion` already shows the whole body, see
/// Renderer::find_places.
void render_over_body(Score score, Renderer& renderer, const std::vector<MotionClip>& clips, Synthesis& out);
/// The same with the renderer of the score's plan. `fetched` is the result of `fetch` if it has already read the
/// captured frames into `out`.
void render(Score score, Renderer& renderer, const std::vector<MotionClip>& clips,
            std::optional<std::vector<ScalarTrack>> fetched, Synthesis& out);

}  // namespace signweave
