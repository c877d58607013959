#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "demo/animate.h"
#include "signweave/annotation/document.h"

namespace signweave::demo {

/// One made recording, with everything that is known about it.
struct SyntheticRecording {
  std::string name;
  Motion motion;
  AnnotationDocument document;  ///< tier "Gloss" and its child "Phase" (time subdivision), participant "synthetic"
  Timeline timeline;
  std::string truth;  ///< CSV with a header: gloss,phase,begin_ms,end_ms,hand,x,y,z,handshape,size; see make_recording
};

/// The signs of a recording at their times, and the annotation of them.
Timeline timeline_of(const Script& script, FrameRate rate, std::uint64_t seed);
AnnotationDocument annotation_of(const Script& script, const Timeline& timeline);

/// Makes a recording. The same script, rate and seed give the same recording; the truth has one row per phase and hand
/// that acts in the sign, with the place where the plan has that wrist at the phase's end (metres, model space; the
/// motion's own wrist is within 2 cm of it), the handshape it has or is nearest to there, and the size of this token's
/// movement beside the sign table's. The motion's scalar tracks are the face's (face.h).
SyntheticRecording make_recording(const Script& script, FrameRate rate, std::uint64_t seed);

/// A contact sheet (SVG) with the begin and the end of every stroke.
std::string stroke_sheet(const SyntheticRecording& recording);

}  // namespace signweave::demo
