#pragma once

#include <string>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/calls/import_call.h"
#include "signweave/calls/listener.h"
#include "signweave/core/answer.h"
#include "signweave/rig/rig_map.h"

namespace signweave::calls {

/// Shows the motion of a file as an import with the same parameters would store it: a piece, for drawing.
struct PreviewCall {
  std::string file;
  double at = 0.5;
  double seconds = 4;
  ImportCall import;  ///< what is about annotation and face says nothing here
};

template <class Visit>
void fields(Visit& visit, PreviewCall& call) {
  visit(Field{.name = "file", .help = "the motion file", .required = true, .is_file = true}, call.file);
  visit(Field{.name = "at",
              .help =
                  "where the piece begins, as a part of the whole motion; earlier where the motion ends before it does",
              .shows_default = true,
              .range = Range{0.0, 1.0}},
        call.at);
  visit(Field{.name = "seconds", .help = "how long the piece is", .shows_default = true, .range = Range{0.1, 10.0}},
        call.seconds);
  fields(visit, call.import);
}

/// A preview has no more frames a second; those of a faster motion are left out evenly.
constexpr double kMostPreviewRate = 60;

/// A piece of a motion.
struct Preview {
  Motion motion;      ///< every `step`th frame of the piece, without tracks, at its own rate
  FrameRange frames;  ///< of the whole motion: those that the piece covers
  std::int64_t step = 1;
  std::int64_t of_frames = 0;  ///< of the whole motion
  FrameRate rate;              ///< of the whole motion
  RigMap rig;                  ///< of the whole motion
  std::vector<Notice> notices;
  Declarations declarations;
};

/// Reads the file as import_recording does, and cuts the piece out: it has at most a few hundred frames. As `inspect`,
/// it knows nothing of what an earlier import was told. Throws as the file's reader does, as `options_of` and `map_rig`
/// do, and Error{cancelled}, which progress may throw.
Preview run(const PreviewCall& call, const Listener& listener);

/// The part of the motion that it is.
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
