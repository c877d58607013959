#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/answer.h"
#include "signweave/notation/score_json.h"
#include "signweave/score/report.h"

/// Inside the library and its programs only: the members of a score's JSON (core/answer.h).
namespace signweave {

using NumberPair = std::array<std::int64_t, 2>;

inline NumberPair pair_of(FrameRange frames) {
  return {frames.begin, frames.end};
}

/// 16 hexadecimal digits.
std::string text_of_fingerprint(std::uint64_t fingerprint);

template <class Visit>
void fields(Visit& visit, const SourceRef& source) {
  visit.type("ScoreSource");
  visit(AnswerField{.name = "recording"}, source.recording);
  visit(AnswerField{.name = "fingerprint", .help = "of its motion file, hexadecimal; 0: not known"},
        text_of_fingerprint(source.fingerprint));
  visit(AnswerField{.name = "kind", .help = "recording if missing", .one_of = {"recording", "rest", "shown"}},
        given_if(source.kind != SourceRef::Kind::recording, name_of(source.kind)));
}

template <class Visit>
void fields(Visit& visit, const Phase& phase) {
  visit.type("ScorePhase");
  visit(AnswerField{.name = "kind"}, name_of(phase.kind));
  visit(AnswerField{.name = "ms", .help = "begin and end"},
        NumberPair{phase.span.begin.count(), phase.span.end.count()});
  visit(AnswerField{.name = "label"}, phase.label);
  visit(AnswerField{.name = "annotation"}, phase.annotation);
}

struct ScoreSign {
  std::size_t place = 0;
  Sign sign;
};
template <class Visit>
void fields(Visit& visit, const ScoreSign& one) {
  const Sign& sign = one.sign;
  visit.type("ScoreSign");
  visit(AnswerField{.name = "place", .minimum = 0}, one.place);
  visit(AnswerField{.name = "gloss"}, sign.gloss);
  visit(AnswerField{.name = "ms", .help = "begin and end in the recording's annotation time"},
        NumberPair{sign.span.begin.count(), sign.span.end.count()});
  visit(AnswerField{.name = "hand"}, name_of(sign.hand));
  visit(AnswerField{.name = "signer"}, sign.signer);
  visit(AnswerField{.name = "tier"}, sign.tier);
  visit(AnswerField{.name = "annotation"}, sign.annotation);
  visit(AnswerField{.name = "inferred"}, sign.inferred);
  visit(AnswerField{.name = "phases"}, sign.phases);
}

template <class Visit>
void fields(Visit& visit, const GroundTransform& standing) {
  const auto& [turn, shift] = standing;
  visit.type("ScoreStanding");
  visit(AnswerField{.name = "turn", .help = "a unit quaternion, x y z w"},
        std::array<float, 4>{turn.x(), turn.y(), turn.z(), turn.w()});
  visit(AnswerField{.name = "shift", .help = "metres"}, std::array<float, 3>{shift.x(), shift.y(), shift.z()});
}

template <class Visit>
void fields(Visit& visit, const FrameClock& clock) {
  visit.type("ScoreClock");
  visit(AnswerField{.name = "frame_time", .help = "seconds of annotation time"}, clock.frame_time.count());
  visit(AnswerField{.name = "origin", .help = "the annotation time of frame 0, in seconds"}, clock.origin.count());
}

std::vector<ScoreSign> signs_of(const Clip& clip);

inline std::array<float, 3> numbers_of(const Eigen::Vector3f& vector) {
  return {vector.x(), vector.y(), vector.z()};
}
inline std::array<float, 4> numbers_of(const Eigen::Quaternionf& turn) {
  return {turn.x(), turn.y(), turn.z(), turn.w()};
}

template <class Visit>
void fields(Visit& visit, const PathPoint& point) {
  visit.type("ScorePathPoint");
  visit(AnswerField{.name = "shift", .help = "metres"}, numbers_of(point.shift));
  visit(AnswerField{.name = "turn", .help = "axis times angle, radians"}, numbers_of(point.turn));
  visit(AnswerField{.name = "swivel", .help = "of the elbow, radians"}, point.swivel);
}

/// One hand of a changed stroke.
struct ScoreArmChange {
  Side side = Side::left;
  ArmChange change;
};
template <class Visit>
void fields(Visit& visit, const ScoreArmChange& arm) {
  const ArmChange& change = arm.change;
  visit.type("ScoreArmChange");
  visit(AnswerField{.name = "hand", .one_of = {"left", "right"}}, name_of(arm.side));
  visit(AnswerField{.name = "linear", .help = "of the palm's place: three columns"},
        std::array<std::array<float, 3>, 3>{numbers_of(change.linear.col(0)), numbers_of(change.linear.col(1)),
                                            numbers_of(change.linear.col(2))});
  visit(AnswerField{.name = "from", .help = "metres, in the axes of signer-centred space"}, numbers_of(change.from));
  visit(AnswerField{.name = "to"}, numbers_of(change.to));
  visit(AnswerField{.name = "turn", .help = "of the hand: a unit quaternion, x y z w"}, numbers_of(change.turn));
  visit(AnswerField{.name = "carry", .help = "of the arm about the shoulder, likewise"}, numbers_of(change.carry));
  visit(AnswerField{.name = "swivel", .help = "of the elbow, radians"}, change.swivel);
  visit(AnswerField{.name = "path", .help = "displacements at equal steps of the stroke"}, change.path);
}

/// A change of a clip, with the numbers that make its frames.
struct ScoreChange {
  ClipChange change;
};
std::vector<ScoreArmChange> arms_of(const StrokeChange& change);
std::vector<ScoreChange> changes_of(const Clip& clip);
template <class Visit>
void fields(Visit& visit, const ScoreChange& one) {
  const StrokeChange& stroke = one.change.stroke;
  visit.type("ScoreChange");
  change_fields(visit, one.change);
  visit(AnswerField{.name = "arms"}, arms_of(stroke));
  visit(AnswerField{.name = "together", .help = "both hands keep to each other"}, stroke.together);
  visit(AnswerField{.name = "trunk_yaw", .help = "radians, to the signer's left"}, stroke.trunk_yaw);
  visit(AnswerField{.name = "before", .help = "recording frames over which the change begins"}, stroke.before);
  visit(AnswerField{.name = "after", .help = "recording frames over which it ends"}, stroke.after);
}

template <class Visit>
void fields(Visit& visit, const Clip& clip) {
  visit.type("ScoreClip");
  visit(AnswerField{.name = "id", .minimum = 0}, clip.id);
  visit(AnswerField{.name = "place", .help = "the first place of the utterance that it is of, from 0", .minimum = 0},
        clip.place);
  visit(AnswerField{.name = "source"}, clip.source);
  visit(
      AnswerField{.name = "whole", .help = "recording frames that may be shown: the first, and the one after the last"},
      pair_of(clip.whole));
  visit(AnswerField{.name = "core", .help = "recording frames that are never changed"}, pair_of(clip.core));
  visit(AnswerField{.name = "step", .help = "recording frames per output frame"}, clip.step);
  visit(AnswerField{.name = "at", .help = "output frames of the core"}, pair_of(clip.at));
  visit(AnswerField{.name = "standing", .help = "moves it to where the signer stands; null: it is not moved"},
        OrNull<GroundTransform>{clip.standing});
  visit(AnswerField{.name = "clock"}, clip.clock);
  visit(AnswerField{.name = "signs"}, signs_of(clip));
  visit(AnswerField{.name = "mirrored", .help = "shown with left and right exchanged; not if missing"},
        given_if(clip.mirrored, true));
  visit(AnswerField{.name = "at_rest", .help = "a hand that rests; not if missing"}, given_if(clip.at_rest, true));
  visit(AnswerField{.name = "changes", .help = "of its core in space; missing: as captured"},
        given_if(!clip.changes.empty(), changes_of(clip)));
}

template <class Visit>
void fields(Visit& visit, const Transition& transition) {
  const TransitionCut& cut = transition.cut;
  visit.type("ScoreTransition");
  visit(AnswerField{.name = "from", .minimum = 0}, transition.from);
  visit(AnswerField{.name = "to", .minimum = 0}, transition.to);
  visit(AnswerField{.name = "length"}, cut.length);
  visit(AnswerField{.name = "retraction"}, cut.retraction_frames);
  visit(AnswerField{.name = "preparation"}, cut.preparation_frames);
  visit(AnswerField{.name = "blend"}, cut.blend_frames);
  visit(AnswerField{.name = "pause"}, cut.pause_frames);
  visit(AnswerField{.name = "waits"}, cut.waits);
}

template <class Visit>
void fields(Visit& visit, const HandPlace& place) {
  visit.type("ScoreHandPlace");
  visit(AnswerField{.name = "anchor",
                    .help = "what the hand touched in its recording",
                    .one_of = {"signer space", "trunk", "head", "other hand"}},
        name_of(place.anchor));
  visit(AnswerField{.name = "kept_in",
                    .help = "the space in which it keeps its place",
                    .one_of = {"signer space", "trunk", "head"}},
        name_of(place.kept_in));
  visit(AnswerField{.name = "out", .help = "moved out of the body by this, in metres"},
        std::array<float, 3>{place.out.x(), place.out.y(), place.out.z()});
  visit(AnswerField{.name = "moved_mm", .help = "from where the copied arm would have the palm"}, place.moved_mm);
  visit(AnswerField{.name = "turned_degrees"}, place.turned_degrees);
}

template <class Visit>
void fields(Visit& visit, const Item& item) {
  const auto* const use = std::get_if<ClipUse>(&item.what);
  const auto* const made = std::get_if<Transition>(&item.what);
  const auto* const held = std::get_if<Hold>(&item.what);
  visit.type("ScoreItem");
  visit(AnswerField{.name = "at", .help = "output frames"}, pair_of(item.at));
  visit(AnswerField{.name = "clip", .help = "or a transition, or a hold", .minimum = 0},
        given_if(use != nullptr, use == nullptr ? ClipId{0} : use->clip));
  visit(AnswerField{.name = "hand", .help = "the corrected place of the clip's hand"},
        given_if(use != nullptr && use->place, use != nullptr ? use->place.value_or(HandPlace()) : HandPlace()));
  visit(AnswerField{.name = "transition"}, given_if(made != nullptr, made == nullptr ? Transition() : *made));
  visit(AnswerField{.name = "hold",
                    .help = "the clip whose last pose is held; at the begin of a lane, whose first pose is",
                    .minimum = 0},
        given_if(held != nullptr, held == nullptr ? ClipId{0} : held->clip));
}

template <class Visit>
void fields(Visit& visit, const Lane& lane) {
  visit.type("ScoreLane");
  visit(AnswerField{.name = "channel",
                    .one_of = {"body", "left", "right", "tracks", "left_fingers", "right_fingers", "head"}},
        name_of(lane.channel));
  visit(AnswerField{.name = "items"}, lane.items);
}

template <class Visit>
void fields(Visit& visit, const JunctionRef& junction) {
  visit.type("ScoreJunction");
  visit(AnswerField{.name = "number"}, junction.number);
  visit(AnswerField{.name = "method"}, junction.method);
  visit(AnswerField{.name = "chosen", .help = "the options given for it alone"}, junction.chosen);
}

template <class Visit>
void fields(Visit& visit, const TrackWeight& one) {
  visit.type("ScoreTrackWeight");
  visit(AnswerField{.name = "track", .help = "an ARKit name"}, one.track);
  visit(AnswerField{.name = "weight"}, one.weight);
}

template <class Visit>
void fields(Visit& visit, const HeadAngles& angles) {
  visit.type("ScoreHeadAngles", "degrees: up, to the signer's left, tilted to the signer's left");
  visit(AnswerField{.name = "pitch"}, angles.pitch);
  visit(AnswerField{.name = "yaw"}, angles.yaw);
  visit(AnswerField{.name = "roll"}, angles.roll);
}

template <class Visit>
void fields(Visit& visit, const HeadMovement& head) {
  visit.type("ScoreHeadMovement");
  visit(AnswerField{.name = "turn"}, head.turn);
  visit(AnswerField{.name = "swing", .help = "the amplitude of an oscillation about it"}, head.swing);
  visit(AnswerField{.name = "hertz"}, head.hertz);
  visit(AnswerField{.name = "delay_ms"}, head.delay.count());
  visit(AnswerField{.name = "onset_ms"}, head.onset.count());
  visit(AnswerField{.name = "offset_ms"}, head.offset.count());
}

template <class Visit>
void fields(Visit& visit, const MouthKey& key) {
  visit.type("ScoreMouthKey");
  visit(AnswerField{.name = "viseme"}, name_of(key.viseme));
  visit(AnswerField{.name = "at_ms", .help = "from the begin of the curve"}, key.at.count());
  visit(AnswerField{.name = "held_ms"}, key.held.count());
  visit(AnswerField{.name = "strength"}, key.strength);
}

template <class Visit>
void fields(Visit& visit, const GazeDirection& gaze) {
  visit.type("ScoreGaze", "degrees: to the signer's left, up");
  visit(AnswerField{.name = "yaw"}, gaze.yaw);
  visit(AnswerField{.name = "pitch"}, gaze.pitch);
}

template <class Visit>
void fields(Visit& visit, const AuthoredCurve& one) {
  const Curve& curve = one.curve;
  visit.type("ScoreCurve", "an authored movement of face, gaze or head over captured motion");
  visit(AnswerField{.name = "name"}, curve.name);
  visit(AnswerField{.name = "at", .help = "output frames"}, pair_of(one.at));
  visit(AnswerField{.name = "places", .help = "the first and the last that it accompanies, from 0"},
        NumberPair{static_cast<std::int64_t>(one.first), static_cast<std::int64_t>(one.last)});
  visit(AnswerField{.name = "onset_ms"}, curve.onset.count());
  visit(AnswerField{.name = "offset_ms"}, curve.offset.count());
  visit(AnswerField{.name = "amount"}, curve.amount);
  visit(AnswerField{.name = "merge", .one_of = {"usual", "maximum", "sum", "replace"}}, name_of(curve.merge));
  visit(AnswerField{.name = "weights"}, curve.weights);
  visit(AnswerField{.name = "head"}, given_if(curve.head.moves(), curve.head));
  visit(AnswerField{.name = "mouth"}, given_if(!curve.mouth.empty(), curve.mouth));
  visit(AnswerField{.name = "gaze"}, given_if(curve.gaze.has_value(), curve.gaze.value_or(GazeDirection())));
}

template <class Visit>
void fields(Visit& visit, const Score& score) {
  visit.type("Score");
  visit(AnswerField{.name = "signweave_score", .help = "the version of the format", .minimum = 1}, version_of(score));
  visit(AnswerField{.name = "skeleton"}, score.skeleton);
  visit(AnswerField{.name = "rate", .help = "numerator and denominator of the frames per second"},
        NumberPair{score.rate.numerator, score.rate.denominator});
  visit(AnswerField{.name = "frames", .minimum = 1}, score.frames);
  visit(AnswerField{.name = "clips"}, score.clips);
  visit(AnswerField{.name = "junctions"}, score.junctions);
  visit(AnswerField{.name = "lanes"}, score.lanes);
  visit(AnswerField{.name = "curves", .help = "missing: none"}, given_if(!score.curves.empty(), score.curves));
}

}  // namespace signweave
