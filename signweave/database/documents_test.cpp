#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/core/atomic_file.h"
#include "signweave/database/check.h"
#include "signweave/database/import.h"
#include "signweave/database/test_recording.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/query/parse.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/test_documents.h"

namespace signweave {
namespace {

using namespace testing_database;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr DocumentStorage kStorages[] = {DocumentStorage::document, DocumentStorage::node};

Recording annotated_recording(const std::string& name, const AnnotationDocument& document) {
  Recording recording{.name = name};
  recording.annotation = AnnotationPart{.document = document, .tiers = guess_tier_names(document)};
  return recording;
}

class DocumentStorageTest : public testing::TestWithParam<std::string> {
 protected:
  std::filesystem::path make(DocumentStorage storage) {
    std::filesystem::path path = folder_ / std::string(name_of(storage));
    Database::create(path, {.engine = GetParam(), .access_mode = {}, .documents = storage});
    return path;
  }
  TestFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Engines, DocumentStorageTest, testing::ValuesIn(kv::engines()),
                         [](const auto& row) { return row.param; });

std::uint64_t records_of(const Database& database, std::string_view kind) {
  for (const Usage& one : database.usage()) {
    if (one.kind == kind) return one.entries;
  }
  return 0;
}

TEST_P(DocumentStorageTest, ADatabaseStoresDocumentsAsItWasCreatedTo) {
  for (const DocumentStorage storage : kStorages) {
    Database database(make(storage), kv::Access::read_write);
    EXPECT_EQ(database.document_storage(), storage);
    database.put(small_recording("r", 1, {"A", "B"}));
    EXPECT_EQ(database.document_storage("r"), storage);
    EXPECT_EQ(records_of(database, "documents"), storage == DocumentStorage::node ? 1 + 3 + 8 + 1 : 1);
    EXPECT_EQ(database.document("r").tiers[0].annotations[1].label, "B");
    EXPECT_THAT(check(database).faults, IsEmpty());
    ASSERT_TRUE(database.annotation("r", "a5"));
    EXPECT_EQ(database.annotation("r", "a5")->tier, "Gloss");
    EXPECT_THAT(database.tier("r", "Phase"), SizeIs(6));
    EXPECT_FALSE(database.annotation("r", "a99"));
    EXPECT_THROW(database.annotation("s", "a1"), Error);
    database.remove("r");
    EXPECT_EQ(records_of(database, "documents"), 0U);
  }
}

TEST_P(DocumentStorageTest, RelayoutInBothDirectionsKeepsEveryByte) {
  Database database(make(DocumentStorage::document), kv::Access::read_write);
  database.put(small_recording("r", 1, {"A", "B"}));
  database.put(small_recording("s", 2, {"C"}));
  const AnnotationDocument before = database.document("r");
  const std::size_t entries = database.engine().entries;
  EXPECT_FALSE(database.relayout_document("r", DocumentStorage::document));
  EXPECT_TRUE(database.relayout_document("r", DocumentStorage::node));
  EXPECT_FALSE(database.relayout_document("r", DocumentStorage::node));
  EXPECT_EQ(database.document_storage("r"), DocumentStorage::node);
  EXPECT_EQ(database.document_storage("s"), DocumentStorage::document) << "side by side";
  EXPECT_EQ(database.document("r"), before);
  EXPECT_THAT(check(database).faults, IsEmpty());
  EXPECT_THAT(database.find(parse("gloss = \"A\"")), SizeIs(1));
  EXPECT_EQ(database.xpath(xpath::Expression("count(//ANNOTATION)")).at(0).value.value, "8");
  EXPECT_EQ(database.xpath(xpath::Expression("count(//ANNOTATION)")).at(1).value.value, "4");
  EXPECT_TRUE(database.relayout_document("r", DocumentStorage::document));
  EXPECT_EQ(database.document("r"), before);
  EXPECT_EQ(database.engine().entries, entries);
}

TEST_P(DocumentStorageTest, ReplacingADocumentLeavesNothingOfTheOld) {
  Database database(make(DocumentStorage::node), kv::Access::read_write);
  database.put(small_recording("r", 1, {"A", "B", "C"}));
  Recording other{.name = "r"};
  other.annotation = small_recording("r", 1, {"D"}).annotation;
  other.clock = {.frame_time = Seconds(0.01)};
  database.put(other);
  EXPECT_EQ(records_of(database, "documents"), 1 + 3 + 4 + 1);
}

TEST_P(DocumentStorageTest, APartIsReadFromItsOwnRecords) {
  const std::filesystem::path path = make(DocumentStorage::node);
  Database(path, kv::Access::read_write).put(small_recording("r", 1, {"A", "B"}));
  {
    // Every annotation but the second sign's ("a5", the fifth is a phase's) is damaged.
    const auto store = kv::open(path, kv::Access::read_write);
    std::vector<Bytes> keys;
    store->visit([&](ByteSpan key, std::size_t) {
      if (key.size() == 13 && static_cast<char>(key[0]) == 'A' && key[9] != std::byte{1}) {
        keys.emplace_back(key.begin(), key.end());
      }
    });
    ASSERT_THAT(keys, SizeIs(7));
    const auto transaction = store->write();
    for (const Bytes& key : keys) transaction->put(key, bytes_of("this is no sealed record"));
    transaction->commit();
  }
  const Database database(path, kv::Access::read_only);
  const auto values = [&](const char* expression) {
    std::vector<std::string> list;
    for (const XPathAnswer& one : database.xpath(xpath::Expression(expression))) list.push_back(one.value.value);
    return list;
  };
  EXPECT_THAT(values("//ALIGNABLE_ANNOTATION[@ANNOTATION_ID='a5']/ANNOTATION_VALUE"), ElementsAre("B"));
  EXPECT_EQ(database.annotation("r", "a5")->id, "a5");
  EXPECT_THROW(values("//TIER[@TIER_ID='Gloss']"), Error);
  EXPECT_THROW(values("//ANNOTATION_VALUE"), Error);
  EXPECT_THROW(database.document("r"), Error);
  EXPECT_THAT(check(database).faults, SizeIs(testing::Ge(1U)));
}

TEST_P(DocumentStorageTest, AnvilIsStoredVerbatimWithItsSpecification) {
  const std::filesystem::path file = std::filesystem::path(SIGNWEAVE_SOURCE_DIR) / "testdata/anvil/signs.anvil";
  const AnnotationDocument document = annotation_file::read(file).document;
  for (const DocumentStorage storage : kStorages) {
    Database database(make(storage), kv::Access::read_write);
    const ImportReport report = import_recording(database, pair_files({file}).jobs.at(0), {});
    EXPECT_EQ(report.outcome, ImportOutcome::added);
    EXPECT_EQ(report.signs, 2U) << "an element without a token is no sign";
    EXPECT_EQ(database.document("signs"), document);
    EXPECT_EQ(database.document("signs").source, read_file(file));
    EXPECT_THAT(database.find(parse("gloss = \"TOUS\"")), SizeIs(1));
    EXPECT_THAT(check(database).faults, IsEmpty());
    EXPECT_EQ(database.annotation("signs", "a11")->tier, "Hands.mouthing");
    EXPECT_EQ(database.tier("signs", "nod").at(1).id, "a13");
    EXPECT_EQ(database.xpath(xpath::Expression("//track[@name='nod']/el[2]/attribute")).at(0).value.value, "1");
    EXPECT_EQ(import_recording(database, pair_files({file}).jobs.at(0), {}).outcome, ImportOutcome::unchanged);
    EXPECT_TRUE(database.relayout_document("signs", storage == kStorages[0] ? DocumentStorage::node : kStorages[0]));
    EXPECT_EQ(database.document("signs"), document);
  }
}

TEST_P(DocumentStorageTest, AnOlderCatalogueStoresDocumentsWhole) {
  const std::filesystem::path path = make(DocumentStorage::document);
  EXPECT_EQ(Database(path, kv::Access::read_only).document_storage(), DocumentStorage::document);
  Database database(path, kv::Access::read_write);
  database.set_document_storage(DocumentStorage::node);
  EXPECT_EQ(database.document_storage(), DocumentStorage::node);
}

TEST_P(DocumentStorageTest, ADeadlineAndALimitAreObserved) {
  Database database(make(DocumentStorage::node), kv::Access::read_write);
  database.put(small_recording("r", 1, {"A", "B"}));
  database.put(small_recording("s", 1, {"A", "B"}));
  const xpath::Expression expression("//TIER[@TIER_ID='Gloss']//ANNOTATION_VALUE");
  EXPECT_THAT(database.xpath(expression), SizeIs(4));
  EXPECT_THAT(database.xpath(expression, {.limit = 3, .deadline = {}, .recordings = {}}), SizeIs(3));
  EXPECT_THAT(database.xpath(expression, {.limit = {}, .deadline = {}, .recordings = {"s"}}), SizeIs(2));
  EXPECT_THROW(database.xpath(expression, {.limit = {}, .deadline = {}, .recordings = {"t"}}), Error);
  EXPECT_THROW(
      database.xpath(expression, {.limit = {}, .deadline = std::chrono::steady_clock::now(), .recordings = {}}), Error);
}

std::string generated_expression() {
  using testing_documents::pick;
  const std::vector<std::string>& names = testing_documents::tier_names();
  const std::string& name = names[static_cast<std::size_t>(pick(static_cast<int>(names.size())))];
  const std::string quoted = name.find('\'') == std::string::npos ? "'" + name + "'" : "\"" + name + "\"";
  std::string head;
  switch (pick(6)) {
    case 0:
      head = "/ANNOTATION_DOCUMENT/TIER[@TIER_ID=" + quoted + "]";
      break;
    case 1:
      head = fmt::format("//ALIGNABLE_ANNOTATION[@ANNOTATION_ID='a{}']", pick(8));
      break;
    case 2:
      head = fmt::format("//REF_ANNOTATION[@ANNOTATION_ID='r{}']", pick(8));
      break;
    case 3:
      head = "//track[@name=" + quoted + "]";
      break;
    case 4:
      head = "//TIER";  // no part of the document is sufficient for it
      break;
    default:
      head = "//TIER[@TIER_ID=" + quoted + "]";
  }
  const std::vector<std::string> rest = {"",
                                         "//ANNOTATION_VALUE",
                                         "//ANNOTATION_VALUE/text()",
                                         "/@*",
                                         "/*[2]",
                                         "/*[last()]",
                                         "/ANNOTATION[position() > 1]//ANNOTATION_VALUE[. != '']",
                                         "//*[contains(., 'é')]",
                                         "[count(.//ANNOTATION_VALUE) > 1]",
                                         "/node()",
                                         "//comment()",
                                         "/el[@start > 1]/attribute",
                                         "/..",
                                         "/following-sibling::*[1]/@TIER_ID",
                                         "//ANNOTATION[count(//TIER) > 2]",
                                         "/descendant::*[@ANNOTATION_ID][1]",
                                         " | //ANNOTATION_VALUE",
                                         "[count(../*) > 2]",
                                         "[string-length(..) > 40]"};
  const std::string path = head + rest[static_cast<std::size_t>(pick(static_cast<int>(rest.size())))];
  const std::vector<std::string> around = {"", "", "", "count", "string", "boolean", "string-length"};
  const std::string& call = around[static_cast<std::size_t>(pick(static_cast<int>(around.size())))];
  return call.empty() ? path : call + "(" + path + ")";
}

RC_GTEST_PROP(DocumentStorageProperty, BothStoragesGiveTheSameAnswers, ()) {
  // One database for all runs: creating one takes longer than querying it.
  static const TestFolder folder;
  static Database* const database = [] {
    Database::create(folder / "db", {});
    return new Database(folder / "db", kv::Access::read_write);  // never deleted, since it must outlive the runs
  }();
  std::string text =
      testing_documents::pick(4) == 0 ? testing_documents::anvil_text(true) : testing_documents::eaf_text(true);
  AnnotationDocument document;
  try {
    document = annotation_file::read_text("generated", text).document;
  } catch (const Error& error) {
    RC_FAIL(error.what());
  }
  for (const DocumentStorage storage : kStorages) {
    database->set_document_storage(storage);
    database->put(annotated_recording(std::string(name_of(storage)), document));
    RC_ASSERT(database->document_storage(name_of(storage)) == storage);
    RC_ASSERT(database->document(name_of(storage)) == document);
  }
  for (int i = 0; i < 20; ++i) {
    const std::string expression = generated_expression();
    std::vector<std::vector<xpath::Value>> answers;
    for (const DocumentStorage storage : kStorages) {
      answers.emplace_back();
      for (XPathAnswer& one :
           database->xpath(xpath::Expression(expression),
                           {.limit = {}, .deadline = {}, .recordings = {std::string(name_of(storage))}})) {
        answers.back().push_back(std::move(one.value));
      }
    }
    if (answers[0] != answers[1]) RC_LOG() << expression << '\n' << text << '\n';
    RC_ASSERT(answers[0] == answers[1]);
  }
}

}  // namespace
}  // namespace signweave
