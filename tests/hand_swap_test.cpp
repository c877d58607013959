// The right hand of a token in the place of that of another token of the same gloss, on the demo corpus.
#include "tests/hand_swap.h"

#include <gtest/gtest.h>

#include <iostream>

#include "signweave/database/test_recording.h"
#include "tests/demo_database.h"

namespace signweave::hand_swap {
namespace {

TEST(HandSwap, HandsStayInsideTheSpreadOfRepetitions) {
  const testing_database::TestFolder folder;
  const std::unique_ptr<const Database> database = demo_database(folder / "db", 10);
  const Figures figures = measure(*database, {"MATIN", "PLUIE", "VENT", "SOLEIL-BRILLER", "NORD", "DEMAIN"}, 4);
  ASSERT_GE(figures.repetitions.size(), 20u);
  EXPECT_LT(figures.refused, figures.swapped.size() / 4);
  // How far a swapped hand is from the one that it replaces, against how far repetitions are from each other.
  const Distance spread = quantile(figures.repetitions, 0.5);
  const Distance widest = quantile(figures.repetitions, 1);
  const Distance swapped = quantile(figures.swapped, 0.5);
  const Distance farthest = quantile(figures.swapped, 1);
  EXPECT_LT(swapped.palm, 1.1f * spread.palm)
      << text_of(figures.swapped) << "; repetitions " << text_of(figures.repetitions);
  EXPECT_LT(swapped.tips, 1.1f * spread.tips);
  EXPECT_LE(farthest.palm, widest.palm + 1);
  EXPECT_LE(farthest.tips, widest.tips + 1);
  // The hand itself is the captured one.
  const Distance kept = quantile(figures.kept, 0.9);
  EXPECT_LT(kept.palm, 0.1f * spread.palm) << text_of(figures.kept);
  EXPECT_LT(kept.tips, 0.25f * spread.tips);
  RecordProperty("repetitions", text_of(figures.repetitions));
  RecordProperty("swapped", text_of(figures.swapped));
  RecordProperty("kept", text_of(figures.kept));
  std::cout << "repetitions: " << text_of(figures.repetitions) << "\nswapped: " << text_of(figures.swapped)
            << "\nkept: " << text_of(figures.kept) << "\nrefused: " << figures.refused << '\n';
}

}  // namespace
}  // namespace signweave::hand_swap
