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

/// Internal to this module: snapshots and transactions for engines whose own transactions do not isolate readers.
///
/// A transaction holds its changes in memory until it commits; then they are applied one by one. Before each one, the
/// old value is moved to OldValues, where snapshots that began before the change was durable find it. So a reader waits
/// for one single change at most, never for a whole transaction or for the disk.
namespace signweave::kv {

/// One change of a transaction: puts a value, or erases the key if there is none.
struct Change {
  std::string key;
  std::optional<Bytes> value;
};

/// A store that this process has open, shared by all its users. More than fifteen members: each lock is declared next
/// to what it guards.
class VersionedStore {
 public:
  static std::shared_ptr<VersionedStore> acquire(const std::filesystem::path& folder, Access access,
                                                 const PlainEngine& engine);
  ~VersionedStore();
  VersionedStore(const VersionedStore&) = delete;
  VersionedStore& operator=(const VersionedStore&) = delete;

  /// Begin and end a snapshot, which is the number of the last change that it sees.
  std::uint64_t begin_snapshot();
  void end_snapshot(std::uint64_t snapshot) noexcept;

  /// The value in a snapshot, stored in a part of `buffer`.
  std::optional<ByteSpan> get(std::uint64_t snapshot, ByteSpan key, Bytes& buffer);
  /// For the writer only, because nothing else can have changed since it began.
  bool has(ByteSpan key);

  /// Takes the write lock: waits while another thread holds it; throws Error{conflict} if this thread holds it.
  std::unique_lock<std::mutex> begin_write();
  void end_write() noexcept { writer_ = std::thread::id{}; }
  /// Makes the changes, which must not repeat a key, durable and visible. Throws Error{io, corrupt}; then nothing was
  /// changed.
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
  void repair();
  void check_process() const;
  void publish(std::uint64_t number);
  void forget();

  const std::filesystem::path folder_;
  const PlainEngine& engine_;
  const pid_t process_;  ///< a store must not be used after a fork
  StoreLock lock_;

  // Locks are taken in the order of declaration.
  std::mutex writing_;  ///< held by the write transaction
  std::atomic<std::thread::id> writer_;
  std::mutex applying_;                ///< held while the engine's content, or the engine, changes
  FairLock access_;                    ///< shared by readers; taken for each single change
  OldValues old_;                      ///< guarded by access_
  std::unique_ptr<PlainStore> plain_;  ///< guarded by access_; null if it could not be reopened
  bool writable_ = false;              ///< guarded by applying_
  std::string why_closed_;             ///< guarded by access_
  std::mutex snapshots_mutex_;
  std::map<std::uint64_t, std::size_t> snapshots_;  ///< the number of users of each snapshot
  std::uint64_t version_ = 0;                       ///< the last durable change
  std::atomic<bool> kept_ = false;                  ///< old_ may be non-empty
  std::atomic<bool> broken_ = false;                ///< the engine may have to be reopened
};

/// Creates an empty store of a hash engine in an existing empty folder.
void create_versioned(const std::filesystem::path& folder, const PlainEngine& engine);

/// Rewrites the main file of a hash engine's store, see Engine::compact.
void compact_versioned(const std::filesystem::path& folder, const std::filesystem::path& compacting,
                       const PlainEngine& engine, const std::function<void(double fraction)>& progress);

/// Opens a store of a hash engine.
std::unique_ptr<KvStore> open_versioned(const std::filesystem::path& folder, Access access, const PlainEngine& engine);

}  // namespace signweave::kv
