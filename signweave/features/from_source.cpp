#include "signweave/features/from_source.h"

#include "signweave/features/smoothing.h"
#include "signweave/rig/body_shape.h"

namespace signweave {
namespace {

/// Returns a motion consisting of single frames of a source.
template <typename FrameOf>
Motion sampled(const MotionSource& source, std::int64_t count, const Pause& pause, FrameOf&& frame_of) {
  Motion motion;
  motion.reset(source.skeleton(), source.rate(), count);
  for (std::int64_t i = 0; i < count; ++i) {
    if (pause && i % 16 == 0) pause();
    const std::int64_t frame = frame_of(i);
    source.read({frame, frame + 1}, motion.poses({i, i + 1}));
  }
  return motion;
}

}  // namespace

void read_piece(const MotionSource& source, FrameRange frames, Piece& piece) {
  const FrameRange seen = Smoother(kSmoothing, source.rate(), source.frame_count()).window(frames);
  piece.motion.reset(source.skeleton(), source.rate(), seen.size());
  piece.first = seen.begin;
  source.read(seen, piece.motion.poses({0, seen.size()}));
}

SignerModel model_of(const MotionSource& source, const RigNames& names, const Pause& pause) {
  // Read the frames that map_rig and signer_body would examine: given a motion of just these, they examine all.
  const std::int64_t frames = source.frame_count();
  const std::int64_t shape = std::min(frames, kShapeFrames);
  SignerModel model;
  model.rig = map_rig(sampled(source, shape, pause, [&](std::int64_t i) { return shape_frame(i, frames); }), names);
  const std::int64_t body = std::min(frames, kBodyFrames);
  const auto body_frame = [&](std::int64_t i) { return body == 1 ? 0 : i * (frames - 1) / (body - 1); };
  model.body = signer_body(sampled(source, body, pause, body_frame), model.rig);
  return model;
}

std::vector<PointTrack> track_points(const MotionSource& source, const SignerModel& model, std::span<const Part> parts,
                                     FrameRange range, const Pause& pause) {
  std::vector<PointTrack> tracks(parts.size());
  range = clamp(range, source.frame_count());
  Piece piece;
  for_pieces(range, pause, [&](FrameRange frames) {
    read_piece(source, frames, piece);
    const FrameRange here{frames.begin - piece.first, frames.end - piece.first};
    const std::vector<PointTrack> part = track_points(piece.motion, model, parts, here);
    for (std::size_t i = 0; i < parts.size(); ++i) tracks[i].insert(tracks[i].end(), part[i].begin(), part[i].end());
  });
  return tracks;
}

}  // namespace signweave
