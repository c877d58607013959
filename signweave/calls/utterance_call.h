#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/core/answer.h"
#include "signweave/notation/utterance.h"

namespace signweave {

/// The members of a gloss or a piece.
template <class Visit>
void sign_fields(Visit& visit, const SignRef& sign, bool given = true) {
  const bool is_gloss = given && sign.kind == SignRef::Kind::gloss;
  const bool is_piece = given && sign.kind == SignRef::Kind::piece;
  visit(AnswerField{.name = "gloss"}, given_if(is_gloss, sign.gloss.gloss));
  visit(AnswerField{.name = "token", .help = "missing: any", .minimum = 1},
        given_if(is_gloss && sign.gloss.token > 0, sign.gloss.token));
  visit(AnswerField{.name = "recording", .help = "of a piece, in place of a gloss"},
        given_if(is_piece, sign.recording));
  visit(AnswerField{.name = "from_ms"}, given_if(is_piece, sign.span.begin.count()));
  visit(AnswerField{.name = "to_ms"}, given_if(is_piece, sign.span.end.count()));
}

template <class Visit>
void fields(Visit& visit, const SyncMark& mark) {
  visit.type("UtteranceSync", "ties the stroke of a part's sign to that of the place");
  visit(AnswerField{.name = "anchor", .one_of = {"begin", "end"}},
        std::string_view(mark.anchor == SyncMark::Anchor::begin ? "begin" : "end"));
  visit(AnswerField{.name = "offset_ms"}, mark.offset.count());
}

template <class Visit>
void fields(Visit& visit, const PartSign& one) {
  visit.type("UtteranceSign");
  sign_fields(visit, one.sign, !one.rest);
  visit(AnswerField{.name = "sync"}, given_if(!one.sync.empty(), one.sync));
  visit(AnswerField{.name = "rest", .help = "the hand rests instead of signing; not if missing"},
        given_if(one.rest, true));
}

/// The names of kBodyParts, of the kinds of faults, and of a kind of non-manual.
namespace calls {
std::vector<std::string_view> part_names();
std::vector<std::string_view> fault_names();
std::string_view kind_name(NonManual::Kind kind);
/// A locus as a text gives it, without "@".
std::optional<std::string> locus_text(const std::optional<LocusRef>& locus);
/// The numbers that a text would give: 1.3 rather than 1.2999999523.
double as_written(float value);
std::optional<std::vector<double>> as_written(const std::array<float, 3>& axes, float usual);
}  // namespace calls

template <class Visit>
void fields(Visit& visit, const PlacePart& part) {
  visit.type("UtterancePart", "what a part of the signer does meanwhile");
  visit(AnswerField{.name = "part", .one_of = calls::part_names()}, name_of(part.part));
  visit(AnswerField{.name = "places", .help = "the number of places that it accompanies", .minimum = 1}, part.places);
  visit(AnswerField{.name = "signs"}, part.signs);
}

/// Values as usual are left out.
template <class Visit>
void fields(Visit& visit, const SpaceChange& change) {
  visit.type("UtteranceSpace", "where a sign goes, and how its strokes are changed; what is missing is as captured");
  visit(AnswerField{.name = "from", .help = "the locus at which it begins, such as left, a, 30/10 or 0.3,0.1,0.8"},
        calls::locus_text(change.from));
  visit(AnswerField{.name = "to", .help = "the locus at which it ends"}, calls::locus_text(change.to));
  visit(AnswerField{.name = "at", .help = "the locus at which it points or is made"}, calls::locus_text(change.at));
  std::vector<std::string> along;
  for (const LocusRef& locus : change.along) along.push_back(to_string(locus));
  visit(AnswerField{.name = "along", .help = "the loci along which the hand goes"}, given_if(!along.empty(), along));
  visit(AnswerField{.name = "past", .help = "the locus that the hand passes"}, calls::locus_text(change.past));
  visit(AnswerField{.name = "unturned", .help = "the hand keeps its orientation on its path"},
        given_if(change.keeps_turn, true));
  visit(AnswerField{.name = "move_cm", .help = "to the left, up, forward"}, calls::as_written(change.move, 0));
  visit(AnswerField{.name = "turn_degrees", .help = "about the axes left, up, forward"},
        calls::as_written(change.turn, 0));
  visit(AnswerField{.name = "scale", .help = "factors along the axes left, up, forward"},
        calls::as_written(change.scale, 1));
  visit(AnswerField{.name = "size", .help = "a factor of the whole movement"},
        given_if(change.size != 1, calls::as_written(change.size)));
  visit(AnswerField{.name = "speed", .help = "a factor of the speed of its strokes"},
        given_if(change.speed != 1, calls::as_written(change.speed)));
  visit(AnswerField{.name = "repetitions", .help = "the times that a stroke is signed", .minimum = 1},
        given_if(change.repetitions != 1, change.repetitions));
  visit(AnswerField{.name = "outward", .help = "repetitions shrink and go outward: a plural"},
        given_if(change.outward, true));
  visit(AnswerField{.name = "mirrored", .help = "left and right are exchanged"}, given_if(change.mirrored, true));
}

template <class Visit>
void fields(Visit& visit, const LocusSetup& setup) {
  visit.type("UtteranceLocus", "a locus that is set up at a place");
  visit(AnswerField{.name = "name"}, setup.name);
  visit(AnswerField{.name = "is", .help = "the locus that it is, such as left or 30/10"}, to_string(setup.is));
  visit(AnswerField{.name = "from", .help = "the place from which on it is there, from 0", .minimum = 0}, setup.from);
}

template <class Visit>
void fields(Visit& visit, const HandHold& hold) {
  visit.type("UtteranceHold", "a hand that keeps its pose at the end of a place");
  visit(AnswerField{.name = "hand", .one_of = {"dominant", "weak", "right", "left"}}, name_of(hold.hand));
  visit(AnswerField{.name = "from", .help = "the place, from 0", .minimum = 0}, hold.from);
  visit(AnswerField{.name = "until", .help = "the place with which it ends", .minimum = 1}, hold.until);
}

template <class Visit>
void fields(Visit& visit, const NonManual& one) {
  visit.type("UtteranceNonManual", "a movement of the face, the gaze or the head over places");
  visit(AnswerField{.name = "kind", .one_of = {"expression", "mouthing", "gaze"}}, calls::kind_name(one.kind));
  visit(AnswerField{.name = "what", .help = "the expression, the text to be mouthed, or the direction or locus"},
        one.what);
  visit(AnswerField{.name = "first", .help = "the place, from 0", .minimum = 0}, one.first);
  visit(AnswerField{.name = "last", .help = "inclusive", .minimum = 0}, one.last);
  visit(AnswerField{.name = "begin_ms", .help = "added to its usual begin"}, one.begin.count());
  visit(AnswerField{.name = "end_ms", .help = "added to its usual end"}, one.end.count());
}

}  // namespace signweave

