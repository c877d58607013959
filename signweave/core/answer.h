#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"

/// Answers: values that the library gives out, whose members are described once. From the description come their JSON,
/// the schemas of the OpenAPI document and the types of the studio.
///
/// An answer is a plain struct with a function `fields` in its namespace, which visits each member with its
/// description, in the order in which JSON gives them, and may first name the type:
///
///     template <class Visit>
///     void fields(Visit& visit, const RemovedAnswer& answer) {
///       visit.type("Removed");
///       visit(AnswerField{.name = "removed", .help = "the name of the recording"}, answer.removed);
///     }
///
/// Members are bool, numbers, strings, other answers, and vectors, maps by name, variants, std::optional and OrNull of
/// these. `fields` may pass values that it computes. The type of every visited value must be default-constructible.
namespace signweave {

/// The description of one member of an answer.
struct AnswerField {
  std::string_view name;                      ///< of the property in JSON
  std::string_view help = {};                 ///< one line; empty if the name says it
  std::vector<std::string_view> one_of = {};  ///< the possible values of a string
  std::optional<std::int64_t> minimum = {};   ///< of a number
  std::optional<std::int64_t> maximum = {};   ///< of a number
};

/// A member that is always given, as null if it has no value. An std::optional without a value is left out.
template <class Value>
struct OrNull {
  std::optional<Value> value;
};
template <class Value>
OrNull(std::optional<Value>) -> OrNull<Value>;

/// A value for a member that is left out unless it is known.
template <class Value>
std::optional<Value> given_if(bool known, Value value) {
  return known ? std::optional<Value>(std::move(value)) : std::nullopt;
}
template <class Value>
OrNull<Value> null_unless(bool known, Value value) {
  return {given_if(known, std::move(value))};
}

template <class Visit>
void fields(Visit& visit, const Remedy& remedy) {
  visit.type("Remedy", "a parameter of the call that would fix it");
  visit(AnswerField{.name = "parameter"}, remedy.parameter);
  visit(AnswerField{.name = "value", .help = "true: a flag; missing: the user has to choose"},
        given_if(!remedy.value.empty(), remedy.value));
}

template <class Visit>
void fields(Visit& visit, const Notice& notice) {
  visit.type("Notice", "something that stopped nothing");
  visit(AnswerField{.name = "where", .help = "the file or recording that it is about; may be empty"}, notice.where);
  visit(AnswerField{.name = "text", .help = "one line"}, notice.text);
  visit(AnswerField{.name = "remedies", .help = "those with a value set together, or one of the others"},
        given_if(!notice.remedies.empty(), notice.remedies));
  visit(AnswerField{.name = "code", .help = "what kind of notice it is; missing for most"},
        given_if(!notice.code.empty(), notice.code));
}

/// The members of a span as answers give them.
template <class Visit>
void span_fields(Visit& visit, TimeSpan span) {
  visit(AnswerField{.name = "begin_ms"}, span.begin.count());
  visit(AnswerField{.name = "end_ms"}, span.end.count());
}
template <class Visit>
void fields(Visit& visit, const TimeSpan& span) {
  visit.type("Span");
  span_fields(visit, span);
}

template <class Visit>
void fields(Visit& visit, const FrameRange& frames) {
  visit.type("Frames");
  visit(AnswerField{.name = "begin"}, frames.begin);
  visit(AnswerField{.name = "end", .help = "the one after the last"}, frames.end);
}

}  // namespace signweave
