#include "signweave/formats/eaf/ids.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>
#include <vector>

namespace signweave::eaf {
namespace {

TEST(EafIds, IdsThatLookAlikeAreDifferent) {
  const std::vector<std::string> all = {"ts1",  "ts01", "ts10", "ts",          "1",
                                        "ts1 ", "TS1",  "a1",   "ts999999999", "ts99999999999999999999"};
  Ids ids;
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(ids.add(all[i], i)) << all[i];
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(ids.find(all[i]), i);
    EXPECT_FALSE(ids.add(all[i], 77)) << all[i];
    EXPECT_EQ(ids.find(all[i]), i) << "changed by a second one";
  }
  for (const char* other : {"ts2", "ts001", "", "ts1x", "t1", "ts999999998"})
    EXPECT_EQ(ids.find(other), Ids::kMissing) << other;
}

TEST(EafIds, AnyOrderAndNamesGiveTheSameAsAMap) {
  std::mt19937 random(3);
  for (const char* prefix : {"ts", "", "a-", "7b"}) {
    std::vector<std::string> names(2'000);
    for (std::string& name : names) name = prefix + std::to_string(random() % 3'000);
    std::map<std::string, std::size_t> expected;
    Ids ids;
    ids.reserve(random() % 400);
    for (std::size_t i = 0; i < names.size(); ++i)
      EXPECT_EQ(ids.add(names[i], i), expected.emplace(names[i], i).second);
    for (int i = 0; i < 3'000; ++i) {
      const std::string name = prefix + std::to_string(i);
      const auto found = expected.find(name);
      EXPECT_EQ(ids.find(name), found == expected.end() ? Ids::kMissing : found->second) << name;
    }
  }
}

}  // namespace
}  // namespace signweave::eaf
