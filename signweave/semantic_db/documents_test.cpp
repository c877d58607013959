#include "signweave/semantic_db/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "signweave/kv/test_folder.h"
#include "signweave/semantic_db/document_cut.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/test_documents.h"

namespace signweave::semantic_db {
namespace {

using namespace testing_documents;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// A store with generation 1 in `document` storage and generation 2 in `node` storage.
class Both {
 public:
  explicit Both(const std::string& engine = "lmdb") {
    kv::create(folder_ / "db", engine);
    store_ = kv::open(folder_ / "db", kv::Access::read_write);
  }

  void put(std::string_view text, std::string_view specification = {}) {
    const auto transaction = store_->write();
    for (const std::uint64_t generation : {1U, 2U}) {
      erase(*transaction, generation);
      put_document(*transaction, generation, text, specification,
                   generation == 1 ? DocumentStorage::document : DocumentStorage::node);
    }
    transaction->commit();
  }

  kv::KvStore& store() { return *store_; }

  /// The number of records under a generation.
  std::size_t records(std::uint64_t generation) const {
    std::size_t count = 0;
    store_->visit([&](ByteSpan key, std::size_t) { count += generation_of(key) == generation ? 1 : 0; });
    return count;
  }

  /// Makes every record of generation 2 unreadable except those that `spare` selects.
  void break_all_but(const std::function<bool(char letter, std::uint32_t number)>& spare) {
    std::vector<Bytes> keys;
    store_->visit([&](ByteSpan key, std::size_t) { keys.emplace_back(key.begin(), key.end()); });
    const auto transaction = store_->write();
    for (const Bytes& key : keys) {
      if (generation_of(key) != std::uint64_t{2}) continue;
      ByteReader in(ByteSpan(key).subspan(9), "key");
      const std::uint32_t number = in.left() == 0 ? 0 : in.number<std::uint32_t>();
      if (!spare(static_cast<char>(key[0]), number)) transaction->put(key, bytes_of("broken record"));
    }
    transaction->commit();
  }

