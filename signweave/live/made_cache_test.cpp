#include "signweave/live/made_cache.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

std::shared_ptr<const MadeTransition> made_of(std::int64_t frames) {
  const auto skeleton =
      std::make_shared<const Skeleton>(std::vector<Joint>{{"Hips", kNoJoint, {0, 0, 0}, true}}, std::vector<Tip>{});
  return std::make_shared<const MadeTransition>(MadeTransition{
      .cuts = {}, .standing = {}, .frames = std::make_shared<Motion>(skeleton, FrameRate{60, 1}, frames)});
}

TEST(TransitionCacheTest, ReturnsStoredTransitions) {
  TransitionCache cache(1 << 20);
  EXPECT_EQ(cache.find("a"), nullptr);
  const auto made = made_of(3);
  cache.keep("a", made);
  EXPECT_EQ(cache.find("a"), made);
  cache.keep("a", made_of(4));  // the first one is kept
  EXPECT_EQ(cache.find("a"), made);
  EXPECT_EQ(cache.counts().found, 2u);
  EXPECT_EQ(cache.counts().missed, 1u);
  cache.clear();
  EXPECT_EQ(cache.find("a"), nullptr);
  EXPECT_EQ(cache.counts().bytes, 0u);
}

TEST(TransitionCacheTest, RespectsItsLimitAndStaysUsefulWhenFull) {
  constexpr std::size_t kMost = 100'000;
  TransitionCache cache(kMost);
  cache.keep("huge", made_of(100'000));
  EXPECT_EQ(cache.find("huge"), nullptr);
  // A cycle one and a half times as long as the cache.
  const std::size_t each = 28 * 40 + sizeof(MadeTransition) + 8;
  const std::size_t cycle = kMost / each * 3 / 2;
  std::size_t found = 0;
  for (std::size_t i = 0; i < 10 * cycle; ++i) {
    const std::string key = std::to_string(i % cycle + 1000);
    if (cache.find(key) != nullptr) {
      ++found;
    } else {
      cache.keep(key, made_of(40));
    }
    ASSERT_LE(cache.counts().bytes, kMost);
  }
  EXPECT_GT(found, 3 * cycle);
}

}  // namespace
}  // namespace signweave
