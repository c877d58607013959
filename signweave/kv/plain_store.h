#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "signweave/core/bytes.h"
#include "signweave/kv/kv_store.h"

/// Inside this module only: what a hash engine must offer. It has no snapshots; VersionedStore makes them.
namespace signweave::kv {

/// An open store. Several threads may call the const functions at once; the others, one thread at a time. `get` and
/// `has` never run beside `put`, `erase`, `finish` and `abort`, but they do beside `begin` and `commit`. Throws
/// Error{corrupt, io}.
class PlainStore {
 public:
  /// Lets go of the files as they are, after a failure too.
  virtual ~PlainStore() = default;

  /// The value of a key, or none: a part of `buffer`, which grows where it is too small and never shrinks.
  virtual std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const = 0;
  virtual bool has(ByteSpan key) const = 0;
  virtual std::uint64_t entries() const = 0;
  /// Every entry, with the size of its value. One call at a time, and none beside a change.
  virtual void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const = 0;

  /// Begins a change of so many entries and bytes, keys and values together.
  virtual void begin(std::size_t entries, std::uint64_t bytes) = 0;
  virtual void put(ByteSpan key, ByteSpan value) = 0;
  /// Removes a key that is there.
  virtual void erase(ByteSpan key) = 0;
  /// Puts what the store keeps of itself, after the last of a change's entries.
  virtual void finish() {}
  /// Makes the change last, flushed to disk.
  virtual void commit() = 0;
  /// Undoes what was done since `begin`.
  virtual void abort() = 0;
  /// False after a failure that only opening the store anew can mend.
  virtual bool sound() const noexcept = 0;

  /// Brings everything into the main file, so that readers need no recovery. Nothing may be called after it.
  virtual void close() = 0;
};

/// Grows a buffer to at least `size`, generously: values of one kind have about one size.
inline void make_room(Bytes& buffer, std::size_t size) {
  if (buffer.size() < size) buffer.resize(size + size / 8);
}

struct PlainEngine {
  const char* name;
  const char* file;  ///< the main file
  const char* logs;  ///< how the names of the files begin that are of no use once the store was closed in order
  std::string (*version)();
  std::size_t longest_key;
  std::uint64_t largest_value;
  /// Makes an empty store in a folder that exists, and opens it for writing.
  std::unique_ptr<PlainStore> (*make)(const std::filesystem::path& folder);
  /// Opens a store. For writing: mends it first where it was not `closed` in order.
  std::unique_ptr<PlainStore> (*open)(const std::filesystem::path& folder, Access access, bool closed);
};

}  // namespace signweave::kv
