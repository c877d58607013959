#include "app/server/http_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace signweave::server {
namespace {

using ::testing::ElementsAre;

TEST(HttpTarget, IsDecodedSegmentBySegment) {
  const auto target = parse_target("/api/databases/d%C3%A9mo/query?text=gloss%20%3D+x&limit=3&limit=4#part");
  ASSERT_TRUE(target);
  EXPECT_THAT(target->path, ElementsAre("api", "databases", "démo", "query"));
  EXPECT_EQ(target->query.at("text"), "gloss = x");
  EXPECT_EQ(target->query.at("limit"), "4");
  EXPECT_EQ(parse_target("/a+b")->path.front(), "a+b") << "in a path a plus is itself";
}

TEST(HttpTarget, ANameMayHoldASlash) {
  EXPECT_THAT(parse_target("/api/day%201%2Fwalk/x")->path, ElementsAre("api", "day 1/walk", "x"));
}

TEST(HttpTarget, AFolderHasALastEmptySegment) {
  EXPECT_THAT(parse_target("/")->path, ElementsAre(""));
  EXPECT_THAT(parse_target("/?a=b")->path, ElementsAre(""));
  EXPECT_THAT(parse_target("/docs/")->path, ElementsAre("docs", ""));
  EXPECT_THAT(parse_target("//docs//x")->path, ElementsAre("docs", "x"));
}

TEST(HttpTarget, CharactersNotAllowedInNamesAreRefused) {
  for (const char* bad : {"", "x", "*", "http://evil/", "/%", "/%4", "/%zz", "/a%00b", "/?x=%", "/?%zz=1"}) {
    EXPECT_FALSE(parse_target(bad)) << bad;
  }
}

}  // namespace
}  // namespace signweave::server
