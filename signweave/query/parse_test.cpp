#include "signweave/query/parse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "signweave/query/queries_for_tests.h"

namespace signweave {
namespace {

using testing::HasSubstr;

TEST(Parse, AWellFormedQueryParsesBackToItself) {
  struct Row {
    const char* text;
    const char* normal;
  };
  const Row rows[] = {
      {"gloss = \"VANNES\"", "gloss = \"VANNES\""},
      {"gloss=VANNES", "gloss = \"VANNES\""},
      {"gloss = LE-TEMPS-PREVU->gloss = AUJOURD'HUI", "gloss = \"LE-TEMPS-PREVU\" -> gloss = \"AUJOURD'HUI\""},
      {"gloss = #BANK | gloss = \"$INDEX1\"", "gloss = \"#BANK\" | gloss = \"$INDEX1\""},
      {R"(gloss = "say \"A\\B\"\t")", R"(gloss = "say \"A\\B\"\t")"},
      {"gloss =~ /NUAGE.*/", "gloss =~ /NUAGE.*/"},
      {R"(gloss =~ /a\/b\\/i)", R"(gloss =~ /a\/b\\/i)"},
      {"gloss != \"\"", "gloss != \"\""},
      {"phase = Stroke", "phase = stroke"},
      {"phase != \"hold\" & hand = left", "phase != hold & hand = left"},
      {"hands = Symmetric | hands != one", "hands = symmetric | hands != one"},
      {"duration > 300ms", "duration > 300ms"},
      {"duration >= 1.5 s", "duration >= 1500ms"},
      {"begin = -0.010s & end <= 1.500ms", nullptr},
      {"begin = -0.010s & end <= 15.0ms", "begin = -10ms & end <= 15ms"},
      {"tier(\"Mouth gesture\") = pluie", "tier(\"Mouth gesture\") = \"pluie\""},
      {"tier(Mouthing)!=pluie", "tier(\"Mouthing\") != \"pluie\""},
      {"gloss = A & gloss = B | gloss = C", "gloss = \"A\" & gloss = \"B\" | gloss = \"C\""},
      {"gloss = A & (gloss = B | gloss = C)", "gloss = \"A\" & (gloss = \"B\" | gloss = \"C\")"},
      {"((gloss = A))", "gloss = \"A\""},
      {"(gloss = A & gloss = B) & gloss = C", "(gloss = \"A\" & gloss = \"B\") & gloss = \"C\""},
      {"!gloss = A & !(gloss = B | gloss = C)", "!gloss = \"A\" & !(gloss = \"B\" | gloss = \"C\")"},
      {"!!gloss = A", "!!gloss = \"A\""},
      {"parent(gloss = A & child(phase = hold))", "parent(gloss = \"A\" & child(phase = hold))"},
      {"gloss = MATIN ->[..500ms] gloss = NUAGES", "gloss = \"MATIN\" ->[..500ms] gloss = \"NUAGES\""},
      {"gloss = A -> [ 0.1s .. 500 ms ] gloss = B", "gloss = \"A\" ->[100ms..500ms] gloss = \"B\""},
      {"gloss = A ->[200ms..] gloss = B", "gloss = \"A\" ->[200ms..] gloss = \"B\""},
      {"gloss = A overlaps tier(M) = p", "gloss = \"A\" overlaps tier(\"M\") = \"p\""},
      {"gloss = A overlaps tier(M) = p during @gloss = B -> gloss = C",
       "gloss = \"A\" overlaps tier(\"M\") = \"p\" during @ gloss = \"B\" -> gloss = \"C\""},
      {"overlaps(gloss = A) | gloss = B", "overlaps(gloss = \"A\") | gloss = \"B\""},
      {"gloss = A\n  & phase = stroke", "gloss = \"A\" & phase = stroke"},
      {"gloss = \xC3\x89T\xC3\x89", "gloss = \"\xC3\x89T\xC3\x89\""},
  };
  for (const Row& row : rows) {
    if (row.normal == nullptr) {
      EXPECT_THROW(parse(row.text), SyntaxError) << row.text;
      continue;
    }
    const PhaseQuery query = parse(row.text);
    EXPECT_EQ(to_string(query), row.normal);
    EXPECT_EQ(parse(to_string(query)), query) << row.text;
  }
}

TEST(Parse, AndBindsBeforeOrAndRelationsBeforeArrows) {
  const PhaseQuery query = parse("gloss = A | gloss = B & hand = left overlaps gloss = C -> gloss = D");
  ASSERT_EQ(query.elements.size(), 2U);
  EXPECT_EQ(query.elements[0].relations.size(), 1U);
  const Expression& first = query.elements[0].term.expression;
  EXPECT_EQ(first.kind, Expression::Kind::any);
  EXPECT_EQ(first.operands[1].kind, Expression::Kind::all);
}

SyntaxError fault_in(std::string_view text) {
  try {
    parse(text);
  } catch (const SyntaxError& error) {
    return error;
  }
  return {ErrorCode::io, "no fault", 0, 0, ""};
}

TEST(Parse, AFaultIsOneLineWithItsColumn) {
  struct Row {
    const char* text;
    std::size_t column;
    const char* says;
  };
  const Row rows[] = {
      {"", 1, "the query is empty"},
      {"   ", 4, "the query is empty"},
      {"gloss", 6, "expected a comparison after 'gloss', found the end of the query"},
      {"gloss = ", 9, "expected a value after '=', found the end of the query"},
      {"gloss == A", 8, "expected a value after '=', found '='"},
      {"gloss = & hand = left", 9, "expected a value after '=', found '&'"},
      {"glos = A", 1, "no condition is called 'glos'; did you mean gloss?"},
      {"gloss = \"VANNES", 9, "no closing quote"},
      {"gloss = \xE2\x80\x9CVANNES\xE2\x80\x9D", 9, "straight double quotes"},
      {"gloss = 'VANNES'", 9, "straight double quotes"},
      {R"(gloss = "A\x")", 11, "backslash"},
      {"gloss =~ \"A\"", 10, "expected a regular expression"},
      {"gloss =~ /A", 10, "close it with /"},
      {"gloss =~ /A(/", 10, "regular expression: missing"},
      {"gloss =~ /A/gi", 10, "flags 'gi'"},
      {"gloss = /A/", 9, "a regular expression after =~"},
      {"gloss < A", 7, "expected a comparison after 'gloss', found '<'; use one of = != =~"},
      {"duration =~ /3/", 10, "use one of = != < <= > >="},
      {"hand =~ /l.*/", 6, "use one of = !="},
      {"hands = both", 9, "'both' is a value of the field 'hand'; did you mean hand = both?"},
      {"hand = Symmetric", 8, "'Symmetric' is a value of the field 'hands'; did you mean hands = symmetric?"},
      {"hands = symetric", 9, "no class of hands is called 'symetric'; did you mean symmetric or asymmetric?"},
      {"hands = two", 9, "use one of one, symmetric, alternating, asymmetric"},
      {"hands > one", 7, "use one of = !="},
      {"hand = middle", 8, "no hand is called 'middle'; use one of both, right, left"},
      {"phase = strok", 9, "no phase is called 'strok'; did you mean stroke?"},
      {"duration > 300", 12, "lacks a unit; write 300ms or 300s"},
      {"duration > soon", 12, "'soon' is not a time"},
      {"duration > 0.5ms", 12, "whole milliseconds"},
      {"duration > 1.s", 12, "is not a time"},
      {"duration > 1000000000000000s", 12, "15 digits"},
      {"duration > --1s", 12, "is not a time"},
      {"gloss = A phase = stroke", 11, "expected & | -> or the end of the query, found 'phase'"},
      {"gloss = A)", 10, "')' without '('"},
      {"(gloss = A", 11, "expected ')', found the end of the query; close the parenthesis of column 1"},
      {"gloss = A & ", 13, "expected a condition, found the end of the query"},
      {"gloss = A -> ", 14, "expected a condition"},
      {"gloss = A ->[500ms] gloss = B", 14, "two bounds"},
      {"gloss = A ->[..] gloss = B", 14, "without bounds"},
      {"gloss = A ->[2s..1s] gloss = B", 14, "swap"},
      {"gloss = A ->[-1s..1s] gloss = B", 14, "cannot be negative"},
      {"gloss = A ->[..500] gloss = B", 16, "lacks a unit"},
      {"gloss = A ->[..500ms gloss = B", 13, "'[' without ']'"},
      {"gloss = A -> phase = stroke", 11, "a sign and a phase"},
      {"tier = A", 6, "expected '(', found '='; name the tier"},
      {"tier() = A", 6, "expected a tier's name"},
      {"parent = A", 8, "write a condition in parentheses"},
      {"@ gloss = A -> @ gloss = B", 16, "a second @"},
      {"gloss = A & @ hand = left", 13, "@ marks a whole part"},
      {"gloss = A, gloss = B", 10, "',' has no meaning here"},
      {"gloss = A\n& glos = B", 3, "no condition is called 'glos'"},
      {"gloss = \"\xC3\xA9t\xC3\xA9\" hand = left", 15, "found 'hand'"},
      {"gloss = \"\xC3\"", 10, "not UTF-8"},
  };
  for (const Row& row : rows) {
    const SyntaxError error = fault_in(row.text);
    EXPECT_EQ(error.code(), ErrorCode::bad_input) << row.text;
    EXPECT_EQ(error.column, row.column) << row.text << '\n' << error.what() << '\n' << error.caret;
    EXPECT_THAT(error.what(), HasSubstr(row.says)) << row.text;
    EXPECT_THAT(error.what(),
                HasSubstr("query:" + std::to_string(error.line) + ':' + std::to_string(row.column) + ": "));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
  }
}

TEST(Parse, SequencesAndRelationsInParenthesesAreSegments) {
  struct Row {
    const char* text;
    const char* normal;
  };
  const Row rows[] = {
      {"(gloss = A -> gloss = B) overlaps gloss = C", "(gloss = \"A\" -> gloss = \"B\") overlaps gloss = \"C\""},
      {"gloss = A -> (@ gloss = B)", "gloss = \"A\" -> @ gloss = \"B\""},
      {"gloss = A -> ((gloss = B ->[..1s] gloss = C))", "gloss = \"A\" -> gloss = \"B\" ->[..1000ms] gloss = \"C\""},
      {"(gloss = A overlaps gloss = B) -> gloss = C", "gloss = \"A\" overlaps gloss = \"B\" -> gloss = \"C\""},
      {"(gloss = A overlaps gloss = B) starts gloss = C",
       "(gloss = \"A\" overlaps gloss = \"B\") starts gloss = \"C\""},
      {"@(gloss = A -> gloss = B) & duration > 1s & begin < 2s",
       "@ (gloss = \"A\" -> gloss = \"B\") & duration > 1000ms & begin < 2000ms"},
      {"gloss = A during (gloss = B -> gloss = C) & end > 1s -> gloss = D",
       "gloss = \"A\" during (gloss = \"B\" -> gloss = \"C\") & end > 1000ms -> gloss = \"D\""},
      {"gloss = A during ((gloss = B -> gloss = C) overlaps phase = hold)",
       "gloss = \"A\" during ((gloss = \"B\" -> gloss = \"C\") overlaps phase = hold)"},
      {"((gloss = A -> gloss = B) & duration > 1s -> gloss = C) & duration < 9s",
       "((gloss = \"A\" -> gloss = \"B\") & duration > 1000ms -> gloss = \"C\") & duration < 9000ms"},
      {"!overlaps(gloss = A -> gloss = B) & gloss = C", "!overlaps(gloss = \"A\" -> gloss = \"B\") & gloss = \"C\""},
  };
  for (const Row& row : rows) {
    const PhaseQuery query = parse(row.text);
    EXPECT_EQ(to_string(query), row.normal);
    EXPECT_EQ(parse(row.normal), query) << row.normal;
  }
}

TEST(Parse, ANonConditionIsRejected) {
  struct Row {
    const char* text;
    const char* what;
  };
  const Row rows[] = {
      {"(gloss = A -> gloss = B) | gloss = C", "only & duration, begin and end"},
      {"(gloss = A -> gloss = B) & gloss = C", "only & duration, begin and end"},
      {"(gloss = A -> gloss = B) & begin(hand).x > 1", "movement of a whole sequence"},
      {"gloss = C & (gloss = A -> gloss = B)", "is a segment, not a condition"},
      {"!(gloss = A overlaps gloss = B)", "is a segment, not a condition"},
      {"child(gloss = A -> gloss = B)", "has no parent or children"},
      {"overlaps(gloss = A -> @ gloss = B)", "an @ inside a condition"},
      {"@ (gloss = A -> @ gloss = B)", "a second @"},
      {"overlaps(gloss = A -> gloss = $X) & gloss = $X", "join a variable"},
      {"gloss = A overlaps (gloss = B & like(\"r\"@1..2) -> gloss = C)",
       "like(…) must be in the part before a relation"},
      {"(gloss = A -> gloss = B", "close the parenthesis of column 1"},
      {"gloss = A -> (phase = hold -> phase = stroke)", "a sequence of a sign and a phase"},
  };
  for (const Row& row : rows) EXPECT_THAT(fault_in(row.text).what(), HasSubstr(row.what)) << row.text;
  std::string many = "gloss = A";
  for (int i = 0; i < 17; ++i) many += " & overlaps(gloss = B -> gloss = C)";
  EXPECT_THAT(fault_in(many).what(), HasSubstr("more than 16 sequences in relations"));
  EXPECT_THAT(fault_in("gloss = \xC3\x89 &\n (gloss = B").what(), HasSubstr("the parenthesis of line 2, column 2"));
}

TEST(Parse, TheCaretIsUnderTheFault) {
  EXPECT_EQ(fault_in("gloss = \xC3\x89T\xC3\x89 &\n phase = strok").caret, " phase = strok\n         ^");
  EXPECT_EQ(fault_in("gloss = \"\xC3\x89T\xC3\x89\" hand").caret,
            "gloss = \"\xC3\x89T\xC3\x89\" hand\n              ^");
  const std::string caret = fault_in("gloss = \"" + std::string(5'000, 'A') + "\" hand = left").caret;
  EXPECT_LT(caret.size(), 250U);
  EXPECT_THAT(caret, HasSubstr("hand = left\n"));
}

TEST(Parse, DeepNestingIsAnErrorNotAnOverflow) {
  EXPECT_NO_THROW(parse(std::string(150, '(') + "gloss = A" + std::string(150, ')')));
  for (const std::string& text : {std::string(60'000, '('), std::string(60'000, '!'), [] {
                                    std::string links;
                                    for (int i = 0; i < 6'000; ++i) links += "parent(";
                                    return links;
                                  }()}) {
    EXPECT_THAT(fault_in(text).what(), HasSubstr("more than 200 levels of nesting"));
  }
  EXPECT_THAT(fault_in(std::string(100'000, '(')).what(), HasSubstr("at most 65536"));
}

TEST(Parse, SizesAreBounded) {
  std::string places = "gloss = A";
  for (int i = 0; i < 64; ++i) places += " -> gloss = A";
  EXPECT_THAT(fault_in(places).what(), HasSubstr("more than 64 places"));
  std::string relations = "gloss = A";
  for (int i = 0; i < 65; ++i) relations += " overlaps gloss = A";
  EXPECT_THAT(fault_in(relations).what(), HasSubstr("more than 64 relations"));
  std::string regexes = "gloss =~ /a/";
  for (int i = 0; i < 64; ++i) regexes += " | gloss =~ /a/";
  EXPECT_THAT(fault_in(regexes).what(), HasSubstr("more than 64 regular expressions"));
  std::string tiers = "tier(\"0\") = a";
  for (int i = 1; i < 57; ++i) tiers += " & tier(\"" + std::to_string(i) + "\") = a";
  EXPECT_THAT(fault_in(tiers).what(), HasSubstr("57 tiers"));
}

RC_GTEST_PROP(Parse, EveryTreeParsesBackFromItsText, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const PhaseQuery query = random_query(random, true);
  const std::string text = to_string(query);
  RC_LOG() << text;
  RC_ASSERT(parse(text) == query);
}

RC_GTEST_PROP(Parse, AnyTextIsParsedOrRejectedWithAColumnInsideIt, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  std::string text = to_string(random_query(random, true));
  constexpr std::string_view kSpice = "()[]!&|@,\"/\\=~<>-.$ a1\n\xC3\xA9";
  for (int i = 0; i < 3; ++i) text.insert(random() % (text.size() + 1), 1, kSpice[random() % kSpice.size()]);
  RC_LOG() << text;
  try {
    const PhaseQuery query = parse(text);
    RC_ASSERT(parse(to_string(query)) == query);
  } catch (const SyntaxError& error) {
    RC_ASSERT(error.column >= 1U && error.column <= text.size() + 1);
    RC_ASSERT(error.caret.size() > error.caret.find('\n') + 1);
  }
}

}  // namespace
}  // namespace signweave
