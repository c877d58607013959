#include "signweave/kv/versioned_store.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <shared_mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "signweave/kv/fault.h"
#include "signweave/kv/files.h"
#include "signweave/kv/open_stores.h"

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

/// Takes the lock exclusively. Several readers may want it at once, and none gets it while the others hold their share.
void lock_exclusively(StoreLock& lock) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + 5s;
  for (auto wait = 1ms;; wait = std::min(2 * wait, 50ms)) {
    try {
      lock.make_exclusive();
      return;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::conflict || std::chrono::steady_clock::now() > end) throw;
    }
    lock.release();
    std::this_thread::sleep_for(wait);
  }
}

/// Opens a store that was not closed in order for writing, which repairs it, and closes it.
void recover(const fs::path& folder, const PlainEngine& engine, StoreLock& lock) {
  try {
    lock_exclusively(lock);
    if (lock.closed_in_order()) {  // another process has done it meanwhile
      lock.make_shared();
      return;
    }
    engine.open(folder, Access::read_write, false)->close();
    lock.mark(true);
    lock.make_shared();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::io) throw;
    fail(folder, "opening the store",
         {ErrorCode::io, std::string("the last writer did not close the store; open it once with write permission (") +
                             error.what() + ")"});
  }
}

}  // namespace

std::shared_ptr<VersionedStore> VersionedStore::acquire(const fs::path& folder, Access access,
                                                        const PlainEngine& engine) {
  auto store = OpenStores<VersionedStore>::acquire(folder / engine.file, [&] {
    return std::unique_ptr<VersionedStore>(new VersionedStore(folder, access, engine));
  });
  if (access == Access::read_write) store->become_writable();
  return store;
}

VersionedStore::VersionedStore(fs::path folder, Access access, const PlainEngine& engine)
    : folder_(std::move(folder)), engine_(engine), process_(::getpid()), lock_(folder_, access) {
  const bool closed = lock_.closed_in_order();
  if (access == Access::read_only && !closed) recover(folder_, engine_, lock_);
  if (access == Access::read_write) lock_.mark(false);
  try {
    plain_ = engine_.open(folder_, access, closed || access == Access::read_only);
  } catch (...) {
    if (access == Access::read_write && closed) mark_closed();  // nothing was changed
    throw;
  }
  writable_ = access == Access::read_write;
}

VersionedStore::~VersionedStore() {
  if (process_ != ::getpid()) {
    // After a fork the files belong to the parent, and closing would write to them. So the store stays open until the
    // process ends.
    static_cast<void>(plain_.release());
    return;
  }
  if (!plain_ || !writable_ || !plain_->sound()) return;
  try {
    plain_->close();
    plain_.reset();
    mark_closed();
  } catch (const Error&) {  // the next open repairs it
  }
}

// Snapshots of readers stay valid: a snapshot is just a number, and the content does not change.
void VersionedStore::become_writable() {
  const std::lock_guard applying(applying_);
  if (writable_) return;
  const std::lock_guard lock(access_);
  lock_.make_exclusive();
  try {
    lock_.mark(false);
    plain_.reset();
    plain_ = engine_.open(folder_, Access::read_write, true);
    writable_ = true;
  } catch (...) {
    mark_closed();
    reopen();
    lock_.make_shared();
    throw;
  }
}

void VersionedStore::mark_closed() noexcept {
  try {
    lock_.mark(true);
  } catch (const Error&) {  // the next open repairs it
  }
}

void VersionedStore::reopen() noexcept {
  try {
    plain_.reset();
    plain_ = engine_.open(folder_, writable_ ? Access::read_write : Access::read_only, !writable_);
  } catch (const std::exception& error) {
    why_closed_ = error.what();
  }
}

void VersionedStore::repair() {
  const std::lock_guard applying(applying_);
  const std::lock_guard lock(access_);
  if (!plain_ || !plain_->sound()) reopen();
  broken_ = !plain_;
}

const PlainStore& VersionedStore::plain() const {
  if (plain_) return *plain_;
  throw Error(ErrorCode::io,
              folder_.string() + ": the store could not be reopened after a failure (" + why_closed_ + ")");
}

void VersionedStore::check_process() const {
  if (process_ == ::getpid()) return;
  throw Error(ErrorCode::conflict, folder_.string() + ": this store was opened by the parent process; open it again");
}

void VersionedStore::check_key(ByteSpan key) const {
  if (!key.empty() && key.size() <= engine_.longest_key) return;
  throw Error(ErrorCode::bad_input, folder_.string() + ": a key of " + std::to_string(key.size()) +
                                        " bytes; keys have 1 to " + std::to_string(engine_.longest_key) +
                                        ", use a shorter name");
}

