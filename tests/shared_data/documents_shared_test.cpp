#include <gtest/gtest.h>

#include <filesystem>

#include "signweave/core/atomic_file.h"
#include "signweave/kv/test_folder.h"
#include "signweave/semantic_db/documents.h"

/// Annotation files by other authors, stored split into their annotations.
namespace signweave {
namespace {

TEST(DocumentsShared, EveryFileIsSplitAndRestoredByteForByte) {
  const kv::TestFolder folder;
  kv::create(folder / "db", "lmdb");
  const auto store = kv::open(folder / "db", kv::Access::read_write);
  std::uint64_t generation = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SIGNWEAVE_SHARED_DATA)) {
    if (entry.path().extension() != ".eaf") continue;
    const std::string text = read_file(entry.path());
    const auto change = store->write();
    semantic_db::put_document(*change, ++generation, text, {}, DocumentStorage::node);
    change->commit();
    const auto snapshot = store->read();
    EXPECT_EQ(semantic_db::read_document(*snapshot, generation, "x"), text) << entry.path();
    EXPECT_EQ(semantic_db::fault_of_document(*snapshot, generation, "x"), "");
    const std::optional<std::string> around =
        semantic_db::read_excerpt(*snapshot, generation, semantic_db::ExcerptOf::tier, "no such tier", "x");
    ASSERT_TRUE(around) << entry.path() << ": a part of a real file was stored for the whole";
    EXPECT_LT(around->size(), 1000U);
    for (const std::string id : {"a1", "a2", "a3"}) {
      const std::optional<StoredAnnotation> found = semantic_db::read_annotation(*snapshot, generation, id, "x");
      if (!found) continue;  // not every file counts from 1
      EXPECT_NE(text.find(found->xml), std::string::npos);
      EXPECT_NE(found->xml.find("ANNOTATION_ID=\"" + id + "\""), std::string::npos);
    }
  }
  EXPECT_GE(generation, 30U);
}

}  // namespace
}  // namespace signweave
