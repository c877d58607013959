// Several tables behave as one, and reading stored tables returns what was put.
#include "signweave/semantic_db/segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "signweave/kv/test_folder.h"
#include "signweave/semantic_db/table_store.h"

namespace signweave {
namespace {

using ::testing::ElementsAre;

/// Signs of a few glosses on one tier, some with a phase; the same number gives the same signs.
SegmentChunk signs(unsigned number) {
  SegmentChunk chunk{.tiers = {"Phase", "Gloss"}, .labels = {"s", "A", "B", "C", " A "}, .rows = {}};
  const unsigned count = number % 7;
  for (unsigned i = 0; i < count; ++i) {
    const Milliseconds begin(700 * i + 13 * (number % 11));
    chunk.rows.push_back({.kind = RowKind::phase,
                          .phase = PhaseKind::stroke,
                          .tier = 0,
                          .span = {begin, begin + 300ms},
                          .parent = count + i});
  }
  for (unsigned i = 0; i < count; ++i) {
    const Milliseconds begin(700 * i + 13 * (number % 11));
    const std::uint32_t text = 1 + (number / 3 + i) % 4;
    chunk.rows.push_back({.kind = RowKind::sign,
                          .tier = 1,
                          .label = text == 4 ? 1 : text,
                          .text = text,
                          .span = {begin, begin + 400ms}});
  }
  return chunk;
}

SegmentTable table_of_chunks(const std::map<std::string, SegmentChunk>& chunks) {
  std::vector<SegmentTable::Source> sources;
  for (const auto& [name, chunk] : chunks) sources.push_back({name, &chunk});
  return SegmentTable(sources);
}

/// Everything that can be read of the segments, recording by recording.
std::vector<std::string> contents_of(const Segments& segments) {
  std::vector<std::string> lines;
  for (std::uint32_t recording = 0; recording < segments.recording_count(); ++recording) {
    lines.emplace_back(segments.recording_name(recording));
    EXPECT_EQ(segments.find_recording(lines.back()), recording);
    const SegmentTable::RowRange rows = segments.recording_rows(recording);
    for (RowId row = rows.begin; row < rows.end; ++row) {
      EXPECT_EQ(segments.recording(row), recording);
      std::string line;
      for (const std::string_view part : {segments.tier(row), segments.label(row), segments.text(row)}) {
        line += std::string(part) + "|";
      }
      for (const std::int64_t number :
           {static_cast<std::int64_t>(segments.kind(row)), segments.span(row).begin.count(),
            segments.span(row).end.count(),
            segments.parent(row) == kNoRow ? -1 : static_cast<std::int64_t>(segments.parent(row) - rows.begin)}) {
        line += std::to_string(number) + " ";
      }
      for (const RowId child : segments.children(row)) line += "c" + std::to_string(child - rows.begin);
      lines.push_back(line);
    }
  }
  for (const std::string& gloss : segments.glosses()) {
    std::string line = gloss;
    for (const RowId row : segments.signs_with(gloss)) {
      const std::uint32_t recording = segments.recording(row);
      line += " " + std::to_string(recording) + ":" + std::to_string(row - segments.recording_rows(recording).begin);
    }
    lines.push_back(line);
  }
  return lines;
}

RC_GTEST_PROP(Segments, OfManyTablesEqualThoseOfOne, ()) {
  std::map<std::string, SegmentChunk> now;
  const kv::TestFolder folder;
  kv::create(folder / "db", "lmdb");
  const std::unique_ptr<kv::KvStore> store = kv::open(folder / "db", kv::Access::read_write);
  std::uint64_t generation = 0;
  const auto next = [&] { return ++generation; };
  const auto change = [&](const auto& with) {
    const auto transaction = store->write();
    with(*transaction);
    transaction->commit();
  };
  change([&](kv::WriteTransaction& transaction) { semantic_db::replace_tables(transaction, SegmentTable(), next); });
  const int steps = *rc::gen::inRange(1, 30);
  for (int i = 0; i < steps; ++i) {
    const std::string name = "r" + std::to_string(*rc::gen::inRange(0, 12));
    const bool there = now.contains(name);
    if (there && *rc::gen::arbitrary<bool>()) {
      now.erase(name);
      change([&](kv::WriteTransaction& transaction) { semantic_db::remove_from_tables(transaction, name, next); });
    } else {
      now[name] = signs(*rc::gen::inRange(0U, 1000U));
      const SegmentTable one = table_of_chunks({{name, now[name]}});
      const std::vector<std::string> replaced(there ? 1 : 0, name);
      change([&](kv::WriteTransaction& transaction) { semantic_db::add_table(transaction, one, replaced, next); });
    }
    const std::optional<Segments> stored = semantic_db::read_tables(store->read());
    RC_ASSERT(stored.has_value());
    RC_ASSERT(contents_of(*stored) == contents_of(table_of_chunks(now)));
    RC_ASSERT(stored->members().size() <= 6U);
  }
  change([&](kv::WriteTransaction& transaction) { semantic_db::merge_tables(transaction, next); });
  RC_ASSERT(contents_of(*semantic_db::read_tables(store->read())) == contents_of(table_of_chunks(now)));
}

TEST(Segments, DamagedTablesAreReportedAsSuch) {
  const kv::TestFolder folder;
  kv::create(folder / "db", "lmdb");
  const std::unique_ptr<kv::KvStore> store = kv::open(folder / "db", kv::Access::read_write);
  EXPECT_FALSE(semantic_db::read_tables(store->read()).has_value()) << "none yet";
  std::uint64_t generation = 0;
  const auto next = [&] { return ++generation; };
  auto transaction = store->write();
  semantic_db::replace_tables(*transaction, table_of_chunks({{"a", signs(5)}}), next);
  transaction->commit();
  EXPECT_THAT(semantic_db::table_generations(*store->read()), ElementsAre(1U));
  transaction = store->write();
  ByteWriter key;
  key.number('I');
  key.number(std::uint64_t{1});
  const auto record = *transaction->get(key.bytes());
  Bytes damaged(record.begin(), record.end());
  damaged[40] ^= std::byte{1};
  transaction->put(key.bytes(), damaged);
  transaction->commit();
  EXPECT_THROW(semantic_db::read_tables(store->read()), Error);
  transaction = store->write();
  EXPECT_THROW(semantic_db::add_table(*transaction, table_of_chunks({{"b", signs(5)}}), {}, next), Error);
}

}  // namespace
}  // namespace signweave
