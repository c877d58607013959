#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "signweave/core/syntax_error.h"
#include "signweave/xpath/evaluate.h"

namespace signweave::xpath {
namespace {

using semantic_db::ExcerptOf;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr std::string_view kDocument =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE x><!-- before -->\n"
    "<ANNOTATION_DOCUMENT xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
    "xsi:noNamespaceSchemaLocation=\"s\">\n"
    "<TIER TIER_ID=\"Gloss\"><ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a1\">"
    "<ANNOTATION_VALUE>ÉTÉ</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>"
    "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a2\"><ANNOTATION_VALUE>a<![CDATA[<b>]]>&amp;&lol;"
    "</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>\n"
    "<TIER TIER_ID=\"Tag\"/></ANNOTATION_DOCUMENT>\n";

std::vector<Value> all(const std::string& expression, std::string_view document = kDocument) {
  return evaluate(Expression(expression), "x", document);
}

std::vector<std::string> values(const std::string& expression) {
  std::vector<std::string> list;
  for (const Value& one : all(expression)) list.push_back(one.value);
  return list;
}

TEST(XPath, NodesAreInDocumentOrder) {
  EXPECT_THAT(values("//ANNOTATION_VALUE | //TIER/@TIER_ID"), ElementsAre("Gloss", "ÉTÉ", "a<b>&&lol;", "Tag"));
}

TEST(XPath, NodesAreReturnedAsXml) {
  const std::vector<Value> found =
      all("//ALIGNABLE_ANNOTATION[2 = count(../preceding-sibling::*) + 1]/ANNOTATION_VALUE");
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, Value::Kind::element);
  EXPECT_EQ(found[0].name, "ANNOTATION_VALUE");
  EXPECT_EQ(found[0].xml, "<ANNOTATION_VALUE>a&lt;b&gt;&amp;&amp;lol;</ANNOTATION_VALUE>");
}

TEST(XPath, AttributesTextsAndComments) {
  const std::vector<Value> attribute = all("//TIER[1]/@TIER_ID");
  EXPECT_EQ(attribute.at(0).xml, "TIER_ID=\"Gloss\"");
  EXPECT_EQ(attribute.at(0).kind, Value::Kind::attribute);
  EXPECT_EQ(all("/*/@xsi:noNamespaceSchemaLocation").at(0).name, "xsi:noNamespaceSchemaLocation");
  EXPECT_EQ(all("/comment()").at(0).xml, "<!-- before -->");
  EXPECT_THAT(all("//ANNOTATION_VALUE[contains(., 'lol')]/text()"), SizeIs(1)) << "neighbouring texts are one";
  EXPECT_EQ(all("/").at(0).kind, Value::Kind::document);
}

TEST(XPath, ValuesAreReturnedUnchanged) {
  EXPECT_EQ(all("count(//ANNOTATION)").at(0), (Value{Value::Kind::number, "", "2", "2"}));
  EXPECT_EQ(all("1 div 0").at(0).value, "Infinity");
  EXPECT_EQ(all("//TIER/@TIER_ID = 'Tag'").at(0), (Value{Value::Kind::boolean, "", "true", "true"}));
  EXPECT_EQ(all("concat('a', \"b\")").at(0), (Value{Value::Kind::string, "", "ab", "ab"}));
}

TEST(XPath, LettersAreCountedNotBytes) {
  EXPECT_EQ(values("string-length(//ANNOTATION_VALUE)"), std::vector<std::string>{"3"});
  EXPECT_EQ(values("translate(//ANNOTATION_VALUE, 'É', 'E')"), std::vector<std::string>{"ETE"});
  EXPECT_EQ(values("substring(//ANNOTATION_VALUE, 2, 1)"), std::vector<std::string>{"T"});
}

TEST(XPath, EntitiesAndFilesAreNotRead) {
  const std::string bomb =
      "<!DOCTYPE a [<!ENTITY b \"x\"><!ENTITY c \"&b;&b;\"><!ENTITY d SYSTEM \"file:///etc/passwd\">]>"
      "<a>&c;&d;</a>";
  EXPECT_EQ(all("string(/a)", bomb).at(0).value, "&c;&d;");
  EXPECT_THROW(Expression("document('/etc/passwd')"), SyntaxError) << "XSLT's, not XPath's";
}

TEST(XPath, LimitsAreRespected) {
  EXPECT_THAT(evaluate(Expression("//*"), "x", kDocument, {.limit = 3, .deadline = {}}), SizeIs(3));
}

TEST(XPath, ADeadlineStopsAnEndlessEvaluation) {
  std::string document = "<a>";
  for (int i = 0; i < 2000; ++i) document += fmt::format("<b c='{}'/>", i);
  document += "</a>";
  const Expression expression("count(//b[count(//b[count(//b[@c > 5]) > 7]) > 9])");
  const auto begin = std::chrono::steady_clock::now();
  try {
    evaluate(expression, "x", document, {.limit = {}, .deadline = begin + std::chrono::milliseconds(50)});
    FAIL() << "it ended";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

struct Wrong {
  const char* text;
  const char* what;
  std::size_t column;
};

class XPathWrong : public testing::TestWithParam<Wrong> {};

TEST_P(XPathWrong, IsReportedWithItsPosition) {
  try {
    all(GetParam().text);
    FAIL() << "was answered";
  } catch (const SyntaxError& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(std::string(error.what()), fmt::format("xpath:1:{}: {}", GetParam().column, GetParam().what));
    EXPECT_EQ(error.caret, fmt::format("{}\n{}^", GetParam().text, std::string(GetParam().column - 1, ' ')));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, XPathWrong,
    testing::Values(Wrong{"", "there is no expression; write one such as //ANNOTATION_VALUE", 1},
                    Wrong{"//TIER[@TIER_ID='Gloss]", "the text has no closing quote; end it with '", 17},
                    Wrong{"//TIER[1", "this '[' is not closed; add ']'", 7},
                    Wrong{"//TIER]", "there is no '[' that this closes; remove it", 7},
                    Wrong{"//TIER[1)", "there is no '(' that this closes; remove it", 9},
                    Wrong{"cuont(//TIER)", "there is no function 'cuont'; did you mean count?", 1},
                    Wrong{"//TIER/parents::*", "there is no axis 'parents'; did you mean parent?", 8},
                    Wrong{"//É and $x", "there are no variables; write the value itself", 9},
                    Wrong{"//TIER %", "'%' does not begin any XPath token; remove it", 8},
                    Wrong{"//TIER adn //X", "expected an operator or the end, found 'adn'; did you mean and?", 8}));

TEST(XPath, GrammarErrorsAreRejectedBeforeAnythingIsRead) {
  for (const char* text :
       {"//", "//TIER[", "//TIER[]", "1 +", "//@", "/..//[1]", "count()", "a::b", "//TIER/", "!", "()"}) {
    EXPECT_THROW(all(text), SyntaxError) << text;
  }
  for (const char* text : {"count('a')", "'a' | //TIER", "nothing:x", "string(1, 2)", "sum(1)"}) {
    EXPECT_THROW(all(text), SyntaxError) << text;
  }
}

TEST(XPath, NestingIsBounded) {
  for (const int depth : {10, 99, 100, 101, 10'000}) {
    const std::string text =
        std::string(static_cast<std::size_t>(depth), '(') + "1" + std::string(static_cast<std::size_t>(depth), ')');
    if (depth <= 100) {
      EXPECT_EQ(values(text), std::vector<std::string>{"1"}) << depth;
    } else {
      EXPECT_THROW(all(text), SyntaxError) << depth;
    }
  }
  std::string steps;
  for (int i = 0; i < 1500; ++i) steps += "/a";
  EXPECT_NO_THROW(all(steps));
  std::string minus(4000, '-');
  try {
    all(minus + "1");
  } catch (const SyntaxError&) {
  }
  EXPECT_THROW(all(std::string(100'000, ' ') + "1"), SyntaxError);
}

std::string excerpt(const std::string& text) {
  const Expression expression(text);
  if (!expression.excerpt()) return "whole";
  const ExcerptOf what = expression.excerpt()->what;
  return fmt::format("{} {}",
                     what == ExcerptOf::tier         ? "tier"
                     : what == ExcerptOf::annotation ? "annotation"
                                                     : "track",
                     expression.excerpt()->name);
}

TEST(XPath, RecognisesExpressionsOnOnePart) {
  EXPECT_EQ(excerpt("//TIER[@TIER_ID=\"Gloss\"]//ANNOTATION_VALUE"), "tier Gloss");
  EXPECT_EQ(excerpt("/ANNOTATION_DOCUMENT/TIER[@TIER_ID='Gloss']/ANNOTATION[3]/*/ANNOTATION_VALUE/text()"),
            "tier Gloss");
  EXPECT_EQ(excerpt("count(//TIER[@TIER_ID='Gloss']/ANNOTATION[.//ANNOTATION_VALUE = 'x' and position() > 1])"),
            "tier Gloss");
  EXPECT_EQ(excerpt("//ALIGNABLE_ANNOTATION[@ANNOTATION_ID=\"a12\"]"), "annotation a12");
  EXPECT_EQ(excerpt("//REF_ANNOTATION[@ANNOTATION_ID=\"a12\"]/@ANNOTATION_REF"), "annotation a12");
  EXPECT_EQ(excerpt("/annotation/body/track[@name='Hands.Gloss']/el/attribute[@name='token']"), "track Hands.Gloss");
  EXPECT_EQ(excerpt("//TIER[@TIER_ID='G']/descendant::ANNOTATION_VALUE[starts-with(., 'A')]"), "tier G");
}

TEST(XPath, APathOutOfAPartNeedsTheWhole) {
  for (const char* text : {"//TIER",
                           "//TIER[1][@TIER_ID='x']",
                           "//TIER[@TIER_ID='x']/..",
                           "//TIER[@TIER_ID='x']/parent::*",
                           "//TIER[@TIER_ID='x']/following-sibling::TIER",
                           "//TIER[@TIER_ID='x'] | //TIER[@TIER_ID='y']",
                           "//TIER[@TIER_ID='x']//ANNOTATION[//TIER]",
                           "//TIER[@TIER_ID='x']//ANNOTATION[. and /ANNOTATION_DOCUMENT]",
                           "//TIER[@TIER_ID='x']//ANNOTATION[id('a')]",
                           "//TIER[@TIER_ID='x']//ANNOTATION[lang('en')]",
                           "//TIER[@TIER_ID='x'] = //TIER",
                           "//TIER[@TIER_ID='x' or 1]",
                           "//TIER[@TIER_ID!='x']",
                           "//TIER[@TIER_ID='x']//ANNOTATION_VALUE + 1",
                           "count(//TIER[@TIER_ID='x']) + count(//TIER)",
                           "//TIER[@TIER_ID='x']/ANNOTATION[count(ancestor::*) > 2]",
                           "//TIER[@TIER_ID=//TIER[2]/@TIER_ID]",
                           "//TIER[@TIER_ID='x']/ANNOTATION[2 * //TIER]",
                           "//TIER[@TIER_ID='x'][../TIER[3]]",
                           "//TIER[@TIER_ID='x'][string-length(..) > 9]",
                           "//ALIGNABLE_ANNOTATION[@ANNOTATION_ID='a1'][count(../../*) > 2]"}) {
    EXPECT_EQ(excerpt(text), "whole") << text;
  }
}

}  // namespace
}  // namespace signweave::xpath
