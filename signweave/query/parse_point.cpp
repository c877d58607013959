#include "signweave/query/parse_point.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "signweave/core/text.h"
#include "signweave/query/movement_term.h"

namespace signweave {

Point parse_point(QueryLexer& in, bool sided) {
  return point_of(in, in.take(), sided);
}

Point point_of(QueryLexer& in, const QueryToken& token, bool sided) {
  const bool named = token.kind == QueryToken::Kind::word || token.kind == QueryToken::Kind::text;
  const std::optional<Point> found = named ? point_named(fold_case(token.text)) : std::nullopt;
  if (found && sided && found->kind == Point::Kind::hand) {
    in.fail(token.begin, "name the hand to compare: right_hand or left_hand, or no hand for both");
  }
  if (found) return *found;
  constexpr std::string_view kExamples = "hand, right_hand, left_elbow, head, right_index_tip";
  if (!named) {
    in.fail(token.begin, fmt::format("expected a point of the signer, found {}; name one such as {}",
                                     QueryLexer::shown(token), kExamples));
  }
  in.fail(token.begin, fmt::format("no point is called {}{}; name one such as {}", QueryLexer::shown(token),
                                   did_you_mean(token.text, point_words()), kExamples));
}

}  // namespace signweave
