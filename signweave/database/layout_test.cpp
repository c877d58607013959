// Databases of earlier versions stay readable: testdata/databases has one for each released layout, engine and access
// mode.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <zlib.h>

#include <fstream>
#include <iterator>
#include <memory>

#include "signweave/database/check.h"
#include "signweave/database/test_recording.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/motion_db/quantise.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;

namespace fs = std::filesystem;

const fs::path kTestdata = fs::path(SIGNWEAVE_SOURCE_DIR) / "testdata";

/// Unpacks a .gz file into the same folder, without that extension, and removes it.
void unpack(const fs::path& packed) {
  const std::unique_ptr<gzFile_s, decltype(&gzclose)> from(gzopen(packed.c_str(), "rb"), gzclose);
  ASSERT_NE(from, nullptr) << packed;
  std::ofstream to(fs::path(packed).replace_extension(), std::ios::binary);
  std::vector<char> some(1 << 16);
  for (int n = 0; (n = gzread(from.get(), some.data(), static_cast<unsigned>(some.size()))) != 0;) {
    ASSERT_GT(n, 0) << packed;
    to.write(some.data(), n);
  }
  ASSERT_TRUE(to.flush()) << packed;
  fs::remove(packed);
}

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The content of each of them: one recording, built from three files of testdata.
struct Source {
  Motion motion = bvh::read(kTestdata / "bvh" / "signer.bvh").motion;
  std::string document = file_text(kTestdata / "eaf" / "french.eaf");
};

std::vector<fs::path> stored_databases() {
  std::vector<fs::path> list;
  for (const fs::directory_entry& layout : fs::directory_iterator(kTestdata / "databases")) {
    for (const fs::directory_entry& one : fs::directory_iterator(layout)) list.push_back(one.path());
  }
  std::ranges::sort(list);
  return list;
}

TEST(Layout, DatabasesOfEveryReleasedLayoutAreReadAndChanged) {
  const Source source;
  const std::vector<std::string> engines = kv::engines();
  std::size_t tried = 0;
  for (const fs::path& stored : stored_databases()) {
    SCOPED_TRACE(stored.string());
    const std::string name = stored.filename().string();
    const std::string engine = name.substr(0, name.find('_'));
    if (std::ranges::count(engines, engine) == 0) continue;  // built without it
    ++tried;
    TestFolder folder;
    fs::copy(stored, folder / "db");
    for (const fs::directory_entry& file :
         fs::directory_iterator(stored)) {  // some engines' files are mostly empty and stored compressed
      if (file.path().extension() != ".gz") continue;
      const fs::path packed = folder / "db" / file.path().filename();
      unpack(packed);
    }
    const auto expect_content = [&](const Database& database) {
      EXPECT_THAT(check(database).faults, ElementsAre());
      const Motion motion = database.read("signer");
      ASSERT_EQ(motion.frame_count(), 4);
      if (name.ends_with("_compact")) {  // rounded within 1 mm once, then read bit for bit
        EXPECT_LE(motion_db::largest_distance(motion, source.motion), 0.001);
        EXPECT_EQ(checksum(std::as_bytes(motion.rotations())), 17061407122888222734u);
      } else {
        EXPECT_TRUE(same_poses(motion, source.motion));
      }
      EXPECT_EQ(motion.tracks().size(), 7u);
      EXPECT_EQ(database.document("signer").source, source.document);
      EXPECT_EQ(database.find(parse("gloss = \"MÉTÉO\"")).size(), 1u);
      EXPECT_EQ(database.document_storage("signer"),
                name.ends_with("_node") ? DocumentStorage::node : DocumentStorage::document);
    };
    {
      const Database database(folder / "db", kv::Access::read_only);
      expect_content(database);
      EXPECT_EQ("layout_" + std::to_string(database.layout()), stored.parent_path().filename());
      const std::string mode = to_string(database.info("signer")->motion->mode);
      const std::string kind = name.substr(name.find('_') + 1);
      EXPECT_EQ(mode.substr(0, mode.find(':')), kind.substr(0, std::min(kind.find("_compact"), kind.find("_node"))));
      const bool has_tables = std::ranges::any_of(
          database.usage(), [](const Usage& usage) { return usage.kind == "segment tables" && usage.entries > 0; });
      EXPECT_EQ(has_tables, database.layout() >= 4) << "older layouts build them in memory";
    }
    {
      Database database(folder / "db", kv::Access::read_write);
      database.relayout("signer", {AccessMode{AccessMode::Kind::by_frame, 2}, {}});
      expect_content(database);
      database.put(small_recording("new", 1, {"A"}));
      EXPECT_EQ(database.contents()->recordings.size(), 2u);
      database.remove("new");
      EXPECT_EQ(database.layout(), kDatabaseLayout);
    }
    expect_content(Database(folder / "db", kv::Access::read_only));
  }
  EXPECT_GE(tried, 4u + 8u + 9u) << "those of LMDB at least";
}

}  // namespace
}  // namespace signweave
