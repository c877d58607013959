#include "signweave/core/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(MatchForm, ComposedAndDecomposedLettersAreEqual) {
  EXPECT_EQ(match_form("e\xCC\x81t\xC3\xA9"), match_form("\xC3\xA9te\xCC\x81"));
}

TEST(MatchForm, BlanksAtTheEndsDoNotCountAndInnerOnesDo) {
  EXPECT_EQ(match_form("  PLUIE \t"), "PLUIE");
  EXPECT_EQ(match_form("A  B"), "A  B");
  EXPECT_NE(match_form("a"), match_form("A"));
}

TEST(MatchForm, BytesThatAreNotUtf8AreOnlyTrimmed) {
  EXPECT_EQ(match_form(" \xE9t\xE9 "), "\xE9t\xE9");
}

TEST(IsUtf8, RefusesInvalidSequences) {
  EXPECT_TRUE(is_utf8(""));
  EXPECT_TRUE(is_utf8("手話 été"));
  EXPECT_FALSE(is_utf8("\xE9"));
  EXPECT_FALSE(is_utf8("\xC0\x80"));
  EXPECT_FALSE(is_utf8("\xED\xA0\x80"));
  EXPECT_FALSE(is_utf8("ab\xE2\x82"));
}

TEST(FoldCase, EveryScriptIsFolded) {
  EXPECT_EQ(fold_case("ÉTÉ"), fold_case("été"));
  EXPECT_EQ(fold_case("ΣΊΣΥΦΟΣ"), fold_case("σίσυφος"));
  EXPECT_EQ(fold_case("MixamoRig:Head"), "mixamorig:head");
}

TEST(LooseForm, SpellingDoesNotMatter) {
  EXPECT_EQ(loose_form("  ÉTÉ\t chaud\n"), "ete chaud");
  EXPECT_EQ(loose_form("e\xCC\x81te\xCC\x81"), "ete");
  EXPECT_EQ(loose_form("Œuvre, cœur, Æon"), "oeuvre, coeur, aeon");
  EXPECT_EQ(loose_form("AUJOURD’HUI"), loose_form("aujourd'hui"));
  EXPECT_EQ(loose_form("ＶＡＮＮＥＳ　２"), "vannes 2");
  EXPECT_EQ(loose_form("Straße"), "strasse");
  EXPECT_EQ(loose_form("手話"), "手話");
  EXPECT_NE(loose_form("が"), loose_form("た"));
  EXPECT_EQ(loose_form("\xE9t\xE9 A"), "\xE9t\xE9 A") << "not UTF-8: unchanged";
  EXPECT_EQ(loose_form(" \t"), "");
}

TEST(NearMatches, TheNearestComesFirstAndDistantOnesAreLeftOut) {
  const std::vector<std::string> known = {"VANNES", "VENISE", "PLUIE", "VANNE"};
  EXPECT_THAT(near_matches("VANES", known), ElementsAre("VANNES", "VANNE"));
  EXPECT_THAT(near_matches("vannes", known), ElementsAre("VANNES", "VANNE"));
  EXPECT_THAT(near_matches("SOLEIL", known), IsEmpty());
}

TEST(NearMatches, TwoLettersSwappedAreOneStep) {
  EXPECT_THAT(near_matches("ab", std::vector<std::string>{"ba"}), ElementsAre("ba"));
}

TEST(NearMatches, ReturnsAtMostTheLimitAndNoDuplicates) {
  const std::vector<std::string> known = {"aaaa1", "aaaa2", "aaaa2", "aaaa3", "aaaa4"};
  EXPECT_THAT(near_matches("aaaa", known, 2), ElementsAre("aaaa1", "aaaa2"));
  EXPECT_THAT(near_matches("aaaa", known, 3), ElementsAre("aaaa1", "aaaa2", "aaaa3"));
}

TEST(EitherOf, JoinsNamesAsInASentence) {
  EXPECT_EQ(either_of({}), "");
  EXPECT_EQ(either_of(std::vector<std::string>{"A"}), "A");
  EXPECT_EQ(either_of(std::vector<std::string>{"A", "B"}), "A or B");
  EXPECT_EQ(either_of(std::vector<std::string>{"A", "B", "C"}), "A, B or C");
}

TEST(DidYouMean, IsTheEndOfASentenceOrEmpty) {
  EXPECT_EQ(did_you_mean("stroek", std::vector<std::string>{"stroke"}), "; did you mean stroke?");
  EXPECT_EQ(did_you_mean("aaaa", std::vector<std::string>{"aaa1", "aaa2", "aaa3"}),
            "; did you mean aaa1, aaa2 or aaa3?");
  EXPECT_EQ(did_you_mean("xyz", std::vector<std::string>{"stroke"}), "");
}

TEST(Printable, StaysOnOneLineAndIsCut) {
  EXPECT_EQ(printable("a\nb\x01"), "a\\x0ab\\x01");
  EXPECT_EQ(printable(std::string(100, 'a')), std::string(80, 'a') + "…");
  std::string accents;
  for (int i = 0; i < 60; ++i) accents += "é";
  const std::string cut = printable(accents);
  EXPECT_TRUE(is_utf8(cut)) << "a letter was cut in two";
}

TEST(Trimmed, RemovesWhiteSpaceFromBothEnds) {
  EXPECT_EQ(trimmed(" \t\r\n a b \v\f"), "a b");
  EXPECT_EQ(trimmed(" \t"), "");
  EXPECT_EQ(trimmed(""), "");
}

}  // namespace
}  // namespace signweave
