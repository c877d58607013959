#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "demo/animate.h"
#include "signweave/annotation/document.h"

namespace signweave::demo {

/// One synthetic recording with its ground truth.
struct SyntheticRecording {
  std::string name;
  Motion motion;
  AnnotationDocument document;  ///< tier "Gloss" and its child "Phase" (time subdivision), participant "synthetic"
  Timeline timeline;
  std::string truth;  ///< CSV with a header: gloss,phase,begin_ms,end_ms,hand,x,y,z,handshape,size; see make_recording
  std::string space;  ///< CSV of what signs are aimed at (space.h); empty for recordings without such signs
};

/// The signs of a recording at their times, and their annotation.
Timeline timeline_of(const Script& script, FrameRate rate, std::uint64_t seed);
AnnotationDocument annotation_of(const Script& script, const Timeline& timeline);

/// Generates a recording. The same script, rate and seed give the same recording. The truth has one row per phase and
/// acting hand, with the planned wrist position at the phase's end (metres, model space; the motion's own wrist is
/// within 2 cm of it), the handshape the hand has or is nearest to there, and the size of this token's movement
/// relative to the sign table. The motion's scalar tracks are those of the face (face.h).
SyntheticRecording make_recording(const Script& script, FrameRate rate, std::uint64_t seed);

/// A contact sheet (SVG) with the begin and the end of every stroke.
std::string stroke_sheet(const SyntheticRecording& recording);

}  // namespace signweave::demo
