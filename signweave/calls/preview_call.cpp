#include "signweave/calls/preview_call.h"

#include <algorithm>
#include <cmath>

namespace signweave::calls {
namespace {

/// The frames of a piece, given where it begins as a fraction of the motion and its seconds: at least two, if the
/// motion has two.
FrameRange piece_of(const Motion& motion, double at, double seconds) {
  const std::int64_t all = motion.frame_count();
  const auto wanted = static_cast<std::int64_t>(std::llround(seconds * motion.rate().hertz()));
  const std::int64_t length = std::clamp(wanted, std::min<std::int64_t>(2, all), all);
  const auto begin = static_cast<std::int64_t>(at * static_cast<double>(all));
  const std::int64_t first = std::min(begin, all - length);
  return {first, first + length};
}

/// Every `step`th of the frames, at the resulting rate, without tracks.
Motion thinned(const Motion& motion, FrameRange frames, std::int64_t step) {
  const FrameRate rate = motion.rate();
  Motion thin(motion.shared_skeleton(), {rate.numerator, rate.denominator * step});
  for (std::int64_t frame = frames.begin; frame < frames.end; frame += step) thin.append(motion.pose(frame));
  return thin;
}

}  // namespace

Preview run(const PreviewCall& call, const Listener& listener) {
  const ImportOptions options = options_of(call.import);
  motion_file::ReadOptions reading = options.motion;
  reading.progress = [&](double part) { listener.advance(part); };
  motion_file::File file = motion_file::read(call.file, reading);
  const Motion& whole = file.motion;
  if (whole.frame_count() == 0) throw Error(ErrorCode::bad_input, call.file + ": has no frames to show");
  Preview preview{.motion = {},
                  .frames = piece_of(whole, call.at, call.seconds),
                  .step = std::max<std::int64_t>(1, std::llround(std::ceil(whole.rate().hertz() / kMostPreviewRate))),
                  .of_frames = whole.frame_count(),
                  .rate = whole.rate(),
                  .rig = map_rig(whole, options.rig.value_or(RigNames())),
                  .notices = std::move(file.notices),
                  .declarations = std::move(file.declarations)};
  preview.motion = thinned(whole, preview.frames, preview.step);
  return preview;
}

}  // namespace signweave::calls
