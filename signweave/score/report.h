#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/answer.h"
#include "signweave/score/result.h"

namespace signweave {

/// A phase of a sign in the result.
struct ReportPhase {
  std::string_view kind;
  TimeSpan span{};
};
template <class Visit>
void fields(Visit& visit, const ReportPhase& phase) {
  visit.type("ReportPhase");
  visit(AnswerField{.name = "kind"}, phase.kind);
  span_fields(visit, phase.span);
}

/// A sign in the result.
struct ReportSign {
  std::string gloss;
  std::size_t place = 0;
  std::size_t clip = 0;
  Channel channel = Channel::body;
  std::string recording;
  TimeSpan span{};      ///< in the new motion
  TimeSpan recorded{};  ///< in its recording
  std::vector<ReportPhase> phases;
};
inline AnswerField place_field() {
  return {.name = "place",
          .help = "the first place of the utterance that it is of, counted from 0; of a junction the one after it",
          .minimum = 0};
}
inline auto channel_value(Channel channel) {
  return given_if(channel != Channel::body, name_of(channel));
}
inline AnswerField channel_field() {
  return {.name = "channel",
          .help = "the channel that it is of alone; missing: the whole body",
          .one_of = {"left", "right", "left_fingers", "right_fingers", "head"}};
}
inline AnswerField clip_field(std::string_view name) {
  return {.name = name, .help = "the id of a clip of the score", .minimum = 0};
}
template <class Visit>
void fields(Visit& visit, const ReportSign& sign) {
  visit.type("ReportSign");
  visit(AnswerField{.name = "gloss"}, sign.gloss);
  visit(place_field(), sign.place);
  visit(clip_field("clip"), sign.clip);
  visit(channel_field(), channel_value(sign.channel));
  visit(AnswerField{.name = "recording"}, sign.recording);
  span_fields(visit, sign.span);
  visit(AnswerField{.name = "recorded", .help = "in its recording"}, sign.recorded);
  visit(AnswerField{.name = "phases"}, sign.phases);
}

/// The members that a change has in reports and in scores.
template <class Visit>
void change_fields(Visit& visit, const ClipChange& change) {
  visit(AnswerField{.name = "asked", .help = "as in an utterance: to @left"}, change.asked);
  visit(AnswerField{.name = "basis",
                    .help =
                        "asked: given by numbers; captured: a token's own; learned: from the gloss' tokens; geometric: "
                        "from one token",
                    .one_of = {"asked", "captured", "learned", "geometric"}},
        name_of(change.basis));
  visit(AnswerField{.name = "because"}, given_if(!change.because.empty(), std::string_view(change.because)));
  visit(AnswerField{.name = "moved_mm", .help = "the largest displacement of a palm"}, change.moved_mm);
  visit(AnswerField{.name = "turned_degrees", .help = "the largest turn of a hand"}, change.turned_degrees);
  visit(AnswerField{.name = "share", .help = "of what was asked for that is reached, from 0 to 1"}, change.share);
  visit(AnswerField{.name = "limit", .help = "why not all of it"},
        given_if(!change.limit.empty(), std::string_view(change.limit)));
  visit(AnswerField{.name = "missed_mm", .help = "from where the stroke should end"}, change.missed_mm);
  visit(AnswerField{.name = "aim_degrees", .help = "of a pointing sign: from the direction to its locus"},
        change.aim_degrees);
}

/// A change of a clip's stroke in space.
template <class Visit>
void fields(Visit& visit, const ClipChange& change) {
  visit.type("ReportChange");
  change_fields(visit, change);
}

/// A clip: signs of one recording as they were captured. Frames are those of the new motion.
struct ReportClip {
  std::size_t clip = 0;
  std::size_t place = 0;
  ShownClip shown;
  bool mirrored = false;  ///< left and right are exchanged
  bool at_rest = false;   ///< a hand that rests
  std::vector<ClipChange> changes = {};
};
template <class Visit>
void fields(Visit& visit, const ReportClip& one) {
  visit.type("ReportClip");
  visit(clip_field("clip"), one.clip);
  visit(place_field(), one.place);
  visit(channel_field(), channel_value(one.shown.channel));
  visit(AnswerField{.name = "recording"}, one.shown.recording);
  visit(AnswerField{.name = "frames"}, one.shown.output);
  visit(AnswerField{.name = "kept_frames"}, one.shown.core);
  visit(AnswerField{.name = "kept_from_recorded_frame"}, one.shown.first_frame);
  visit(AnswerField{.name = "recorded_frames_per_frame"}, one.shown.step);
  visit(AnswerField{.name = "mirrored", .help = "left and right are exchanged; not if missing"},
        given_if(one.mirrored, true));
  visit(AnswerField{.name = "at_rest", .help = "a hand that rests; not if missing"}, given_if(one.at_rest, true));
  visit(AnswerField{.name = "changes", .help = "of its strokes in space; missing: as captured"},
        given_if(!one.changes.empty(), one.changes));
}

/// How a part of the body is cut at a junction.
template <class Visit>
void fields(Visit& visit, const TransitionCut& cut) {
  visit.type("ReportCut");
  visit(AnswerField{.name = "retraction_frames"}, cut.retraction_frames);
  visit(AnswerField{.name = "preparation_frames"}, cut.preparation_frames);
  visit(AnswerField{.name = "waits"}, cut.waits);
}
struct ReportCuts {
  TransitionCuts cuts;  ///< [Timed]
};
template <class Visit>
void fields(Visit& visit, const ReportCuts& parts) {
  for (const Timed part : kAllTimed) {
    visit(AnswerField{.name = name_of(part)}, parts.cuts[static_cast<std::size_t>(part)]);
  }
}

template <class Visit>
void fields(Visit& visit, const JunctionChoice& chosen) {
  visit.type("ChosenJunction");
  visit(AnswerField{.name = "method"},
        given_if(chosen.method != nullptr, chosen.method == nullptr ? std::string_view() : chosen.method->name));
  visit(AnswerField{.name = "duration_ms"},
        given_if(chosen.duration.has_value(), chosen.duration.value_or(Milliseconds(0)).count()));
  visit(AnswerField{.name = "tempo"}, chosen.tempo);
}

/// A junction between two clips.
struct ReportJunction {
  std::size_t place = 0;
  std::size_t from_clip = 0;
  Junction junction;
};
template <class Visit>
void fields(Visit& visit, const ReportJunction& one) {
  const Junction& junction = one.junction;
  visit.type("ReportJunction");
  visit(AnswerField{.name = "number", .help = "by which `junctions` names it", .minimum = 1}, junction.number);
  visit(place_field(), one.place);
  visit(clip_field("from_clip"), one.from_clip);
  visit(clip_field("to_clip"), one.from_clip + 1);
  visit(AnswerField{.name = "from"}, junction.from);
  visit(AnswerField{.name = "to"}, junction.to);
  visit(AnswerField{.name = "method"}, junction.method);
  visit(AnswerField{.name = "frames"}, junction.frames);
  visit(AnswerField{.name = "retraction_frames"}, junction.cut.retraction_frames);
  visit(AnswerField{.name = "preparation_frames"}, junction.cut.preparation_frames);
  visit(AnswerField{.name = "blend_frames"}, junction.cut.blend_frames);
  visit(AnswerField{.name = "parts", .help = "how each part of the body is cut"}, ReportCuts{junction.cuts});
  visit(AnswerField{.name = "chosen", .help = "what `junctions` says of it"},
        given_if(!junction.chosen.empty(), junction.chosen));
}

/// A clip, a transition or a hold in a lane. Frames are those of the new motion.
struct ReportLaneItem {
  enum class Kind : std::uint8_t { clip, transition, hold };
  Kind kind = Kind::clip;
  FrameRange frames;
  std::size_t clip = 0;           ///< that is shown or held; of a transition the one before it
  std::size_t to_clip = 0;        ///< of a transition
  std::string method;             ///< of a transition
  std::optional<HandPlace> hand;  ///< of a clip in the lane of an arm, if its hand keeps its place
};
template <class Visit>
void fields(Visit& visit, const ReportLaneItem& item) {
  const bool joins = item.kind == ReportLaneItem::Kind::transition;
  const HandPlace hand = item.hand.value_or(HandPlace{});
  constexpr std::array<std::string_view, 3> kKinds = {"clip", "transition", "hold"};
  visit.type("ReportLaneItem");
  visit(AnswerField{.name = "kind", .one_of = {kKinds.begin(), kKinds.end()}},
        kKinds.at(static_cast<std::size_t>(item.kind)));
  visit(AnswerField{.name = "frames"}, item.frames);
  visit(AnswerField{.name = "clip", .help = "of a clip, and of a hold: the one whose pose is held", .minimum = 0},
        given_if(!joins, item.clip));
  visit(AnswerField{.name = "from_clip", .help = "of a transition", .minimum = 0}, given_if(joins, item.clip));
  visit(AnswerField{.name = "to_clip", .help = "of a transition", .minimum = 0}, given_if(joins, item.to_clip));
  visit(AnswerField{.name = "method", .help = "of a transition"}, given_if(joins, item.method));
  visit(AnswerField{.name = "hand_kept_in", .help = "of an arm: where its hand keeps the place that it had"},
        given_if(item.hand.has_value(), name_of(hand.kept_in)));
  visit(AnswerField{.name = "hand_moved_mm", .help = "of an arm: how far the palm was moved to it"},
        given_if(item.hand.has_value(), hand.moved_mm));
}

/// All that a channel shows, without holes.
struct ReportLane {
  Channel channel = Channel::body;
  std::vector<ReportLaneItem> items;
};
template <class Visit>
void fields(Visit& visit, const ReportLane& lane) {
  visit.type("ReportLane");
  visit(AnswerField{.name = "channel", .one_of = {"left", "right", "tracks", "left_fingers", "right_fingers", "head"}},
        name_of(lane.channel));
  visit(AnswerField{.name = "items", .help = "in order of time, without holes"}, lane.items);
}

/// An authored movement of face, gaze or head.
struct ReportMovement {
  std::string name;
  std::string_view kind;                   ///< "expression", "gaze" or "mouthing"
  std::vector<std::string_view> channels;  ///< the non-manual channels that it moves; not empty
  std::size_t first = 0;
  std::size_t last = 0;
  FrameRange frames;
};
template <class Visit>
void fields(Visit& visit, const ReportMovement& one) {
  visit.type("ReportMovement");
  visit(AnswerField{.name = "name", .help = "of an expression or a gaze, or the mouthed text"}, one.name);
  visit(AnswerField{.name = "kind", .one_of = {"expression", "gaze", "mouthing"}}, one.kind);
  visit(AnswerField{.name = "channels", .help = "that it moves: head, gaze, brows, lids, mouth"}, one.channels);
  visit(AnswerField{.name = "first_place", .minimum = 0}, one.first);
  visit(AnswerField{.name = "last_place", .minimum = 0}, one.last);
  visit(AnswerField{.name = "frames"}, one.frames);
}

/// Signs, clips and junctions of a synthesis, without its poses.
struct SynthesisReport {
  std::int64_t frames = 0;
  double frames_per_second = 0;
  std::vector<ReportSign> signs;
  std::vector<ReportClip> clips;
  std::vector<ReportJunction> junctions;
  std::vector<ReportLane> lanes;  ///< those that differ from the body
  std::vector<ReportMovement> movements;
};
template <class Visit>
void report_fields(Visit& visit, const SynthesisReport& report) {
  visit(AnswerField{.name = "frames"}, report.frames);
  visit(AnswerField{.name = "frames_per_second"}, report.frames_per_second);
  visit(AnswerField{.name = "signs"}, report.signs);
  visit(AnswerField{.name = "clips"}, report.clips);
  visit(AnswerField{.name = "stretches", .help = "the former name of clips"}, report.clips);
  visit(AnswerField{.name = "junctions"}, report.junctions);
  visit(AnswerField{.name = "lanes", .help = "of channels that show something else than the body; missing: none"},
        given_if(!report.lanes.empty(), report.lanes));
  visit(AnswerField{.name = "movements", .help = "authored ones of face, gaze and head; missing: none"},
        given_if(!report.movements.empty(), report.movements));
}
template <class Visit>
void fields(Visit& visit, const SynthesisReport& report) {
  visit.type("SynthesisReport");
  report_fields(visit, report);
}

SynthesisReport report_of(const Synthesis& synthesis);

}  // namespace signweave