std::uint64_t VersionedStore::begin_snapshot() {
  check_process();
  if (broken_) repair();
  const std::lock_guard lock(snapshots_mutex_);
  ++snapshots_[version_];
  return version_;
}

void VersionedStore::end_snapshot(std::uint64_t snapshot) noexcept {
  if (process_ != ::getpid()) return;  // another thread of the parent may have held the mutex
  {
    const std::lock_guard lock(snapshots_mutex_);
    const auto at = snapshots_.find(snapshot);
    const bool oldest = at == snapshots_.begin();
    if (--at->second > 0) return;
    snapshots_.erase(at);
    if (!oldest) return;
  }
  if (kept_) forget();
}

std::optional<ByteSpan> VersionedStore::get(std::uint64_t snapshot, ByteSpan key, Bytes& buffer) {
  check_key(key);
  try {
    const std::shared_lock lock(access_);
    if (const std::optional<Bytes>* old = old_.find(key, snapshot)) {
      if (!*old) return std::nullopt;
      make_room(buffer, (*old)->size());
      std::copy((*old)->begin(), (*old)->end(), buffer.begin());
      return ByteSpan(buffer).first((*old)->size());
    }
    return plain().get(key, buffer);
  } catch (const Error&) {
    broken_ = true;  // possibly: `repair` checks
    repair();        // now, so that a damaged page does not block this snapshot's other pages
    throw;
  }
}

bool VersionedStore::has(ByteSpan key) {
  const std::shared_lock lock(access_);
  return plain().has(key);
}

std::unique_lock<std::mutex> VersionedStore::begin_write() {
  check_process();
  if (writer_ == std::this_thread::get_id()) {
    throw Error(ErrorCode::conflict, folder_.string() + ": this thread is writing already; end that change first");
  }
  std::unique_lock turn(writing_);
  if (broken_) repair();
  writer_ = std::this_thread::get_id();
  return turn;
}

void VersionedStore::apply(const std::deque<Change>& changes) {
  const std::lock_guard applying(applying_);
  std::uint64_t bytes = 0;
  for (const Change& change : changes) bytes += change.key.size() + (change.value ? change.value->size() : 0);
  require_room(folder_ / engine_.file, bytes);
  plain();
  const std::uint64_t number = version_ + 1;
  try {
    plain_->begin(changes.size(), bytes);
    Bytes buffer;
    for (const Change& change : changes) {
      const ByteSpan key = bytes_of(change.key);
      const std::optional<ByteSpan> old = plain_->get(key, buffer);  // unlocked: there is no other writer
      const std::lock_guard lock(access_);
      kept_ = true;
      old_.keep(number, key, old);
      if (change.value) {
        plain_->put(key, *change.value);
      } else if (old) {
        plain_->erase(key);
      }
    }
    {
      const std::lock_guard lock(access_);
      plain_->finish();
    }
    plain_->commit();
  } catch (...) {
    {
      const std::lock_guard lock(access_);
      try {
        if (plain_->sound()) plain_->abort();
      } catch (const Error&) {
      }
      if (!plain_->sound()) reopen();
      broken_ = !plain_;
    }
    // Older snapshots see the old values, whether the engine stored the change or not.
    publish(number);
    throw;
  }
  publish(number);
}

void VersionedStore::publish(std::uint64_t number) {
  {
    const std::lock_guard lock(snapshots_mutex_);
    version_ = number;
  }
  forget();
}

void VersionedStore::forget() {
  std::vector<std::optional<Bytes>> forgotten;  // freed last, outside the lock
  std::uint64_t oldest = 0;
  {
    const std::lock_guard lock(snapshots_mutex_);
    oldest = snapshots_.empty() ? version_ : snapshots_.begin()->first;
  }
  const std::lock_guard lock(access_);
  forgotten = old_.forget(oldest);
  kept_ = !old_.empty();
}

EngineInfo VersionedStore::info() {
  check_process();
  const std::lock_guard applying(applying_);
  return {.name = engine_.name,
          .version = engine_.version(),
          .entries = plain().entries(),
          .bytes_on_disk = bytes_in(folder_)};
}

void VersionedStore::visit(const std::function<void(ByteSpan key, std::size_t value_size)>& see) {
  check_process();
  struct Entry {
    std::string key;
    std::size_t size;
  };
  std::vector<Entry> entries;  // reported outside the lock: `see` may read and write
  {
    const std::lock_guard applying(applying_);
    plain().visit([&](ByteSpan key, std::size_t size) { entries.push_back({std::string(text_of(key)), size}); });
  }
  for (const Entry& entry : entries) see(bytes_of(entry.key), entry.size);
}

}  // namespace signweave::kv
