#include "signweave/evaluation/folds.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

EvaluatedMotion recording(std::string collection, std::string performer) {
  EvaluatedMotion one;
  one.collection = std::move(collection);
  one.performer = std::move(performer);
  return one;
}

TEST(Folds, CollectionsAreLeftOutCompletely) {
  const std::vector<EvaluatedMotion> recordings = {recording("a", ""), recording("b", ""), recording("a", "")};
  const Folds folds = folds_of(recordings);
  EXPECT_EQ(folds.of, (std::vector<std::size_t>{0, 1, 0}));
  EXPECT_EQ(folds.count, 2u);
  EXPECT_EQ(folds.by, "collection");
}

TEST(Folds, APerformerIsLeftOutOfEveryCollection) {
  const std::vector<EvaluatedMotion> recordings = {recording("a", "Ana"), recording("b", "Bo"), recording("c", "Ana"),
                                                   recording("c", "Cy"), recording("b", "")};
  const Folds folds = folds_of(recordings);
  EXPECT_EQ(folds.of, (std::vector<std::size_t>{0, 1, 0, 0, 1}));
  EXPECT_EQ(folds.count, 2u);
}

TEST(Folds, CollectionsOfOnePerformerAreLeftOutByRecording) {
  const Folds folds = folds_of(std::vector{recording("a", "Ana"), recording("b", "Ana"), recording("b", "Ana")});
  EXPECT_EQ(folds.of, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(folds.by, "recording");
}

TEST(Folds, OneCollectionIsSplitBySeveralPerformers) {
  const Folds folds = folds_of(std::vector{recording("a", "Ana"), recording("a", "Bo"), recording("a", ""),
                                           recording("a", "Ana"), recording("a", "")});
  EXPECT_EQ(folds.of, (std::vector<std::size_t>{0, 1, 2, 0, 2})) << "unknown signers may be one person";
  EXPECT_EQ(folds.by, "signer");
}

TEST(Folds, OtherwiseByRecording) {
  const Folds folds = folds_of(std::vector{recording("a", "Ana"), recording("a", ""), recording("a", "Ana")});
  EXPECT_EQ(folds.of, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(folds.count, 3u);
  EXPECT_EQ(folds_of({}).count, 0u);
}

}  // namespace
}  // namespace signweave
