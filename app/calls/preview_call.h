#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/calls/import_call.h"
#include "app/calls/listener.h"
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
  std::vector<std::pair<std::string, std::string>> declarations;
};

/// Reads the file as import_recording does, and cuts the piece out: it has at most a few hundred frames. As `inspect`,
/// it knows nothing of what an earlier import was told. Throws as the file's reader does, as `options_of` and `map_rig`
/// do, and Error{cancelled}, which progress may throw.
Preview run(const PreviewCall& call, const Listener& listener);

/// Which part of the motion it is: first_frame, end_frame, step, of_frames, frames_per_second.
nlohmann::ordered_json piece_json(const Preview& preview);

}  // namespace signweave::calls
