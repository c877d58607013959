#include "signweave/semantic_db/table_store.h"

#include <algorithm>
#include <limits>

#include "signweave/kv/sealed.h"
#include "signweave/semantic_db/keys.h"
#include "signweave/semantic_db/segment_bytes.h"

namespace signweave::semantic_db {
namespace {

/// A table is merged with the previous one if that has at most this many times its rows.
constexpr std::uint64_t kRatio = 4;
/// merge_tables does nothing if the other tables have less than this fraction of all rows.
constexpr std::uint64_t kSmallPart = 16;

/// With more than this, all tables are merged, so that the search need not skip removed recordings indefinitely.
constexpr std::size_t kMostTombstones = 64;

struct StoredTable {
  std::uint64_t generation = 0;
  std::uint32_t rows = 0;
};

/// The record under the key 'L': u8 version = 1 | u32 count, that many tables, the oldest first: u64 generation, u32
/// rows | u32 count, that many tombstones: u64 generation, text recording.
struct TableList {
  std::vector<StoredTable> tables;
  std::vector<Segments::Tombstone> tombstones;
};

constexpr std::uint8_t kListVersion = 1;
const std::string kWhereList = "list of segment tables";
const std::string kWhereTable = "segment table";

std::optional<TableList> read_list(const kv::ReadTransaction& snapshot) {
  const auto record = snapshot.get(key_of('L'));
  if (!record) return std::nullopt;
  ByteReader in(kv::unsealed(*record, kWhereList), kWhereList);
  if (in.number<std::uint8_t>() != kListVersion) in.fail("of a version that does not exist");
  TableList list;
  list.tables.resize(in.count(12));
  for (StoredTable& table : list.tables) {
    table.generation = in.number<std::uint64_t>();
    table.rows = in.number<std::uint32_t>();
  }
  list.tombstones.resize(in.count(12));
  for (Segments::Tombstone& tombstone : list.tombstones) {
    tombstone.generation = in.number<std::uint64_t>();
    tombstone.recording = in.text();
  }
  in.finish();
  return list;
}

TableList list_in(const kv::ReadTransaction& snapshot) {
  std::optional<TableList> list = read_list(snapshot);
  if (!list) ByteReader({}, kWhereList).fail("it is missing");
  return *std::move(list);
}

void write_list(kv::WriteTransaction& transaction, const TableList& list) {
  ByteWriter out;
  out.number(kListVersion);
  out.number(static_cast<std::uint32_t>(list.tables.size()));
  for (const StoredTable& table : list.tables) {
    out.number(table.generation);
    out.number(table.rows);
  }
  out.number(static_cast<std::uint32_t>(list.tombstones.size()));
  for (const Segments::Tombstone& tombstone : list.tombstones) {
    out.number(tombstone.generation);
    out.text(tombstone.recording);
  }
  transaction.put(key_of('L'), kv::sealed(out.bytes()));
}

StoredTable put_table(kv::WriteTransaction& transaction, const SegmentTable& table, std::uint64_t generation) {
  transaction.put(key_of('I', generation), kv::sealed(table.bytes()));
  return {generation, table.size()};
}

/// The result keeps the owner alive if the owner lends the bytes.
SegmentTable read_table(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                        const std::shared_ptr<const void>& owner) {
  const auto copied = std::make_shared<Bytes>();
  const auto record = snapshot.get(key_of('I', generation), *copied);
  if (!record) ByteReader({}, kWhereTable).fail("it is missing");
  const bool lent = copied->empty() || record->data() != copied->data();
  return TableBytes::open_sealed(*record, lent ? owner : copied, kWhereTable);
}

/// Marks a recording as out of date before `generation`. One tombstone per name is enough: the latest.
void bury(TableList& list, std::string_view recording, std::uint64_t generation) {
  std::erase_if(list.tombstones, [&](const Segments::Tombstone& one) { return one.recording == recording; });
  list.tombstones.push_back({std::string(recording), generation});
}

/// Merges the tables from `first` onwards into one, and drops the tombstones that no longer apply to any table.
void merge_from(kv::WriteTransaction& transaction, TableList& list, std::size_t first, const NextGeneration& next) {
  std::vector<Segments::Aged> tables;
  for (std::size_t i = first; i < list.tables.size(); ++i) {
    // Data read in a write transaction is valid until the next write.
    tables.push_back({read_table(transaction, list.tables[i].generation, {}), list.tables[i].generation});
  }
  const Segments all(std::move(tables), list.tombstones);
  std::vector<SegmentTable::RecordingRef> parts;
  for (std::uint32_t i = 0; i < all.recording_count(); ++i) parts.push_back(all.part(i));
  const SegmentTable merged = SegmentTable::merged(parts);
  for (std::size_t i = first; i < list.tables.size(); ++i) transaction.erase(key_of('I', list.tables[i].generation));
  list.tables.resize(first);
  list.tables.push_back(put_table(transaction, merged, next()));
  if (first == 0) list.tombstones.clear();
}

}  // namespace

void add_table(kv::WriteTransaction& transaction, const SegmentTable& table, std::span<const std::string> replaced,
               const NextGeneration& next) {
  TableList list = list_in(transaction);
  const std::uint64_t generation = next();
  for (const std::string& name : replaced) bury(list, name, generation);
  list.tables.push_back(put_table(transaction, table, generation));
  std::size_t first = list.tables.size() - 1;
  std::uint64_t rows = table.size();
  if (list.tombstones.size() > kMostTombstones) rows = std::numeric_limits<std::uint32_t>::max();  // all
  while (first > 0 && list.tables[first - 1].rows <= kRatio * rows) rows += list.tables[--first].rows;
  if (first + 1 < list.tables.size()) merge_from(transaction, list, first, next);
  write_list(transaction, list);
}

void remove_from_tables(kv::WriteTransaction& transaction, std::string_view recording, const NextGeneration& next) {
  TableList list = list_in(transaction);
  bury(list, recording, next());
  if (list.tombstones.size() > kMostTombstones) merge_from(transaction, list, 0, next);
  write_list(transaction, list);
}

bool merge_tables(kv::WriteTransaction& transaction, const NextGeneration& next) {
  TableList list = list_in(transaction);
  std::uint64_t rows = 0;
  for (const StoredTable& table : list.tables) rows += table.rows;
  if (list.tables.size() < 2 || kSmallPart * (rows - list.tables.front().rows) <= rows) return false;
  merge_from(transaction, list, 0, next);
  write_list(transaction, list);
  return true;
}

void replace_tables(kv::WriteTransaction& transaction, const SegmentTable& table, const NextGeneration& next) {
  TableList list;
  try {
    if (std::optional<TableList> stored = read_list(transaction)) list = *std::move(stored);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;  // a sweep removes the tables of a damaged list as unreferenced
  }
  for (const StoredTable& one : list.tables) transaction.erase(key_of('I', one.generation));
  list = {};
  if (table.size() > 0 || table.recording_count() > 0) list.tables.push_back(put_table(transaction, table, next()));
  write_list(transaction, list);
}

std::optional<Segments> read_tables(const std::shared_ptr<const kv::ReadTransaction>& snapshot) {
  const std::optional<TableList> list = read_list(*snapshot);
  if (!list) return std::nullopt;
  std::vector<Segments::Aged> tables;
  for (const StoredTable& table : list->tables) {
    tables.push_back({read_table(*snapshot, table.generation, snapshot), table.generation});
  }
  return Segments(std::move(tables), list->tombstones);
}

std::vector<std::uint64_t> table_generations(const kv::ReadTransaction& snapshot) {
  std::vector<std::uint64_t> generations;
  if (const std::optional<TableList> list = read_list(snapshot)) {
    for (const StoredTable& table : list->tables) generations.push_back(table.generation);
  }
  return generations;
}

}  // namespace signweave::semantic_db
