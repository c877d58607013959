#include "signweave/formats/eaf/times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/formats/eaf/test_support.h"

namespace signweave::eaf {
namespace {

using namespace testing_support;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::nullopt_t kOpen = std::nullopt;

TEST(EafTimes, UnalignedSlotsAreSpreadEvenlyInsideTheirParent) {
  const File file = read_text(
      "x", document({100, kOpen, kOpen, 200},
                    tier("A", "root", "", alignable("p", 1, 4)) +
                        tier("B", "fill", "A", alignable("a", 1, 2) + alignable("b", 2, 3) + alignable("c", 3, 4))));
  EXPECT_THAT(file.notices, IsEmpty());
  // 100 / 3, rounded down: the last part is the longest
  EXPECT_EQ(times(file.document, "B"), "a 100-133, b 133-166, c 166-200");
  EXPECT_FALSE(file.document.find_tier("B")->annotations[0].aligned);
  EXPECT_TRUE(file.document.find_tier("A")->annotations[0].aligned);
}

TEST(EafTimes, AnAlignedSlotDividesTheRun) {
  const File file = read_text(
      "x", document({100, kOpen, 180, kOpen, 200}, tier("A", "root", "", alignable("p", 1, 5)) +
                                                       tier("B", "fill", "A",
                                                            alignable("a", 1, 2) + alignable("b", 2, 3) +
                                                                alignable("c", 3, 4) + alignable("d", 4, 5))));
  EXPECT_EQ(times(file.document, "B"), "a 100-140, b 140-180, c 180-190, d 190-200");
}

TEST(EafTimes, SlotsOfOtherTiersBetweenDoNotCount) {
  // TIME_ORDER has all unaligned slots between 100 and 100; by their parents they lie between 100 and 400.
  const File file = read_text(
      "x", document({100, kOpen, kOpen, 100, 250, 400},
                    tier("A", "root", "", alignable("p", 1, 6)) +
                        tier("B", "fill", "A", alignable("a", 1, 2) + alignable("b", 2, 3) + alignable("c", 3, 6)) +
                        tier("X", "root", "", alignable("x", 4, 5))));
  EXPECT_EQ(times(file.document, "B"), "a 100-200, b 200-300, c 300-400");
}

TEST(EafTimes, ThreeTiersDeep) {
  const File file = read_text(
      "x", document({0, kOpen, kOpen, 1000},
                    tier("C", "fill", "B", alignable("x", 1, 2) + alignable("y", 2, 3) + alignable("z", 3, 4)) +
                        tier("B", "fill", "A", alignable("a", 1, 3) + alignable("b", 3, 4)) +
                        tier("A", "root", "", alignable("p", 1, 4))));
  EXPECT_EQ(times(file.document, "B"), "a 0-500, b 500-1000");
  EXPECT_EQ(parents(file.document, "C"), "x<a, y<a, z<b");
  EXPECT_EQ(times(file.document, "C"), "x 0-250, y 250-500, z 500-1000");
}

TEST(EafTimes, WithoutAParentTheNeighboursInTimeOrderCount) {
  const File file = read_text("x", document({100, kOpen, kOpen, 400, kOpen},
                                            tier("A", "root", "", alignable("a", 1, 2) + alignable("b", 3, 5))));
  EXPECT_EQ(times(file.document, "A"), "a 100-200, b 300-400");
  ASSERT_THAT(file.notices, SizeIs(1));
  EXPECT_EQ(file.notices[0].text,
            "tier 'A' has 3 unaligned slots outside any parent: spread between their neighbours in TIME_ORDER");
}

TEST(EafTimes, SlotsOutOfOrderAreSortedAsElanInsertsThem) {
  // The unaligned slots stay after ts1, after which they were written; ts4 at 50 comes before all others.
  const File file = read_text(
      "x", document({100, kOpen, 200, 50},
                    tier("A", "root", "", alignable("q", 4, 1) + alignable("p", 1, 3)) +
                        tier("B", "fill", "A", alignable("a", 1, 2) + alignable("b", 2, 3) + alignable("c", 4, 1))));
  EXPECT_EQ(times(file.document, "A"), "q 50-100, p 100-200");
  EXPECT_EQ(times(file.document, "B"), "c 50-100, a 100-150, b 150-200");
  EXPECT_EQ(parents(file.document, "B"), "c<q, a<p, b<p");
}

TEST(EafTimes, ASlotTooLateInTheFileCountsAtItsTime) {
  const File file = read_text("x", document({100, kOpen, 400, 200}, tier("A", "root", "", alignable("a", 1, 2)) +
                                                                        tier("B", "root", "", alignable("b", 4, 3))));
  EXPECT_EQ(times(file.document, "A"), "a 100-150");
}

TEST(EafTimes, SymbolicSubdivisionsShareTheirParentInChainOrder) {
  const File file = read_text(
      "x", document({100, 200}, tier("A", "root", "", alignable("p", 1, 2)) +
                                    tier("B", "divide", "A",
                                         reference("c", "p", "b") + reference("a", "p") + reference("b", "p", "a"))));
  EXPECT_THAT(file.notices, IsEmpty());
  EXPECT_EQ(times(file.document, "B"), "a 100-133, b 133-166, c 166-200");
}

TEST(EafTimes, WithoutAChainFileOrderCounts) {
  const File file =
      read_text("x", document({100, 200}, tier("A", "root", "", alignable("p", 1, 2)) +
                                              tier("B", "divide", "A", reference("b", "p") + reference("a", "p"))));
  EXPECT_EQ(times(file.document, "B"), "b 100-150, a 150-200");
}

TEST(EafTimes, ACycleOfPreviousAnnotationsIsANotice) {
  const File file =
      read_text("x", document({100, 200}, tier("A", "root", "", alignable("p", 1, 2)) +
                                              tier("B", "divide", "A",
                                                   reference("a", "p", "c") + reference("b", "p", "a") +
                                                       reference("c", "p", "b") + reference("d", "p", "d"))));
  EXPECT_EQ(times(file.document, "B"), "d 100-125, a 125-150, b 150-175, c 175-200");
  ASSERT_THAT(file.notices, SizeIs(1));
  EXPECT_THAT(file.notices[0].text, testing::HasSubstr("make no chain"));
}

TEST(EafTimes, MorePartsThanMillisecondsStayInOrder) {
  const File file = read_text(
      "x", document({100, 102}, tier("A", "root", "", alignable("p", 1, 2)) +
                                    tier("B", "divide", "A",
                                         reference("a", "p") + reference("b", "p", "a") + reference("c", "p", "b"))));
  EXPECT_EQ(times(file.document, "B"), "a 100-100, b 100-101, c 101-102");
}

TEST(EafTimes, SymbolicAssociationsTakeTheirParentsSpan) {
  const File file =
      read_text("x", document({100, 200, 300}, tier("A", "root", "", alignable("p", 1, 2) + alignable("q", 2, 3)) +
                                                   tier("C", "tag", "B", reference("x", "b")) +
                                                   tier("B", "tag", "A", reference("b", "q") + reference("a", "p"))));
  EXPECT_EQ(times(file.document, "B"), "a 100-200, b 200-300");
  EXPECT_EQ(times(file.document, "C"), "x 200-300");
}

TEST(EafTimes, AChildWithSlotsOfItsOwnBelongsToTheParentAroundIt) {
  const File file = read_text("x", document({0, 100, 100, 200, 100, 150, 40, 60},
                                            tier("A", "root", "", alignable("p", 1, 2) + alignable("q", 3, 4)) +
                                                tier("B", "within", "A", alignable("b", 5, 6) + alignable("a", 7, 8))));
  EXPECT_THAT(file.notices, IsEmpty());
  EXPECT_EQ(parents(file.document, "B"), "a<p, b<q");
}

TEST(EafTimes, AroundUnalignedParentsTheTimesOfAChildCountMoreThanTheOrderOfSlots) {
  const File file = read_text(
      "x", document({100, kOpen, kOpen, 220, 260, 400},
                    tier("A", "root", "", alignable("p", 1, 6)) +
                        tier("B", "fill", "A", alignable("a", 1, 2) + alignable("b", 2, 3) + alignable("c", 3, 6)) +
                        tier("C", "within", "B", alignable("x", 4, 5))));
  EXPECT_EQ(times(file.document, "B"), "a 100-200, b 200-300, c 300-400");
  EXPECT_EQ(parents(file.document, "C"), "x<b");
  EXPECT_THAT(file.notices, IsEmpty());
}

TEST(EafTimes, AChildThatReachesOutsideBelongsToTheParentWithMostOfIt) {
  const File file = read_text("x", document({0, 100, 100, 200, 80, 150, 300, 400},
                                            tier("A", "root", "", alignable("p", 1, 2) + alignable("q", 3, 4)) +
                                                tier("B", "within", "A", alignable("a", 5, 6) + alignable("b", 7, 8))));
  EXPECT_EQ(parents(file.document, "B"), "a<q, b<");
  ASSERT_THAT(file.notices, SizeIs(2));
  EXPECT_EQ(file.notices[0].text, "annotation 'a' reaches outside its parent 'q'");
  EXPECT_EQ(file.notices[1].text, "annotation 'b' lies in no annotation of the parent tier 'A'");
}

TEST(EafTimes, ManyAnnotationsAreReadQuickly) {
  constexpr int kCount = 60'000;
  std::vector<std::optional<int>> slots;
  std::string above;
  std::string below;
  for (int i = 0; i < kCount; ++i) {
    slots.insert(slots.end(), {5, kOpen, 5});  // all at one time, the worst case
    above += alignable(fmt::format("p{}", i), 3 * i + 1, 3 * i + 3);
    below +=
        alignable(fmt::format("a{}", i), 3 * i + 1, 3 * i + 2) + alignable(fmt::format("b{}", i), 3 * i + 2, 3 * i + 3);
  }
  const File file = read_text("x", document(slots, tier("A", "root", "", above) + tier("B", "fill", "A", below)));
  EXPECT_THAT(file.document.find_tier("B")->annotations, SizeIs(2 * kCount));
}

}  // namespace
}  // namespace signweave::eaf
