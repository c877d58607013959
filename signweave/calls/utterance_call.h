#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/core/answer.h"
#include "signweave/notation/utterance.h"

namespace signweave::calls {

/// Reads the text of an utterance without signing it.
struct UtteranceCall {
  std::string text;
};

template <class Visit>
void fields(Visit& visit, UtteranceCall& call) {
  visit(Field{.name = "text", .help = "glosses, tokens, pieces and pauses", .words = "TEXT", .required = true},
        call.text);
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
  const bool is_gloss = place.kind == Place::Kind::gloss;
  visit.type("UtterancePlace");
  visit(AnswerField{.name = "gloss"}, given_if(is_gloss, place.gloss.gloss));
  visit(AnswerField{.name = "token", .help = "missing: any", .minimum = 1},
        given_if(is_gloss && place.gloss.token > 0, place.gloss.token));
  visit(AnswerField{.name = "recording", .help = "of a piece, in place of a gloss"},
        given_if(!is_gloss, place.recording));
  visit(AnswerField{.name = "from_ms"}, given_if(!is_gloss, place.span.begin.count()));
  visit(AnswerField{.name = "to_ms"}, given_if(!is_gloss, place.span.end.count()));
  visit(pause_field("before it; missing: none"), pause_name(place.pause_before));
  visit(AnswerField{.name = "begin"}, one.begin);
  visit(AnswerField{.name = "end"}, one.end);
}

/// A fault in the text, and its span.
struct TextFault {
  std::string_view code;
  std::string message;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::optional<std::string> corrected;  ///< the whole text without this fault
};
template <class Visit>
void fields(Visit& visit, const TextFault& fault) {
  visit.type("UtteranceFault");
  visit(AnswerField{.name = "code",
                    .one_of = {"open_quote", "empty_name", "bad_suffix", "token_zero", "piece_order", "too_long"}},
        fault.code);
  visit(AnswerField{.name = "message"}, fault.message);
  visit(AnswerField{.name = "line", .minimum = 1}, 1);
  visit(AnswerField{.name = "column", .minimum = 1}, fault.begin + 1);
  visit(AnswerField{.name = "begin"}, fault.begin);
  visit(AnswerField{.name = "end"}, fault.end);
  visit(AnswerField{.name = "remedies"},
        given_if(fault.corrected.has_value(),
                 Remedies{{.parameter = "text", .value = fault.corrected.value_or(std::string())}}));
}

struct UtteranceAnswer {
  std::vector<TextPlace> places;
  Milliseconds pause_after{0};
  std::vector<TextFault> faults;
};
template <class Visit>
void fields(Visit& visit, const UtteranceAnswer& answer) {
  visit.type("UtteranceText", "spans are half-open, in characters (code points) from 0");
  visit(AnswerField{.name = "places", .help = "of words without a fault"}, answer.places);
  visit(pause_field("after the last place; missing: none"), pause_name(answer.pause_after));
  visit(AnswerField{.name = "faults", .help = "the first 20"}, answer.faults);
}

UtteranceAnswer run(const UtteranceCall& call);

}  // namespace signweave::calls