namespace signweave::calls {

/// Reads the text of an utterance without signing it.
struct UtteranceCall {
  std::string text;
};

template <class Visit>
void fields(Visit& visit, UtteranceCall& call) {
  visit(Field{.name = "text", .help = "the text of an utterance", .words = "TEXT", .required = true}, call.text);
}

inline AnswerField pause_field(std::string_view help) {
  return {.name = "pause", .help = help, .one_of = {"comma", "stop"}};
}

/// "comma" or "stop"; none for no pause.
std::optional<std::string_view> pause_name(Milliseconds pause);

/// A place of an utterance, and its span in the text in characters (code points) from 0, half-open. Its other members
/// are those of a studio project's place.
struct TextPlace {
  Place place;
  std::size_t begin = 0;
  std::size_t end = 0;
};
template <class Visit>
void fields(Visit& visit, const TextPlace& one) {
  const Place& place = one.place;
  visit.type("UtterancePlace");
  sign_fields(visit, place);
  visit(pause_field("before it; missing: none"), pause_name(place.pause_before));
  visit(AnswerField{.name = "dominant",
                    .help = "the hand that signs it as the dominant one; missing: the signer's",
                    .one_of = {"left", "right"}},
        given_if(place.dominant.has_value(), std::string_view(place.dominant == Side::left ? "left" : "right")));
  visit(AnswerField{.name = "parts", .help = "missing: none"}, given_if(!place.parts.empty(), place.parts));
  visit(AnswerField{.name = "space", .help = "missing: as captured"},
        given_if(place.space != SpaceChange{}, place.space));
  visit(AnswerField{.name = "begin"}, one.begin);
  visit(AnswerField{.name = "end"}, one.end);
}

/// A fault in the text, and its span.
struct TextFault {
  std::string_view code;
  std::string message;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t line = 1;
  std::size_t column = 1;
  std::optional<std::string> corrected;  ///< the whole text without this fault
};
template <class Visit>
void fields(Visit& visit, const TextFault& fault) {
  visit.type("UtteranceFault");
  visit(AnswerField{.name = "code", .one_of = fault_names()}, fault.code);
  visit(AnswerField{.name = "message"}, fault.message);
  visit(AnswerField{.name = "line", .minimum = 1}, fault.line);
  visit(AnswerField{.name = "column", .minimum = 1}, fault.column);
  visit(AnswerField{.name = "begin"}, fault.begin);
  visit(AnswerField{.name = "end"}, fault.end);
  visit(AnswerField{.name = "remedies"},
        given_if(fault.corrected.has_value(),
                 Remedies{{.parameter = "text", .value = fault.corrected.value_or(std::string())}}));
}

struct UtteranceAnswer {
  std::vector<TextPlace> places;
  Milliseconds pause_after{0};
  std::vector<HandHold> holds;
  std::vector<NonManual> non_manuals;
  std::vector<LocusSetup> loci;
  std::optional<std::string> canonical;  ///< none for a text with faults or without a sign
  std::vector<TextFault> faults;
};
template <class Visit>
void fields(Visit& visit, const UtteranceAnswer& answer) {
  visit.type("UtteranceText", "spans are half-open, in characters (code points) from 0");
  visit(AnswerField{.name = "places", .help = "of words without a fault"}, answer.places);
  visit(pause_field("after the last place; missing: none"), pause_name(answer.pause_after));
  visit(AnswerField{.name = "holds", .help = "missing: none"}, given_if(!answer.holds.empty(), answer.holds));
  visit(AnswerField{.name = "non_manuals", .help = "missing: none"},
        given_if(!answer.non_manuals.empty(), answer.non_manuals));
  visit(AnswerField{.name = "loci", .help = "missing: none"}, given_if(!answer.loci.empty(), answer.loci));
  visit(AnswerField{.name = "canonical", .help = "text that is read as the same utterance; missing with faults"},
        answer.canonical);
  visit(AnswerField{.name = "faults", .help = "the first 20"}, answer.faults);
}

UtteranceAnswer run(const UtteranceCall& call);

}  // namespace signweave::calls
