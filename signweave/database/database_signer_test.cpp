#include <gtest/gtest.h>

#include "signweave/database/database.h"
#include "signweave/database/test_signing.h"
#include "signweave/kv/test_folder.h"
#include "signweave/retarget/mirroring.h"

namespace signweave {
namespace {

using testing_database::recording_of;

TEST(SnapshotTest, AMirroringIsMeasuredOnceUntilTheDatabaseChanges) {
  const kv::TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  database.put(recording_of("a", 3, {"A", "B"}));
  database.put(recording_of("b", 4, {"A", "B"}));
  const Snapshot before = database.snapshot();
  const RecordingInfo& a = before.contents().at("a");
  const std::shared_ptr<const Mirroring> mirroring = before.mirroring(a);
  EXPECT_EQ(database.snapshot().mirroring(a), mirroring);
  EXPECT_NE(before.mirroring(before.contents().at("b")), mirroring);
  const Motion motion = database.read("a");
  const Mirroring expected = mirroring_of(recorded_body("a", *before.motion(a)));
  EXPECT_TRUE(same_bits(mirrored(motion, *mirroring), mirrored(motion, expected)));

  database.put(recording_of("a", 5, {"A", "B"}));
  const Snapshot after = database.snapshot();
  EXPECT_NE(after.mirroring(after.contents().at("a")), mirroring);
  EXPECT_NE(before.mirroring(a), nullptr);  // an older state is measured again
}

}  // namespace
}  // namespace signweave
