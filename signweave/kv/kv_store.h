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

/// A snapshot of the store. Owns every byte that `get` lends: a span is valid until the transaction ends.
/// Belongs to one thread at a time. Does not block writers, and is not blocked by them (with a hash engine, for one
/// single change at most).
class ReadTransaction {
 public:
  virtual ~ReadTransaction() = default;
  /// The value of a key, or none. Throws Error{corrupt} or Error{io}.
  virtual std::optional<ByteSpan> get(ByteSpan key) const = 0;
  /// The same for many values one after another: the span is valid until `buffer` is used again or the transaction
  /// ends. An engine that maps its file lends its own bytes, until the transaction ends, and leaves the buffer alone;
  /// others fill it, so that nothing is allocated once it is large enough.
  virtual std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const = 0;
};

/// All or nothing: what is put and erased becomes visible, and durable, at `commit`; without it nothing happened.
/// (A commit that throws did not happen either, unless the disk failed in its very last step: then all of it may have.)
/// One at a time per store; a second waits. Belongs to one thread.
class WriteTransaction : public ReadTransaction {
 public:
  /// Stores a value (replacing one that is there). Throws Error{io}, for a full disk too.
  virtual void put(ByteSpan key, ByteSpan value) = 0;
  /// Removes a key; false where it was not there.
  virtual bool erase(ByteSpan key) = 0;
  /// Throws Error{io}, for a full disk too, and Error{corrupt}; then nothing happened. The transaction is over.
  virtual void commit() = 0;
};

struct EngineInfo {
  std::string name;  ///< "lmdb", "berkeley", "tokyo"
  std::string version;
  std::uint64_t entries = 0;
  std::uint64_t bytes_on_disk = 0;
  std::optional<std::uint64_t> bytes_free = {};  ///< of those: what `compact` would give back; none: not known
};

/// One key-value database in one folder. Several threads may read at once while one writes. With LMDB several
/// processes may, too; the hash engines serve one process that writes, or several that only read.
/// There is no ordered scan: hash engines have none, so what must be listed is a record of its own.
class KvStore {
 public:
  virtual ~KvStore() = default;
  virtual std::unique_ptr<ReadTransaction> read() const = 0;
  virtual std::unique_ptr<WriteTransaction> write() = 0;
  virtual EngineInfo info() const = 0;
  /// Calls `see` for every entry with its key and the size of its value, in no order, as they are at about this moment:
  /// for reports. Nothing in the program depends on it. Throws Error{corrupt} or Error{io}.
  virtual void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const = 0;
  /// Longest key in bytes.
  virtual std::size_t longest_key() const noexcept = 0;
};

enum class Access { read_only, read_write };

/// The names of the engines that this build has, the default first.
std::vector<std::string> engines();

/// Makes an empty store of the named engine in `folder`, which must not exist or be empty.
/// Throws Error{already_exists}, Error{unsupported} for an engine that is unknown or left out of this build, Error{io}.
void create(const std::filesystem::path& folder, std::string_view engine);

/// Writes the store's file anew without the space that is free in it, so that the disk has it back. The file is
/// replaced whole: whatever happens, it is the old one or the new. Needs as much room on the disk as the new one takes.
/// Throws Error{conflict} where anybody, in this process too, has the store open; Error{not_found}, Error{unsupported},
/// Error{corrupt} and Error{io} as `open`; Error{cancelled} or whatever `progress` throws, which is given what part is
/// done. Returns the bytes of the folder's files before and after.
struct Compacted {
  std::uint64_t before = 0, after = 0;
};
Compacted compact(const std::filesystem::path& folder, const std::function<void(double fraction)>& progress = {});

/// Removes what a process left that was killed while it compacted; for who holds the store for writing.
void drop_unfinished(const std::filesystem::path& folder);

/// Opens a store; the engine is recognised by its files. Throws Error{not_found} where there is none,
/// Error{unsupported} where this build lacks its engine, Error{conflict} where another process has it open and the
/// engine does not allow that, Error{corrupt} where the files are shorter than their own records say, Error{io}.
std::unique_ptr<KvStore> open(const std::filesystem::path& folder, Access access);

}  // namespace signweave::kv
