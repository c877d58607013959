#pragma once

#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/calls/import_call.h"
#include "signweave/calls/listener.h"
#include "signweave/core/answer.h"
#include "signweave/rig/rig_map.h"

namespace signweave::calls {

/// Reads a piece of the motion of a file, as an import with the same parameters would store it, for drawing.
struct PreviewCall {
  std::string file;
  double at = 0.5;
  double seconds = 4;
  ImportCall import;  ///< parameters about annotation and face are ignored
};

template <class Visit>
void fields(Visit& visit, PreviewCall& call) {
  visit(Field{.name = "file", .help = "the motion file", .required = true, .is_file = true}, call.file);
  visit(
      Field{
          .name = "at",
          .help =
              "where the piece begins, as a fraction of the whole motion; earlier if the motion ends before the piece",
          .shows_default = true,
          .range = Range{0.0, 1.0}},
      call.at);
  visit(Field{.name = "seconds", .help = "how long the piece is", .shows_default = true, .range = Range{0.1, 10.0}},
        call.seconds);
  fields(visit, call.import);
}

/// The highest rate of a preview, in frames per second; a faster motion is thinned evenly.
constexpr double kMostPreviewRate = 60;

/// A piece of a motion.
struct Preview {
  Motion motion;      ///< every `step`th frame of the piece, without tracks, at its own rate
  FrameRange frames;  ///< the frames of the whole motion that the piece covers
  std::int64_t step = 1;
  std::int64_t of_frames = 0;  ///< of the whole motion
  FrameRate rate;              ///< of the whole motion
  RigMap rig;                  ///< of the whole motion
  std::vector<Notice> notices;
  Declarations declarations;
};

/// Reads the file as import_recording does, and cuts out the piece, which has at most a few hundred frames. Like
/// `inspect`, it ignores the settings of an earlier import. Throws what the file's reader, `options_of` and `map_rig`
/// throw, and Error{cancelled}, which progress may throw.
Preview run(const PreviewCall& call, const Listener& listener);

/// Which part of the motion the preview is.
template <class Visit>
void fields(Visit& visit, const Preview& preview) {
  visit.type("PreviewPiece");
  visit(AnswerField{.name = "first_frame"}, preview.frames.begin);
  visit(AnswerField{.name = "end_frame"}, preview.frames.end);
  visit(AnswerField{.name = "step"}, preview.step);
  visit(AnswerField{.name = "of_frames"}, preview.of_frames);
  visit(AnswerField{.name = "frames_per_second"}, preview.rate.hertz());
}

}  // namespace signweave::calls
