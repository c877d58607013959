#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "signweave/kv/engine.h"
#include "signweave/kv/fault.h"
#include "signweave/kv/files.h"
#include "signweave/kv/lmdb_environment.h"
#include "signweave/kv/open_stores.h"

namespace signweave::kv {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMap = std::size_t{1} << 40;

/// The lock that LMDB takes on lock.mdb while it opens an environment that no other process has open. While we hold it,
/// other processes wait in opening. (It belongs to the process: LMDB's own lock may replace it.)
class ExclusiveLock {
 public:
  explicit ExclusiveLock(const fs::path& folder)
      : file_(::open((folder / "lock.mdb").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0664)) {
    if (file_ < 0) fail_system(folder, "compacting the store", errno);
    struct flock request {};
    request.l_type = F_WRLCK;
    request.l_whence = SEEK_SET;
    request.l_len = 1;
    if (::fcntl(file_, F_SETLK, &request) == 0) return;
    const int error = errno;
    ::close(file_);
    if (error != EAGAIN && error != EACCES) fail_system(folder, "compacting the store", error);
    fail(folder, "compacting the store",
         {ErrorCode::conflict, "another process has it open; try again when no process uses it"});
  }
  ~ExclusiveLock() { ::close(file_); }
  ExclusiveLock(const ExclusiveLock&) = delete;
  ExclusiveLock& operator=(const ExclusiveLock&) = delete;

  /// Invalidates the lock file's content, which describes the old file: opening fails in processes that waited.
  void forget() const noexcept { static_cast<void>(::ftruncate(file_, 0)); }

 private:
  int file_ = -1;
};

/// A private environment without locks.
class PrivateEnvironment {
 public:
  explicit PrivateEnvironment(const fs::path& folder) : folder_(folder) {
    need(::mdb_env_create(&env_));
    int code = ::mdb_env_set_mapsize(env_, kMap);
    if (code == MDB_SUCCESS) code = ::mdb_env_open(env_, folder.c_str(), MDB_RDONLY | MDB_NOLOCK | MDB_NOTLS, 0664);
    if (code == MDB_SUCCESS) code = ::mdb_txn_begin(env_, nullptr, MDB_RDONLY, &transaction_);
    if (code == MDB_SUCCESS) code = ::mdb_dbi_open(transaction_, nullptr, 0, &database_);
    if (code == MDB_SUCCESS) code = ::mdb_cursor_open(transaction_, database_, &cursor_);
    if (code == MDB_SUCCESS) return;
    close();
    fail_lmdb(folder_, "compacting the store", code);
  }
  ~PrivateEnvironment() { close(); }
  PrivateEnvironment(const PrivateEnvironment&) = delete;
  PrivateEnvironment& operator=(const PrivateEnvironment&) = delete;

  MDB_env* get() const noexcept { return env_; }
  std::uint64_t entries() const {
    MDB_stat tree{};
    need(::mdb_stat(transaction_, database_, &tree));
    return tree.ms_entries;
  }
  /// Moves to the next entry; false after the last one.
  bool next(MDB_val& key, MDB_val& value) const {
    const int code = ::mdb_cursor_get(cursor_, &key, &value, MDB_NEXT);
    if (code != MDB_NOTFOUND) need(code);
    return code == MDB_SUCCESS;
  }
  void need(int code) const {
    if (code != MDB_SUCCESS) fail_lmdb(folder_, "compacting the store", code);
  }

 private:
  void close() noexcept {
    if (cursor_) ::mdb_cursor_close(cursor_);
    if (transaction_) ::mdb_txn_abort(transaction_);
    ::mdb_env_close(env_);
  }

  fs::path folder_;
  MDB_env* env_ = nullptr;
  MDB_txn* transaction_ = nullptr;
  MDB_dbi database_ = 0;
  MDB_cursor* cursor_ = nullptr;
};

bool same(const MDB_val& a, const MDB_val& b) {
  return a.mv_size == b.mv_size && std::memcmp(a.mv_data, b.mv_data, a.mv_size) == 0;
}

/// Throws unless both contain the same entries, to the bit.
void compare(const PrivateEnvironment& one, const PrivateEnvironment& other, const fs::path& folder,
             const std::function<void(double fraction)>& progress) {
  const double all = static_cast<double>(one.entries());
  constexpr std::uint64_t kEvery = 1024;
  MDB_val key{}, value{}, other_key{}, other_value{};
  for (std::uint64_t done = 0;; ++done) {
    const bool more = one.next(key, value);
    if (more != other.next(other_key, other_value) || (more && (!same(key, other_key) || !same(value, other_value)))) {
      fail(folder, "compacting the store",
           {ErrorCode::io,
            "the new file does not read back as it was written; the old one is unchanged, check memory and disk"});
    }
    if (!more) return;
    if (progress && done % kEvery == 0) progress(0.5 + 0.5 * static_cast<double>(done) / all);
  }
}

void compact_alone(const fs::path& folder, const fs::path& compacting,
                   const std::function<void(double fraction)>& progress) {
  const ExclusiveLock lock(folder);
  {
    const PrivateEnvironment old(folder);
    if (progress) progress(0);
    old.need(::mdb_env_copy2(old.get(), compacting.c_str(), MDB_CP_COMPACT));
    sync_file(compacting / "data.mdb");
    if (progress) progress(0.5);
    compare(old, PrivateEnvironment(compacting), folder, progress);
  }
  // A process waiting for the lock would confuse its transaction numbers, which restart in the new file, with those of
  // this one.
  lock.forget();
  std::error_code error;
  fs::rename(compacting / "data.mdb", folder / "data.mdb", error);
  // LMDB rewrites the lock file with the numbers of the new file before other processes continue.
  MDB_env* env = nullptr;
  int code = ::mdb_env_create(&env);
  if (code == MDB_SUCCESS) {
    ::mdb_env_set_mapsize(env, kMap);
    code = ::mdb_env_open(env, folder.c_str(), MDB_NOTLS, 0664);
    ::mdb_env_close(env);
  }
  if (error) fail_system(folder, "compacting the store", error.value());
  if (code != MDB_SUCCESS) fail_lmdb(folder, "opening the compacted store", code);
}

}  // namespace

void lmdb_compact(const fs::path& folder, const fs::path& compacting,
                  const std::function<void(double fraction)>& progress) {
  LmdbEnvironment::acquire(folder, Access::read_only);  // throws if the file is truncated or not a store
  const bool done = OpenStores<LmdbEnvironment>::while_closed(folder / "data.mdb",
                                                              [&] { compact_alone(folder, compacting, progress); });
  if (!done) {
    fail(folder, "compacting the store", {ErrorCode::conflict, "this process has it open; close it first"});
  }
}

}  // namespace signweave::kv
