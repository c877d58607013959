#include "signweave/database/signer_dominance.h"

#include <gtest/gtest.h>

#include "signweave/database/test_signing.h"
#include "signweave/kv/test_folder.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

TEST(SignerDominance, ComesFromTheStoredStrokesAndTheTiersOfHands) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  const std::vector<std::string> glosses = {"A", "B", "C"};
  database.put(testing_database::recording_of("a", 3, glosses));
  Recording mirrored = testing_database::recording_of("b", 3, glosses);
  mirrored.motion->motion = in_mirror(mirrored.motion->motion);
  database.put(mirrored);
  Recording still = testing_database::small_recording("c", 1, {"A"});
  still.motion.reset();
  database.put(still);
  const Snapshot snapshot = database.snapshot();
  EXPECT_EQ(dominance_of(snapshot, 0).hand, Side::right);
  EXPECT_GT(dominance_of(snapshot, 0).score, 0.95f);
  EXPECT_GT(dominance_of(snapshot, 0).strokes, 0U);
  EXPECT_EQ(dominance_of(snapshot, 1).hand, Side::left);
  EXPECT_NEAR(dominance_of(snapshot, 1).score, -dominance_of(snapshot, 0).score, 1e-3f);
  EXPECT_EQ(dominance_of(snapshot, 2).hand, std::nullopt);
}

}  // namespace
}  // namespace signweave
