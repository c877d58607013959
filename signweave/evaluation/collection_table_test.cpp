#include "signweave/evaluation/collection_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/evaluation/folds.h"

namespace signweave {
namespace {

EvaluatedMotion named(std::string name, std::string collection, std::string performer = {}) {
  EvaluatedMotion one;
  one.name = std::move(name);
  one.collection = std::move(collection);
  one.performer = std::move(performer);
  return one;
}

std::vector<EvaluatedMotion> some() {
  return {named("in/a.bvh", "in"), named("in/b.bvh", "in", "Bo"), named("in/more/c.bvh", "more")};
}

std::vector<EvaluatedMotion> with(std::string_view text, std::vector<EvaluatedMotion> recordings = some(),
                                  std::vector<std::string> left_out = {}) {
  TextReader table("t.csv", text);
  read_collections(table, recordings, left_out);
  return recordings;
}

std::string fault_of(std::string_view text, std::vector<EvaluatedMotion> recordings = some(),
                     std::vector<std::string> left_out = {}) {
  try {
    with(text, std::move(recordings), std::move(left_out));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "none";
}

TEST(CollectionTable, AssignsCollectionAndSigner) {
  const std::vector<EvaluatedMotion> made = with("recording,collection,signer\nin/a.bvh, first , Ana\nc,more\n");
  EXPECT_EQ(made[0].collection, "first");
  EXPECT_EQ(made[0].performer, "Ana");
  EXPECT_EQ(made[1].collection, "in") << "has no row";
  EXPECT_EQ(made[1].performer, "Bo");
  EXPECT_EQ(made[2].collection, "more");
  EXPECT_EQ(made[2].performer, "");
}

TEST(CollectionTable, EmptyFieldsChangeNothing) {
  const std::vector<EvaluatedMotion> made = with("b.bvh,,\na,,Ana\n");
  EXPECT_EQ(made[1].collection, "in");
  EXPECT_EQ(made[1].performer, "Bo");
  EXPECT_EQ(made[0].collection, "in");
  EXPECT_EQ(made[0].performer, "Ana");
}

TEST(CollectionTable, RecordingsThatWereLeftOutMayHaveARow) {
  EXPECT_EQ(with("d,first\na,first\n", some(), {"in/d.bvh"})[0].collection, "first");
  EXPECT_EQ(fault_of("d,first\n"), "t.csv:1: no evaluated recording is named 'd'");
}

TEST(CollectionTable, ErrorsNameTheLineAndTheFix) {
  EXPECT_EQ(fault_of("a,x\n\nmore/d,x\n"), "t.csv:3: no evaluated recording is named 'more/d'");
  EXPECT_EQ(fault_of("c.bhv,x\n"),
            "t.csv:1: no evaluated recording is named 'c.bhv'; did you mean c.bvh, a.bvh or b.bvh?");
  EXPECT_EQ(fault_of("a\n"), "t.csv:1: 1 column; a row has recording, collection, and may have the signer");
  EXPECT_EQ(fault_of("a,b,c,d\n"), "t.csv:1: 4 columns; a row has recording, collection, and may have the signer");
  EXPECT_EQ(fault_of(",b\n"), "t.csv:1: no recording is named; the first column names one");
  EXPECT_EQ(fault_of("a,x\nb,x\nin/a.bvh,y\n"), "t.csv:3: 'in/a.bvh' has a row already, in line 1; remove one of them");
  EXPECT_EQ(fault_of("a,\"x\n"), "t.csv:1: a quote is opened and never closed; close it");
  EXPECT_EQ(fault_of("a,x\n", {named("in/a.bvh", ""), named("more/a.bvh", "")}),
            "t.csv:1: 'a' is the name of 2 recordings; give its folder too");
  EXPECT_EQ(fault_of("\n\n"), "t.csv: no row in it; a row has recording, collection, and may have the signer");
  EXPECT_EQ(fault_of("recording,collection,signer\n"),
            "t.csv: no row in it; a row has recording, collection, and may have the signer");
}

/// For any names: each recording has the collection of its row, and recordings of one signer are left out together.
RC_GTEST_PROP(CollectionTable, EveryRowIsApplied, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(1, 20);
  const auto quoted = [](const std::string& text) {
    std::string made = "\"";
    for (const char c : text) made += c == '"' ? std::string("\"\"") : std::string(1, c);
    return made + "\"";
  };
  const auto plain = rc::gen::suchThat(
      rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab ,\"'é-/9"))),
      [](const std::string& text) { return !text.empty() && text.front() != ' ' && text.back() != ' '; });
  std::vector<EvaluatedMotion> recordings;
  std::string text = "recording,collection,signer\n";
  std::vector<std::string> collections, signers;
  for (std::size_t i = 0; i < count; ++i) {
    recordings.push_back(named("in/r" + std::to_string(i) + "x.bvh", "in"));
    collections.push_back(*plain);
    signers.push_back(*rc::gen::elementOf(std::vector<std::string>{"", "Ana", "Bo"}));
    text += "r" + std::to_string(i) + "x," + quoted(collections.back()) + "," + signers.back() + "\n";
  }
  recordings = with(text, recordings);
  const Folds folds = folds_of(recordings);
  for (std::size_t i = 0; i < count; ++i) {
    RC_ASSERT(recordings[i].collection == collections[i]);
    RC_ASSERT(recordings[i].performer == signers[i]);
    for (std::size_t j = 0; j < i; ++j) {
      if (!signers[i].empty() && signers[i] == signers[j] && folds.by != "recording") {
        RC_ASSERT(folds.of[i] == folds.of[j]);
      }
    }
  }
}

}  // namespace
}  // namespace signweave