 private:
  kv::TestFolder folder_;
  std::unique_ptr<kv::KvStore> store_;
};

constexpr std::string_view kSmall =
    "<?xml version=\"1.0\"?>\n<ANNOTATION_DOCUMENT>\n<TIER TIER_ID=\"Gloss\">\n"
    "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a1\"/></ANNOTATION>\n"
    "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a2\"/></ANNOTATION>\n</TIER>\n"
    "<TIER TIER_ID=\"Tag\"><ANNOTATION><REF_ANNOTATION ANNOTATION_ID=\"a3\"/></ANNOTATION></TIER>\n"
    "</ANNOTATION_DOCUMENT>\n";

TEST(DocumentCut, FindsTiersAndAnnotations) {
  const Cut cut = cut_document(kSmall);
  ASSERT_THAT(cut.tiers, SizeIs(2));
  EXPECT_EQ(cut.tiers[0].name, "Gloss");
  EXPECT_EQ(cut.tiers[0].pieces, 2U);
  EXPECT_EQ(kSmall.substr(cut.tiers[1].begin, 21), "<TIER TIER_ID=\"Tag\"><");
  ASSERT_THAT(cut.pieces, SizeIs(3));
  EXPECT_EQ(cut.pieces[2].id, "a3");
  EXPECT_EQ(kSmall.substr(cut.pieces[1].begin, cut.pieces[1].end - cut.pieces[1].begin),
            "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a2\"/></ANNOTATION>");
  EXPECT_EQ(cut.around, "<ANNOTATION_DOCUMENT>");
  EXPECT_EQ(cut.closing, "</ANNOTATION_DOCUMENT>");
  EXPECT_TRUE(cut.exact);
}

TEST(DocumentCut, DuplicateOrMisplacedElementsAreNotExact) {
  const auto exact = [](std::string_view tiers) {
    return cut_document("<ANNOTATION_DOCUMENT>" + std::string(tiers) + "</ANNOTATION_DOCUMENT>").exact;
  };
  EXPECT_TRUE(exact("<TIER TIER_ID='x'/><TIER TIER_ID='y'/>"));
  EXPECT_FALSE(exact("<TIER TIER_ID='x'/><TIER TIER_ID='x'/>"));
  EXPECT_FALSE(exact("<TIER TIER_ID='x'/><OTHER><TIER TIER_ID='y'/></OTHER>"));
  EXPECT_FALSE(exact("<TIER TIER_ID='x'><TIER TIER_ID='y'/></TIER>"));
  EXPECT_FALSE(exact("<OTHER><REF_ANNOTATION ANNOTATION_ID='a1'/></OTHER>"));
  EXPECT_FALSE(
      exact("<TIER TIER_ID='x'><ANNOTATION><REF_ANNOTATION ANNOTATION_ID='a'/></ANNOTATION>"
            "<ANNOTATION><REF_ANNOTATION ANNOTATION_ID='a'/></ANNOTATION></TIER>"));
}

TEST(DocumentCut, AnUnknownTextIsNotCut) {
  EXPECT_THAT(cut_document("").tiers, IsEmpty());
  EXPECT_THAT(cut_document("<other><TIER TIER_ID='x'/></other>").tiers, IsEmpty());
  EXPECT_THAT(cut_document("<ANNOTATION_DOCUMENT><TIER TIER_ID='x'>").tiers, IsEmpty());
  EXPECT_THAT(cut_document("<!DOCTYPE a [<!ENTITY b 'c'>]><ANNOTATION_DOCUMENT><TIER TIER_ID='x'/>"
                           "</ANNOTATION_DOCUMENT>")
                  .tiers,
              IsEmpty());
  EXPECT_THAT(cut_document(std::string("<\0A\0>\0", 6)).tiers, IsEmpty());
}

TEST(DocumentCut, NamesAreParsedAsTheReaderParsesThem) {
  const Cut cut = cut_document(
      "<ANNOTATION_DOCUMENT><TIER X='TIER_ID=\"no\"' TIER_ID = 'a &lt;&#x41;\n&apos;'/>"
      "</ANNOTATION_DOCUMENT>");
  ASSERT_THAT(cut.tiers, SizeIs(1));
  EXPECT_EQ(cut.tiers[0].name, "a <A '");
}

class DocumentsTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Engines, DocumentsTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

TEST_P(DocumentsTest, BothStoragesReturnTheBytes) {
  Both both(GetParam());
  both.put(kSmall, "<annotation-spec/>");
  const auto snapshot = both.store().read();
  EXPECT_EQ(storage_of(*snapshot, 1), DocumentStorage::document);
  EXPECT_EQ(storage_of(*snapshot, 2), DocumentStorage::node);
  for (const std::uint64_t generation : {1U, 2U}) {
    EXPECT_EQ(read_document(*snapshot, generation, "r"), kSmall);
    EXPECT_EQ(read_specification(*snapshot, generation, "r"), "<annotation-spec/>");
    EXPECT_EQ(fault_of_document(*snapshot, generation, "r"), "");
  }
  EXPECT_EQ(both.records(1), 2U);
  EXPECT_EQ(both.records(2), 9U) << "directory, frames of the whole and two tiers, 3 annotations, index, specification";
}

TEST_P(DocumentsTest, ErasingLeavesNothing) {
  Both both(GetParam());
  both.put(kSmall, "s");
  for (int twice = 0; twice < 2; ++twice) {
    const auto transaction = both.store().write();
    erase_document(*transaction, 1);
    erase_document(*transaction, 2);
    transaction->commit();
  }
  EXPECT_EQ(both.records(1) + both.records(2), 0U);
}

TEST_P(DocumentsTest, OneAnnotationIsReadWithoutTheOthers) {
  Both both(GetParam());
  both.put(kSmall);
  both.break_all_but([](char letter, std::uint32_t number) {
    return letter == 'N' || letter == 'B' || (letter == 'A' && number == 1);
  });
  const auto snapshot = both.store().read();
  const std::optional<StoredAnnotation> found = read_annotation(*snapshot, 2, "a2", "r");
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, (StoredAnnotation{"Gloss", "a2",
                                      "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a2\"/>"
                                      "</ANNOTATION>"}));
  EXPECT_EQ(found, read_annotation(*snapshot, 1, "a2", "r"));
  EXPECT_THROW(read_annotation(*snapshot, 2, "a1", "r"), Error) << "its record is broken";
  EXPECT_FALSE(read_annotation(*snapshot, 2, "a9", "r"));
  EXPECT_FALSE(read_annotation(*snapshot, 1, "a9", "r"));
}

TEST_P(DocumentsTest, OneTierIsReadWithoutTheOthers) {
  Both both(GetParam());
  both.put(kSmall);
  both.break_all_but([](char letter, std::uint32_t number) {
    return letter == 'N' || (letter == 'T' && number == 2) || (letter == 'A' && number == 2);
  });
  const auto snapshot = both.store().read();
  EXPECT_EQ(read_tier(*snapshot, 2, "Tag", "r"), read_tier(*snapshot, 1, "Tag", "r"));
  EXPECT_THAT(read_tier(*snapshot, 2, "Tag", "r"), SizeIs(1));
  EXPECT_THROW(read_tier(*snapshot, 2, "Gloss", "r"), Error);
  EXPECT_THROW(read_document(*snapshot, 2, "r"), Error);
}

TEST(Documents, ExcerptsContainTheRequestedElements) {
  Both both;
  both.put(kSmall);
  const auto snapshot = both.store().read();
  EXPECT_EQ(read_excerpt(*snapshot, 2, ExcerptOf::annotation, "a3", "r"),
            "<ANNOTATION_DOCUMENT><TIER TIER_ID=\"Tag\"><ANNOTATION><REF_ANNOTATION ANNOTATION_ID=\"a3\"/></ANNOTATION>"
            "</TIER></ANNOTATION_DOCUMENT>");
  EXPECT_EQ(read_excerpt(*snapshot, 2, ExcerptOf::tier, "nothing", "r"), "<ANNOTATION_DOCUMENT></ANNOTATION_DOCUMENT>");
  EXPECT_EQ(read_excerpt(*snapshot, 2, ExcerptOf::track, "Gloss", "r"), std::nullopt) << "of the other format";
  EXPECT_EQ(read_excerpt(*snapshot, 1, ExcerptOf::tier, "Gloss", "r"), std::nullopt) << "in one record";
}

TEST(Documents, ARecordThatDoesNotMatchTheDocumentIsFound) {
  Both both;
  both.put(kSmall);
  {
    // The third annotation is missing from the index, which reading the whole document would not reveal.
    const auto transaction = both.store().write();
    ByteWriter key;
    key.number('B');
    key.number(std::uint64_t{2});
    key.number(std::uint32_t{0});
    const Bytes empty;
    ByteWriter sealed;
    sealed.number(checksum(empty));
    transaction->put(key.bytes(), sealed.bytes());
    transaction->commit();
  }
  EXPECT_THAT(fault_of_document(*both.store().read(), 2, "meteo"),
              testing::StartsWith("meteo: the records of its annotations are not those of its document"));
}

RC_GTEST_PROP(DocumentsProperty, BothStoragesGiveTheSameBytesTiersAndAnnotations, ()) {
  static Both both;  // opening a store per document would be slow
  const std::string text = pick(3) == 0 ? anvil_text(true) : eaf_text(true);
  both.put(text);
  const auto snapshot = both.store().read();
  RC_ASSERT(read_document(*snapshot, 1, "r") == text);
  RC_ASSERT(read_document(*snapshot, 2, "r") == text);
  RC_ASSERT(fault_of_document(*snapshot, 2, "r").empty());
  const Cut cut = cut_document(text);
  std::size_t pieces = 0;
  for (const std::string& name : tier_names()) {
    const std::vector<StoredAnnotation> tier = read_tier(*snapshot, 2, name, "r");
    RC_ASSERT(tier == read_tier(*snapshot, 1, name, "r"));
    pieces += tier.size();
    for (const StoredAnnotation& one : tier) {
      if (!cut.exact) continue;  // of a duplicate id only one is found
      RC_ASSERT(read_annotation(*snapshot, 2, one.id, "r") == one);
      RC_ASSERT(read_annotation(*snapshot, 1, one.id, "r") == one);
    }
  }
  if (cut.exact) RC_ASSERT(pieces == cut.pieces.size());
}

RC_GTEST_PROP(DocumentsProperty, AnyBytesAreReturned, (const std::string& bytes)) {
  static Both both;
  const std::string text =
      pick(2) == 0 ? bytes : eaf_text(true).substr(0, static_cast<std::size_t>(pick(2000))) + bytes;
  both.put(text);
  const auto snapshot = both.store().read();
  RC_ASSERT(read_document(*snapshot, 2, "r") == text);
}

}  // namespace
}  // namespace signweave::semantic_db
