#include "signweave/choose/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/core/error.h"

namespace signweave {
namespace {

TEST(Edit, AReplacementIsTwoGlossesAndAnEqualsSign) {
  const Replacement replacement = parse_replacement("MATIN#2=LE MANS");
  EXPECT_EQ(replacement.from, (GlossRef{"MATIN", 2}));
  EXPECT_EQ(replacement.to, (GlossRef{"LE MANS", 0}));
}

TEST(Edit, QuotesKeepAnEqualsSignInAGloss) {
  const Replacement replacement = parse_replacement("\"A=B\"#1=\"C#2\"#3");
  EXPECT_EQ(replacement.from, (GlossRef{"A=B", 1}));
  EXPECT_EQ(replacement.to, (GlossRef{"C#2", 3}));
}

TEST(Edit, ASwapIsTwoInclusiveRuns) {
  const auto [a, b] = parse_swap("BRETAGNE..\"SIX, JUILLET\",NUAGES#2..BROUILLARD");
  EXPECT_EQ(a.first.gloss, "BRETAGNE");
  EXPECT_EQ(a.last.gloss, "SIX, JUILLET");
  EXPECT_EQ(b.first, (GlossRef{"NUAGES", 2}));
  EXPECT_EQ(b.last.gloss, "BROUILLARD");
}

TEST(Edit, ARunOfOneSignNeedsNoDots) {
  const auto [a, b] = parse_swap("A,B#2");
  EXPECT_EQ(a.first, a.last);
  EXPECT_EQ(b.last, (GlossRef{"B", 2}));
}

TEST(Edit, ErrorsOfEditsSayWhatIsExpected) {
  EXPECT_THROW(parse_replacement("MATIN"), Error);
  EXPECT_THROW(parse_replacement("=MATIN"), Error);
  EXPECT_THROW(parse_swap("A..B"), Error);
  EXPECT_THROW(parse_swap("A..B,"), Error);
}

}  // namespace
}  // namespace signweave
