#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segments.h"

/// The segment tables of a database as records. They duplicate the recordings' own segments (semantic_db.h) in
/// searchable form, and can be rebuilt from them.
///
/// A new or changed recording is added as a table of its own; when the last table is no longer much smaller than the
/// one before it, the two are merged (a log-structured merge, O'Neil et al. 1996). So there are few tables, adding has
/// logarithmic cost, and no table is changed in place.
namespace signweave::semantic_db {

/// Returns a number that no record of this database has ever had.
using NextGeneration = std::function<std::uint64_t()>;

/// Adds the table of new or changed recordings as part of the caller's transaction; `replaced` are those that existed
/// before. Throws Error{corrupt} if tables to be merged, or the list of tables, are damaged, and if there is no list.
void add_table(kv::WriteTransaction& transaction, const SegmentTable& table, std::span<const std::string> replaced,
               const NextGeneration& next);

/// Removes a recording. Throws as `add_table`.
void remove_from_tables(kv::WriteTransaction& transaction, std::string_view recording, const NextGeneration& next);

/// Merges all tables into one if the ones after the first have more than a sixteenth of the rows; returns false if
/// there is nothing to do. Throws as `add_table`.
bool merge_tables(kv::WriteTransaction& transaction, const NextGeneration& next);

/// Replaces all tables by one, whatever is stored.
void replace_tables(kv::WriteTransaction& transaction, const SegmentTable& table, const NextGeneration& next);

/// All tables; nullopt if there is no list of them (databases of an older layout have none). If the engine maps its
/// file, the tables are used in place and keep the snapshot alive. Throws Error{corrupt}.
std::optional<Segments> read_tables(const std::shared_ptr<const kv::ReadTransaction>& snapshot);

/// The generations of the listed tables. Throws Error{corrupt}.
std::vector<std::uint64_t> table_generations(const kv::ReadTransaction& snapshot);

}  // namespace signweave::semantic_db
