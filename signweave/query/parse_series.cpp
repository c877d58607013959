#include "signweave/query/parse_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "signweave/core/text.h"
#include "signweave/query/keywords.h"

namespace signweave {
namespace {

constexpr std::array kSeriesComponents = {Component::least, Component::begin, Component::end};
constexpr std::array kAngles = {GazeAngle::yaw, GazeAngle::pitch};

/// "jawOpen", or yaw.
std::string series_name(QueryLexer& in, bool gaze, const std::string& write) {
  const QueryToken token = in.take();
  const bool named = token.kind == QueryToken::Kind::word || token.kind == QueryToken::Kind::text;
  if (!named || trimmed(token.text).empty()) {
    in.fail(token.begin, fmt::format("expected {}, found {}; {}", gaze ? "an angle of the gaze" : "a track's name",
                                     QueryLexer::shown(token), write));
  }
  if (gaze && !value_of(kAngles, fold_case(token.text))) {
    in.fail(token.begin, fmt::format("the gaze has no angle {}{}; {}", QueryLexer::shown(token),
                                     did_you_mean(token.text, words_of(kAngles)), write));
  }
  return token.text;
}

}  // namespace

std::optional<QueryToken> take_component(QueryLexer& in) {
  const QueryToken& next = in.peek();
  if (next.kind != QueryToken::Kind::word || !next.text.starts_with('.')) return std::nullopt;
  QueryToken token = in.take();
  if (token.text == "." && in.peek().kind == QueryToken::Kind::word) token.text += in.take().text;
  return token;
}

void refuse_component(const QueryLexer& in, const QueryToken& token, const std::vector<std::string>& known) {
  const std::string word = fold_case(token.text.substr(1));
  in.fail(token.begin, fmt::format("no component is called '{}'{}; use one of {}", printable(word),
                                   did_you_mean(word, known), fmt::join(known, ", ")));
}

void parse_series(QueryLexer& in, const QueryToken& name, MovementTerm& term) {
  const bool gaze = is_gaze(term.quantity);
  const std::string write = gaze ? fmt::format("write {0}(yaw) or {0}(pitch)", name.text)
                                 : fmt::format("name a scalar track: {}(\"jawOpen\")", name.text);
  in.expect("(", write);
  const std::string text = series_name(in, gaze, write);
  if (gaze) {
    term.angle = *value_of(kAngles, fold_case(text));
  } else {
    term.track = text;
  }
  in.expect(")", gaze ? "close the parenthesis after the angle" : "close the parenthesis after the track's name");
  const std::optional<QueryToken> component = take_component(in);
  if (!component) return;
  if (term.quantity == Quantity::mean_track || term.quantity == Quantity::mean_gaze) {
    in.fail(component->begin,
            fmt::format("'{}' has no components; leave '{}' out", name.text, printable(component->text)));
  }
  const std::optional<Component> found = value_of(kSeriesComponents, fold_case(component->text.substr(1)));
  if (!found) refuse_component(in, *component, words_of(kSeriesComponents));
  term.component = *found;
}

}  // namespace signweave
