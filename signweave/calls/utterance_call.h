#pragma once

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
}  // namespace calls

template <class Visit>
void fields(Visit& visit, const PlacePart& part) {
  visit.type("UtterancePart", "what a part of the signer does meanwhile");
  visit(AnswerField{.name = "part", .one_of = calls::part_names()}, name_of(part.part));
  visit(AnswerField{.name = "places", .help = "the number of places that it accompanies", .minimum = 1}, part.places);
  visit(AnswerField{.name = "signs"}, part.signs);
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
  visit(AnswerField{.name = "what", .help = "the expression, the text to be mouthed, or the direction"}, one.what);
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
  visit(AnswerField{.name = "canonical", .help = "text that is read as the same utterance; missing with faults"},
        answer.canonical);
  visit(AnswerField{.name = "faults", .help = "the first 20"}, answer.faults);
}

UtteranceAnswer run(const UtteranceCall& call);

}  // namespace signweave::calls
