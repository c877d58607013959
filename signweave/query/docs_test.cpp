#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/find.h"
#include "signweave/query/movement_for_tests.h"
#include "signweave/query/parse.h"
#include "signweave/query/plan.h"

namespace signweave {
namespace {

/// The lines of the blocks that begin with ```KIND in docs/query.md.
std::vector<std::string> documented(const std::string& kind) {
  std::ifstream file(SIGNWEAVE_SOURCE_DIR "/docs/query.md");
  std::vector<std::string> result;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```")) {
      inside = line == "```" + kind;
    } else if (inside && !line.empty()) {
      result.push_back(line);
    }
  }
  return result;
}

TEST(Documentation, EveryExampleHasAnAnswer) {
  const std::vector<std::string> queries = documented("query");
  ASSERT_GE(queries.size(), 30U);
  const Segments table = weather_corpus().table();
  const std::unique_ptr<TestMovement> movement = weather_movement(table);
  for (const std::string& text : queries) {
    try {
      const PhaseQuery query = parse(text);
      EXPECT_FALSE(find(query, table, {}, movement.get()).empty()) << text;
      EXPECT_TRUE(hints(query, table).empty()) << text;
      EXPECT_EQ(parse(to_string(query)), query) << text;
      EXPECT_FALSE(explain(query, table).empty()) << text;
    } catch (const QueryError& error) {
      ADD_FAILURE() << text << '\n' << error.what() << '\n' << error.caret;
    }
  }
}

TEST(Documentation, WhatItCallsNotYetIsRefused) {
  const std::vector<std::string> queries = documented("query-later");
  ASSERT_GE(queries.size(), 1U);
  for (const std::string& text : queries) {
    try {
      parse(text);
      ADD_FAILURE() << text;
    } catch (const QueryError& error) {
      EXPECT_EQ(error.code(), ErrorCode::unsupported) << text;
    }
  }
}

}  // namespace
}  // namespace signweave
