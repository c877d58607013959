#include "signweave/core/syntax_error.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

TEST(PositionIn, CountsLinesAndCharactersFromOne) {
  const std::string_view text = "ab\n\xC3\xA9t\xC3\xA9 x\nlast";
  const TextPosition x = position_in(text, text.find('x'));
  EXPECT_EQ(x.line, 2U);
  EXPECT_EQ(x.column, 5U) << "each \xC3\xA9 is one character of two bytes";
  EXPECT_EQ(x.line_text, "\xC3\xA9t\xC3\xA9 x");
  EXPECT_EQ(x.line_text.substr(x.offset), "x");
}

TEST(PositionIn, ALineFeedBelongsToTheLineThatItEnds) {
  const TextPosition feed = position_in("ab\ncd", 2);
  EXPECT_EQ(feed.line, 1U);
  EXPECT_EQ(feed.column, 3U);
  EXPECT_EQ(feed.line_text, "ab");
}

TEST(PositionIn, PastTheEndIsTheEnd) {
  const TextPosition end = position_in("a\nbc", 99);
  EXPECT_EQ(end.line, 2U);
  EXPECT_EQ(end.column, 3U);
  EXPECT_EQ(end.offset, end.line_text.size());
  EXPECT_EQ(position_in("", 0).column, 1U);
}

}  // namespace
}  // namespace signweave
