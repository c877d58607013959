#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"
#include "signweave/formats/motion_file.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// "Frame 120 is at 4,010 ms of the annotation."
struct SyncPoint {
  double frame = 0;
  Seconds time{0};
};

struct ImportOptions {
  motion_file::ReadOptions motion;
  std::vector<TierNames::SignTier> sign_tiers;    ///< empty: guessed
  std::vector<std::string> phase_tiers;           ///< empty: guessed
  bool no_sign_tier = false;                      ///< no tier holds signs, and neither signs nor phases are guessed
  bool no_phase_tier = false;                     ///< no tier holds phases, and none is guessed
  std::map<std::string, PhaseKind> phase_labels;  ///< see TierNames
  std::optional<Seconds> offset;             ///< annotation time of frame 0; else from the EAF's TIME_ORIGIN; else 0
  std::vector<SyncPoint> sync;               ///< none, or two: sets origin and rate of the clock
  std::optional<Seconds> face_offset;        ///< the motion's time of a face's first row; else by the timecode; else 0
  std::optional<std::string> face_timecode;  ///< of the motion's frame 0, on the clock of the face capture
  std::optional<RigNames> rig;               ///< from a mapping file of the skeletons; none: as at an earlier import
  bool strict = false;          ///< refuse an EAF file if some of its annotations would be left out (eaf::Unsound)
  bool replace_motion = false;  ///< take a motion or face file that changed since it was imported
  /// If given, another annotation is stored only if this is the recording's annotation_fingerprint.
  std::optional<std::string> if_annotation;
};

/// Reads a table of phase labels: lines "LABEL = KIND", KIND one of preparation, stroke, retraction, hold; # comments.
/// Throws Error{bad_input} with the line, Error{io}.
std::map<std::string, PhaseKind> read_phase_labels(const std::filesystem::path& path);

}  // namespace signweave
