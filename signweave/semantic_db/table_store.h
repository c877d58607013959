#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segments.h"

/// The segment tables of a database as records. They hold nothing that the recordings' own segments do not
/// (semantic_db.h): they are what is searched, and can be made anew.
///
/// A recording that comes or changes comes as a table of its own; where the last table is no longer much smaller than
/// the one before it, the two become one (a log-structured merge, O'Neil et al. 1996). So there are few tables, adding
/// costs the logarithm of what is there, and nothing is ever changed in its place.
namespace signweave::semantic_db {

/// Gives a number that no record of this database ever had.
using NextGeneration = std::function<std::uint64_t()>;

/// Adds the table of recordings that came or changed; `replaced` are those of them that were there before. As part of
/// the caller's transaction. Throws Error{corrupt} where tables to be merged, or their list, are damaged, and where
/// there is no list.
void add_table(kv::WriteTransaction& transaction, const SegmentTable& table, std::span<const std::string> replaced,
               const NextGeneration& next);

/// The recording is gone. Throws likewise.
void remove_from_tables(kv::WriteTransaction& transaction, std::string_view recording, const NextGeneration& next);

/// Makes one table of all, where the ones after the first have more than a sixteenth of the rows; false where nothing
/// is to be done. Throws likewise.
bool merge_tables(kv::WriteTransaction& transaction, const NextGeneration& next);

/// Puts one table instead of all, whatever is there.
void replace_tables(kv::WriteTransaction& transaction, const SegmentTable& table, const NextGeneration& next);

/// All tables; none where there is no list of them (no database of an older layout has one). Where the engine maps its
/// file the tables are used where they lie, and keep the snapshot alive. Throws Error{corrupt}.
std::optional<Segments> read_tables(const std::shared_ptr<const kv::ReadTransaction>& snapshot);

/// The generations of the tables that are listed. Throws Error{corrupt}.
std::vector<std::uint64_t> table_generations(const kv::ReadTransaction& snapshot);

}  // namespace signweave::semantic_db
