#include "signweave/nonmanual/expressions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "signweave/core/error.h"
#include "signweave/nonmanual/gaze.h"

namespace signweave {
namespace {

using testing::HasSubstr;

std::string fault_of(std::string_view text) {
  try {
    read_expressions_text("own.csv", text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Expressions, HaveUniqueNamesAndValidCurves) {
  std::set<std::string> names;
  for (const NamedExpression& one : built_in_expressions()) {
    EXPECT_TRUE(names.insert(one.curve.name).second) << one.curve.name;
    EXPECT_NO_THROW(check(one.curve, "built-in"));
    EXPECT_TRUE(!one.curve.weights.empty() || one.curve.head.moves()) << one.curve.name;
  }
}

TEST(Expressions, AreFoundByNameAndNearNamesAreOffered) {
  EXPECT_EQ(find_expression(built_in_expressions(), "q-wh").curve.name, "q-wh");
  try {
    find_expression(built_in_expressions(), "brow up");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_THAT(error.what(), HasSubstr("there is no expression 'brow up'; did you mean brows up"));
  }
}

TEST(Expressions, CoverTheSignsAsMeasured) {
  const NamedExpression& up = find_expression(built_in_expressions(), "brows up");
  EXPECT_EQ(over(up, {1000ms, 2000ms}).at, (TimeSpan{920ms, 2022ms}));
  EXPECT_EQ(over(up, {1000ms, 2000ms}, -50ms, 100ms).at, (TimeSpan{870ms, 2122ms}));
  EXPECT_EQ(over(up, {1000ms, 1010ms}).at.duration(), 360ms);
  const NamedExpression& blink = find_expression(built_in_expressions(), "blink");
  EXPECT_EQ(over(blink, {1000ms, 2000ms}).at, (TimeSpan{1920ms, 2150ms}));
}

TEST(ExpressionFile, AddsAndReplaces) {
  const Expressions all = read_expressions_text("own.csv",
                                                "name,what,value\n"
                                                "# ours\n"
                                                "doute,browDownLeft,0.5\r\n"
                                                "doute,head_roll,-7\n"
                                                "doute,head_hertz,1.5\n"
                                                "smile , mouthSmileLeft , 1\n\n"
                                                "doute,onset_ms,90\n"
                                                "doute,begin_ms,-200\n"
                                                "doute,merge,sum\n");
  const NamedExpression& doubt = find_expression(all, "doute");
  EXPECT_EQ(doubt.curve.weights, (std::vector<TrackWeight>{{"browDownLeft", 0.5f}}));
  EXPECT_EQ(doubt.curve.head.turn.roll, -7);
  EXPECT_EQ(doubt.curve.head.hertz, 1.5f);
  EXPECT_EQ(doubt.curve.onset, 90ms);
  EXPECT_EQ(doubt.begin, -200ms);
  EXPECT_EQ(doubt.end, kMarkerEnd);
  EXPECT_EQ(doubt.curve.merge, Merge::sum);
  EXPECT_EQ(find_expression(all, "smile").curve.weights, (std::vector<TrackWeight>{{"mouthSmileLeft", 1}}));
  EXPECT_EQ(all.size(), built_in_expressions().size() + 1);
}

TEST(ExpressionFile, EveryFaultNamesItsLine) {
  EXPECT_THAT(fault_of("a,browInnerUp,1\na,browInnerUp\n"), HasSubstr("own.csv:2: expected NAME,WHAT,VALUE"));
  EXPECT_THAT(fault_of("a,browInnerUp,1\n\na,browInnerUp,1,2"), HasSubstr("own.csv:3: expected"));
  EXPECT_THAT(fault_of("a,browInnerUp,much"), HasSubstr("own.csv:1: expected a number for browInnerUp, found 'much'"));
  EXPECT_THAT(fault_of("a,browInnerUp,nan"), HasSubstr("own.csv:1: non-manual 'a': browInnerUp is nan"));
  EXPECT_THAT(fault_of("a,browInnerUp,1.5"), HasSubstr("browInnerUp is 1.5; give one from 0 to 1"));
  EXPECT_THAT(fault_of("a,onset_m,1"),
              HasSubstr("own.csv:1: 'onset_m' is neither an ARKit name nor a setting; did you mean"));
  EXPECT_THAT(fault_of("a,onset_ms,1e300"), HasSubstr("own.csv:1: onset_ms is 1e+300; give milliseconds"));
  EXPECT_THAT(fault_of("a,onset_ms,-5"), HasSubstr("own.csv:1: non-manual 'a': the onset is -5 ms"));
  EXPECT_THAT(fault_of("a,merge,mix"), HasSubstr("give usual, maximum, sum or replace"));
  EXPECT_THAT(fault_of("a,at_end,2"), HasSubstr("at_end is 2"));
  EXPECT_THAT(fault_of(",browInnerUp,1"), HasSubstr("the name has 0 bytes"));
  EXPECT_THAT(fault_of("\xff,browInnerUp,1"), HasSubstr("not UTF-8"));
  EXPECT_THAT(fault_of("a,headYaw,1"), HasSubstr("not a weight of the face"));
  EXPECT_THAT(fault_of("a,jawOpen,1\na,jawOpen,1"), HasSubstr("own.csv:2: non-manual 'a': track jawOpen occurs twice"));
}

TEST(ExpressionFile, HasALimitedSize) {
  std::string many;
  for (int i = 0; i < 1001; ++i) many += std::to_string(i) + ",jawOpen,1\n";
  EXPECT_THAT(fault_of(many), HasSubstr("own.csv:1001: more than 1000 expressions"));
  EXPECT_THROW(read_expressions("/no/such/file.csv"), Error);
}

/// A table of values as docs/non-manuals.md prints it: "browInnerUp .8 · head yaw swing 8° at 2.5 Hz".
std::string printed(const Curve& curve) {
  std::ostringstream out;
  const char* dot = "";
  const auto add = [&](const std::string& text) {
    out << dot << text;
    dot = " · ";
  };
  const auto number = [](float value) {
    std::ostringstream text;
    text << value;
    return text.str();
  };
  for (std::size_t i = 0; i < curve.weights.size(); ++i) {
    const TrackWeight& one = curve.weights[i];
    std::string name = one.track;
    const bool pair = name.ends_with("Left") && i + 1 < curve.weights.size() &&
                      curve.weights[i + 1].weight == one.weight &&
                      curve.weights[i + 1].track == name.substr(0, name.size() - 4) + "Right";
    if (pair) {
      name.replace(name.size() - 4, 4, "L/R");
      ++i;
    }
    add(name + " " + number(one.weight));
  }
  const auto angles = [&](const HeadAngles& of, const std::string& kind) {
    const std::string at = kind.empty() ? "" : " at " + number(curve.head.hertz) + " Hz";
    if (of.pitch != 0) add("head pitch" + kind + " " + number(of.pitch) + "°" + at);
    if (of.yaw != 0) add("head yaw" + kind + " " + number(of.yaw) + "°" + at);
    if (of.roll != 0) add("head roll" + kind + " " + number(of.roll) + "°" + at);
  };
  angles(curve.head.turn, "");
  angles(curve.head.swing, " swing");
  return out.str();
}

TEST(Documentation, ListsEveryExpressionWithItsValues) {
  std::ifstream file(SIGNWEAVE_SOURCE_DIR "/docs/non-manuals.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const NamedExpression& one : built_in_expressions()) {
    EXPECT_THAT(text.str(), HasSubstr("| `" + one.curve.name + "` | " + printed(one.curve) + " |"));
  }
  for (const NamedGaze& one : named_gazes()) EXPECT_THAT(text.str(), HasSubstr("`" + std::string(one.name) + "`"));
}

TEST(Documentation, ListsEveryVisemeWithItsWeights) {
  constexpr const char* kNames[] = {"jawOpen",         "mouthPressL/R",     "mouthRollUpper", "mouthRollLower",
                                    "mouthUpperUpL/R", "mouthLowerDownL/R", "tongueOut",      "mouthStretchL/R",
                                    "mouthFunnel",     "mouthPucker",       "mouthSmileL/R"};
  std::ifstream file(SIGNWEAVE_SOURCE_DIR "/docs/non-manuals.md");
  std::stringstream text;
  text << file.rdbuf();
  for (std::size_t i = 1; i < kVisemeCount; ++i) {
    std::ostringstream row;
    const MouthWeights& shape = shape_of(static_cast<Viseme>(i));
    for (std::size_t k = 0; k < kMouthWeightCount; ++k) {
      if (shape[k] != 0) row << (row.str().empty() ? "" : " · ") << kNames[k] << ' ' << shape[k];
    }
    EXPECT_THAT(text.str(), testing::ContainsRegex("\n\\| " + std::string(name_of(static_cast<Viseme>(i))) +
                                                   " \\| [^|]+ \\| " + row.str() + " \\| "));
  }
}

TEST(Documentation, ItsFileOfExpressionsIsRead) {
  std::ifstream file(SIGNWEAVE_SOURCE_DIR "/docs/non-manuals.md");
  std::string csv;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```")) {
      inside = line == "```csv";
    } else if (inside) {
      csv += line + "\n";
    }
  }
  const Expressions all = read_expressions_text("docs/non-manuals.md", csv);
  EXPECT_EQ(find_expression(all, "doubt").curve.head.turn.roll, 6);
}

}  // namespace
}  // namespace signweave
