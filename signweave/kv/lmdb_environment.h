#pragma once

#include <lmdb.h>
#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string_view>
#include <thread>

#include "signweave/kv/kv_store.h"

/// Inside this module only: one opened LMDB folder.
namespace signweave::kv {

/// LMDB forbids a process to open one environment twice (the second close would drop the locks of the first), so
/// environments are shared: `acquire` gives the one that this process has open, or opens it. It closes when the last
/// holder lets go. Several threads may use one.
class LmdbEnvironment {
 public:
  /// Opens the store in `folder`. Throws Error{corrupt} where the file is shorter than what it must hold, Error{io}.
  static std::shared_ptr<LmdbEnvironment> acquire(const std::filesystem::path& folder, Access access);

  ~LmdbEnvironment();
  LmdbEnvironment(const LmdbEnvironment&) = delete;
  LmdbEnvironment& operator=(const LmdbEnvironment&) = delete;

  MDB_env* get() const noexcept { return env_; }
  MDB_dbi database() const noexcept { return database_; }
  const std::filesystem::path& folder() const noexcept { return folder_; }
  bool writable() const noexcept { return writable_; }

  /// Begins a transaction of LMDB's.
  MDB_txn* begin_read() const;
  MDB_txn* begin_write();
  /// To be called when the write transaction is over.
  void end_write() noexcept { writer_ = std::thread::id{}; }

  /// Throws the Error that LMDB's return code stands for; `doing` completes "while …".
  [[noreturn]] void fail(std::string_view doing, int code) const;

 private:
  LmdbEnvironment(std::filesystem::path folder, Access access);
  int try_open(unsigned flags);
  void check_length();

  std::filesystem::path folder_;
  MDB_env* env_ = nullptr;
  MDB_dbi database_ = 0;
  bool writable_ = false;
  pid_t process_;                        ///< an environment must not be used after a fork
  std::atomic<std::thread::id> writer_;  ///< who holds the write lock
};

/// The same for faults before there is an environment.
[[noreturn]] void fail_lmdb(const std::filesystem::path& folder, std::string_view doing, int code);

/// True where every page that the snapshot numbered `transaction` refers to lies within the first `bytes` of the file.
/// Reads with pread, so that a file that was cut short cannot raise SIGBUS.
bool lmdb_pages_inside(int file, std::uint64_t bytes, std::uint64_t transaction);

/// Checks that the first bytes of data.mdb are LMDB's and that its two meta pages are there. Throws Error{corrupt}.
void check_lmdb_header(const std::filesystem::path& folder);

}  // namespace signweave::kv
