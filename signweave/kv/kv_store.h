#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/bytes.h"

namespace signweave::kv {

/// A snapshot of the store. Owns all bytes that `get` lends: a span is valid until the transaction ends. Belongs to one
/// thread at a time. Does not block writers, and is not blocked by them (with a hash engine, at most for the duration
/// of one single change).
class ReadTransaction {
 public:
  virtual ~ReadTransaction() = default;
  /// The value of a key, if any. Throws Error{corrupt} or Error{io}.
  virtual std::optional<ByteSpan> get(ByteSpan key) const = 0;
  /// The same for reading many values in turn: the span is valid until `buffer` is used again or the transaction ends.
  /// An engine that maps its file lends its own bytes until the transaction ends and does not touch the buffer; other
  /// engines fill it, so that nothing is allocated once it is large enough.
  virtual std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const = 0;
};

/// An atomic change: puts and erasures become visible and durable at `commit`; without it they have no effect. (A
/// commit that throws has no effect either, unless the disk fails in the very last step: then the whole change may have
/// been stored.) One at a time per store; a second one waits. Belongs to one thread.
class WriteTransaction : public ReadTransaction {
 public:
  /// Stores a value, replacing any present one. Throws Error{io}, also for a full disk.
  virtual void put(ByteSpan key, ByteSpan value) = 0;
  /// Removes a key; false if it was not present.
  virtual bool erase(ByteSpan key) = 0;
  /// Ends the transaction. Throws Error{io}, also for a full disk, and Error{corrupt}; then nothing was changed.
  virtual void commit() = 0;
};

struct EngineInfo {
  std::string name;  ///< "lmdb", "berkeley", "tokyo"
  std::string version;
  std::uint64_t entries = 0;
  std::uint64_t bytes_on_disk = 0;
  std::optional<std::uint64_t> bytes_free = {};  ///< the part of them that `compact` would free; empty if not known
};

/// One key-value database in one folder. Several threads may read while one writes. With LMDB several processes may,
/// too; a hash engine serves either one writing process or several that only read. There is no ordered scan, because
/// hash engines have none: anything that must be listed is a record of its own.
class KvStore {
 public:
  virtual ~KvStore() = default;
  virtual std::unique_ptr<ReadTransaction> read() const = 0;
  virtual std::unique_ptr<WriteTransaction> write() = 0;
  virtual EngineInfo info() const = 0;
  /// Calls `see` with the key and the value size of every entry, in no order, approximately as of now: only for
  /// reports. Throws Error{corrupt} or Error{io}.
  virtual void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const = 0;
  /// The length of the longest possible key in bytes.
  virtual std::size_t longest_key() const noexcept = 0;
};

enum class Access { read_only, read_write };

/// The names of the engines in this build, the default first.
std::vector<std::string> engines();

/// Creates an empty store of the named engine in `folder`, which must not exist or be empty. Throws
/// Error{already_exists}, Error{unsupported} for an engine that is unknown or not in this build, Error{io}.
void create(const std::filesystem::path& folder, std::string_view engine);

/// The size in bytes of a folder's files before and after `compact`.
struct Compacted {
  std::uint64_t before = 0, after = 0;
};

/// Rewrites the store's file without its free space, which returns to the disk. The file is replaced atomically: after
/// any failure it is the old or the new one. Needs as much disk space as the new file takes. `progress` gets the
/// completed fraction. Throws Error{conflict} if the store is open anywhere, even in this process; Error{not_found},
/// Error{unsupported}, Error{corrupt} and Error{io} as `open` does; Error{cancelled} or whatever else `progress`
/// throws.
Compacted compact(const std::filesystem::path& folder, const std::function<void(double fraction)>& progress = {});

/// Removes what a process left that was killed while it compacted. The caller must hold the store for writing.
void drop_unfinished(const std::filesystem::path& folder);

/// Opens a store; the engine is recognised by its files. Throws Error{not_found} if there is none, Error{unsupported}
/// if this build lacks its engine, Error{conflict} if another process has it open and the engine does not allow that,
/// Error{corrupt} if the files are shorter than their own records say, Error{io}.
std::unique_ptr<KvStore> open(const std::filesystem::path& folder, Access access);

}  // namespace signweave::kv
