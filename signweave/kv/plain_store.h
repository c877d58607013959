#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "signweave/core/bytes.h"
#include "signweave/kv/kv_store.h"

/// Internal to this module: the interface of a hash engine. It has no snapshots; VersionedStore adds them.
namespace signweave::kv {

/// An open store. Several threads may call the const functions at once; the others, one thread at a time. `get` and
/// `has` never run concurrently with `put`, `erase`, `finish` and `abort`, but may with `begin` and `commit`. Throws
/// Error{corrupt, io}.
class PlainStore {
 public:
  /// Closes the files as they are, even after a failure.
  virtual ~PlainStore() = default;

  /// The value of a key, if any: a part of `buffer`, which grows if it is too small and never shrinks.
  virtual std::optional<ByteSpan> get(ByteSpan key, Bytes& buffer) const = 0;
  virtual bool has(ByteSpan key) const = 0;
  virtual std::uint64_t entries() const = 0;
  /// Visits every entry with the size of its value. One call at a time, and not during a change.
  virtual void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) const = 0;

  /// Begins a change of this many entries and bytes (keys and values together).
  virtual void begin(std::size_t entries, std::uint64_t bytes) = 0;
  virtual void put(ByteSpan key, ByteSpan value) = 0;
  /// Removes a key, which must be present.
  virtual void erase(ByteSpan key) = 0;
  /// Stores the store's own metadata, after the last entry of a change.
  virtual void finish() {}
  /// Makes the change durable by flushing it to disk.
  virtual void commit() = 0;
  /// Undoes everything since `begin`.
  virtual void abort() = 0;
  /// False after a failure that only reopening the store can repair.
  virtual bool sound() const noexcept = 0;

  /// Moves everything into the main file, so that readers need no recovery. No other function may be called afterwards.
  virtual void close() = 0;
};

/// Grows a buffer to at least `size`, with a margin: values of one kind have similar sizes.
inline void make_room(Bytes& buffer, std::size_t size) {
  if (buffer.size() < size) buffer.resize(size + size / 8);
}

struct PlainEngine {
  const char* name;
  const char* file;  ///< the main file
  const char* logs;  ///< prefix of files that are useless once the store was closed in order
  std::string (*version)();
  std::size_t longest_key;
  std::uint64_t largest_value;
  /// Creates an empty store in an existing folder and opens it for writing.
  std::unique_ptr<PlainStore> (*make)(const std::filesystem::path& folder);
  /// Opens a store. When opening for writing, repairs it first unless it was `closed` in order.
  std::unique_ptr<PlainStore> (*open)(const std::filesystem::path& folder, Access access, bool closed);
};

}  // namespace signweave::kv
