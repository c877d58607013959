#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "signweave/choose/concatenate.h"
#include "signweave/core/error.h"
#include "signweave/notation/score_json.h"
#include "signweave/render/render.h"
#include "signweave/score/test_motion.h"

using namespace signweave;

/// Any bytes are either rejected with an Error or a score, which reads back equal; the clips it names, of a motion of
/// 5,400 frames, are rendered or rejected.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ScoreSource source{
      .motion = std::make_shared<const MemorySource>(testing_motion::moving(5'400, {100, 1}, 0.3f)), .noise = nullptr};
  Score score;
  try {
    score = score_from_json({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const Error&) {
    return 0;
  }
  const std::string json = json_of(score);
  if (json_of(score_from_json(json, "written")) != json) std::abort();
  if (to_string(score).empty()) std::abort();
  if (score.frames > 20'000) return 0;
  try {
    const std::vector<MotionClip> clips = clips_of(score, [](const SourceRef&) { return source; });
    const SignerRig rig = signer_rig_of(clips.front());
    Synthesis out;
    render(score, clips,
           {.skeleton = source.motion->skeleton(),
            .rate = score.rate,
            .method = &transition_methods().front(),
            .rig = &rig},
           out);
    if (out.motion.frame_count() != score.frames) std::abort();
    const std::int64_t begin = static_cast<std::int64_t>(size * 131) % score.frames;
    const FrameRange frames{begin, std::min(score.frames, begin + 1 + static_cast<std::int64_t>(size % 50))};
    Renderer renderer(plan_of(score, clips), {.skeleton = source.motion->skeleton(),
                                              .rate = score.rate,
                                              .method = &transition_methods().front(),
                                              .rig = &rig});
    Motion part;
    renderer.render(frames, part);
    const std::size_t joints = part.skeleton().joint_count();
    const std::span<const Eigen::Quaternionf> whole =
        std::as_const(out.motion).rotations().subspan(static_cast<std::size_t>(begin) * joints);
    if (std::memcmp(part.rotations().data(), whole.data(), part.rotations().size_bytes()) != 0) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
