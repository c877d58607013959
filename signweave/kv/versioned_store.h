#pragma once

#include <sys/types.h>

#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "signweave/kv/fair_lock.h"
#include "signweave/kv/kv_store.h"
#include "signweave/kv/old_values.h"
#include "signweave/kv/plain_store.h"
#include "signweave/kv/store_lock.h"

/// Inside this module only: snapshots and transactions over engines that have none that isolate a reader.
///
/// A transaction keeps its changes in memory until it commits; then they are applied one by one. Before each, the old
/// value goes to OldValues, where the snapshots that began before the change was durable find it. So a reader waits for
/// one single change at most, never for a whole transaction or for the disk.
namespace signweave::kv {

/// One change of a transaction: a value to put, or none to erase.
struct Change {
  std::string key;
  std::optional<Bytes> value;
};

/// A store that this process has open, shared by all who opened it.
/// More than fifteen members: each lock stands with what it guards.
class VersionedStore {
 public:
  static std::shared_ptr<VersionedStore> acquire(const std::filesystem::path& folder, Access access,
                                                 const PlainEngine& engine);
  ~VersionedStore();
  VersionedStore(const VersionedStore&) = delete;
  VersionedStore& operator=(const VersionedStore&) = delete;

  /// Begins and ends a snapshot: the number of the last change that it sees.
  std::uint64_t begin_snapshot();
  void end_snapshot(std::uint64_t snapshot) noexcept;

  /// The value in a snapshot, in a part of `buffer`.
  std::optional<ByteSpan> get(std::uint64_t snapshot, ByteSpan key, Bytes& buffer);
  /// For the writer only: nothing else can have changed since it began.
  bool has(ByteSpan key);

  /// The writer's turn: waits for another thread's, throws Error{conflict} where this thread has it.
  std::unique_lock<std::mutex> begin_write();
  void end_write() noexcept { writer_ = std::thread::id{}; }
  /// Makes the changes, no key twice, durable and visible. Throws Error{io, corrupt}; then nothing happened.
  void apply(const std::deque<Change>& changes);

  EngineInfo info();
  void visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see);

  const std::filesystem::path& folder() const noexcept { return folder_; }
  const PlainEngine& engine() const noexcept { return engine_; }
  /// Throws Error{bad_input} for a key that is empty or too long.
  void check_key(ByteSpan key) const;

 private:
  VersionedStore(std::filesystem::path folder, Access access, const PlainEngine& engine);
  void become_writable();
  const PlainStore& plain() const;
  void mark_closed() noexcept;
  void reopen() noexcept;
  void mend();
  void check_process() const;
  void publish(std::uint64_t number);
  void forget();

  const std::filesystem::path folder_;
  const PlainEngine& engine_;
  const pid_t process_;  ///< a store must not be used after a fork
  StoreLock lock_;

  // Locks are taken in the order in which they stand here.
  std::mutex writing_;  ///< held by the write transaction
  std::atomic<std::thread::id> writer_;
  std::mutex applying_;                ///< held while the engine's content, or the engine, changes
  FairLock access_;                    ///< shared by readers; taken for each single change
  OldValues old_;                      ///< guarded by access_
  std::unique_ptr<PlainStore> plain_;  ///< guarded by access_; null where it could not be opened again
  bool writable_ = false;              ///< guarded by applying_
  std::string why_closed_;             ///< guarded by access_
  std::mutex snapshots_mutex_;
  std::map<std::uint64_t, std::size_t> snapshots_;  ///< how many hold each number
  std::uint64_t version_ = 0;                       ///< the last durable change
  std::atomic<bool> kept_ = false;                  ///< old_ may hold something
  std::atomic<bool> broken_ = false;                ///< the engine may have to be opened again
};

/// Makes an empty store of a hash engine in a folder that exists and is empty.
void create_versioned(const std::filesystem::path& folder, const PlainEngine& engine);

/// Writes the main file of a store of a hash engine anew, see Engine::compact.
void compact_versioned(const std::filesystem::path& folder, const std::filesystem::path& compacting,
                       const PlainEngine& engine, const std::function<void(double fraction)>& progress);

/// Opens a store of a hash engine.
std::unique_ptr<KvStore> open_versioned(const std::filesystem::path& folder, Access access, const PlainEngine& engine);

}  // namespace signweave::kv
