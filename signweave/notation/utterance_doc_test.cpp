#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"

namespace signweave {
namespace {

/// A line of a block of docs/utterance.md that is fenced as ```utterance.
struct DocumentedText {
  std::size_t line = 0;
  std::string text;
  std::string result;  ///< its canonical form, or its error
  std::set<std::string, std::less<>> glosses;
};

/// Lines are "TEXT → RESULT", or "TEXT" if that is its canonical form. The words behind the fence are glosses of a
/// database.
std::vector<DocumentedText> examples() {
  std::ifstream in(std::string(SIGNWEAVE_SOURCE_DIR) + "/docs/utterance.md");
  std::vector<DocumentedText> found;
  std::set<std::string, std::less<>> glosses;
  bool inside = false;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = line.starts_with("```utterance");
      glosses.clear();
      std::istringstream words(line);
      std::string word;
      for (words >> word; words >> word;) glosses.insert(word);
    } else if (inside) {
      const std::string arrow = " → ";
      const std::size_t at = line.find(arrow);
      const std::string text = line.substr(0, line.find_last_not_of(' ', at == line.npos ? at : at - 1) + 1);
      found.push_back({number, text, at == line.npos ? text : line.substr(at + arrow.size()), glosses});
    }
  }
  return found;
}

TEST(UtteranceDocument, EachExampleIsReadAsItSays) {
  EXPECT_GT(examples().size(), 30U);
  for (const DocumentedText& one : examples()) {
    const UtteranceWords words{.is_gloss = [&](std::string_view word) { return one.glosses.contains(word); },
                               .is_expression = {}};
    std::string result;
    try {
      result = to_string(parse_utterance(one.text, words));
    } catch (const Error& error) {
      result = error.what();
    }
    EXPECT_EQ(result, one.result) << "docs/utterance.md:" << one.line;
  }
}

TEST(UtteranceDocument, NamesEveryPartAndEveryFault) {
  std::ifstream in(std::string(SIGNWEAVE_SOURCE_DIR) + "/docs/utterance.md");
  std::stringstream text;
  text << in.rdbuf();
  for (const BodyPart part : kBodyParts) EXPECT_THAT(text.str(), testing::HasSubstr(std::string(name_of(part))));
  for (std::size_t i = 0; i < kUtteranceFaultKinds; ++i) {
    const std::string name(name_of(static_cast<UtteranceFault::Kind>(i)));
    EXPECT_THAT(text.str(), testing::HasSubstr("| `" + name + "` |"));
  }
}

}  // namespace
}  // namespace signweave
