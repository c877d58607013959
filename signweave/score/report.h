#pragma once

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

/// A clip: signs of one recording as they were captured. Frames are those of the new motion.
struct ReportClip {
  std::size_t clip = 0;
  std::size_t place = 0;
  ShownClip shown;
  bool mirrored = false;  ///< left and right are exchanged
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

/// An authored movement of face, gaze or head.
struct ReportMovement {
  std::string name;
  std::size_t first = 0;
  std::size_t last = 0;
  FrameRange frames;
};
template <class Visit>
void fields(Visit& visit, const ReportMovement& one) {
  visit.type("ReportMovement");
  visit(AnswerField{.name = "name", .help = "of an expression or a gaze, or the mouthed text"}, one.name);
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
