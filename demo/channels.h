#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "demo/corpus.h"
#include "demo/plan.h"
#include "demo/script.h"

namespace signweave::demo {

// Recordings in which hands, mouth, brows, head and gaze have times of their own, beside the 44 minutes. Everything in
// them is planned to the frame, and the tiers of the annotation give the plan's times: they are the ground truth.

/// A sign of a unit, signed by one hand or both.
struct ChannelPlace {
  std::string_view gloss;
  Side hand = Side::right;         ///< for a sign of one hand
  std::string_view mouthing = {};  ///< text that is mouthed with it; none if empty
};

/// A sign of the left hand that is held while the right hand signs the places `from` to `to` (inclusive) of the unit.
struct HeldSign {
  std::string_view gloss;
  std::size_t from = 0, to = 0;
  Milliseconds earlier{0};  ///< from the end of its stroke to the begin of the stroke of place `from`
};

/// What face and head do over places of a unit.
enum class Marking { brows_raised, brows_lowered, head_shake, head_nod, gaze_left, gaze_right };

struct MarkedPlaces {
  Marking marking;
  std::size_t from = 0, to = 0;  ///< inclusive
};

/// Signs between two rests.
struct ChannelUnit {
  std::vector<ChannelPlace> places;
  std::vector<HeldSign> held = {};
  std::vector<MarkedPlaces> marked = {};
};

/// How the tiers of a recording are named, [side].
struct ChannelTiers {
  std::array<std::string, 2> glosses, phases;
  std::string preparation, stroke, hold, retraction;  ///< labels
};

struct ChannelScript {
  std::string name;
  std::vector<ChannelUnit> units;
  ChannelTiers tiers;
};

/// Two hands: signs of all classes, contacts, and held weak hands. Tiers `Glose MD`, `Glose MG`.
ChannelScript mains();
/// Face and head: mouthed words, questions, negation, gaze. Tiers `GlossR`, `GlossL`.
ChannelScript visage();

/// A sign of these recordings: a row of sign_table() or one of their own, with a face that does nothing by itself. A
/// sign of one hand as signed by that side. The reference stays valid. Throws Error{not_found}.
const SignShape& channel_sign(std::string_view gloss, Side hand = Side::right);
/// The rows that sign_table() lacks.
std::span<const SignShape> channel_sign_table();

/// What a sign touches, if it does.
struct SignTouch {
  std::string_view gloss;
  bool at_end = false;  ///< of its stroke; else at its begin
  int finger = 1;
  HandPlan::Touchable what = HandPlan::Touchable::chin;
  int other_finger = 1;
};
std::span<const SignTouch> channel_touches();

/// A sign at its time on one hand. The phases are contiguous: `placed` gives the frames of all but the hold, which is
/// [placed.stroke_end, hold_end); the retraction begins at `hold_end`.
struct LaneSign {
  PlacedSign placed;
  std::int64_t hold_end = 0;
};

/// A label over frames of a tier.
struct MarkedFrames {
  std::string label;
  std::int64_t begin = 0, end = 0;
};

/// Everything at its time. Signs of both hands are on both lanes.
struct ChannelTimeline {
  FrameRate rate;
  std::array<std::vector<LaneSign>, 2> lanes;  ///< [side], in order
  std::vector<MarkedFrames> mouthings, brows, heads, gazes, blinks, contacts;
  std::vector<HandPlan::Touch> touches;
  std::vector<std::array<std::int64_t, 2>> units;  ///< begin and end of each
  std::int64_t frames = 0;
};

/// Throws as `schedule` does.
ChannelTimeline schedule_channels(const ChannelScript& script, FrameRate rate, Random& random);

/// The plan of both hands; borrows the timeline. `unrest` scales the movement of a hand that is held.
HandPlan plan_of(const ChannelTimeline& timeline, Random& random, float unrest = 1);

/// The signs of the right hand, which the body follows. Borrows nothing.
Timeline dominant_timeline(const ChannelTimeline& timeline);

/// The face: brows, mouth and lids. Outside the marked frames the brows and the mouth hardly move.
FaceMotion face_of(const ChannelTimeline& timeline, Random& random);

/// Turns head and eyes as the timeline says.
void turn_heads(const ChannelTimeline& timeline, std::vector<BodyFrame>& body);

/// A recording of that script. `timeline` is the dominant hand's. The face's tracks include the directions of the eyes
/// (eyeLookInLeft, …). The truth is that of make_recording, right hand first, except that a hand
/// that touches something is some centimetres from the planned wrist. `unrest` as in `plan_of`.
SyntheticRecording make_channels(const ChannelScript& script, FrameRate rate, std::uint64_t seed, float unrest = 1);

}  // namespace signweave::demo
