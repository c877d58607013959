#pragma once

#include <lmdb.h>
#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string_view>
#include <thread>

#include "signweave/kv/kv_store.h"

/// Internal to this module: one opened LMDB folder.
namespace signweave::kv {

/// An LMDB environment shared within the process. LMDB forbids a process to open one environment twice (the second
/// close would drop the locks of the first), so `acquire` returns the one that this process has open, or opens it. It
/// closes when the last owner releases it. Several threads may use one.
class LmdbEnvironment {
 public:
  /// Opens the store in `folder`. Throws Error{corrupt} if the file is shorter than its content requires, Error{io}.
  static std::shared_ptr<LmdbEnvironment> acquire(const std::filesystem::path& folder, Access access);

  ~LmdbEnvironment();
  LmdbEnvironment(const LmdbEnvironment&) = delete;
  LmdbEnvironment& operator=(const LmdbEnvironment&) = delete;

  MDB_env* get() const noexcept { return env_; }
  MDB_dbi database() const noexcept { return database_; }
  const std::filesystem::path& folder() const noexcept { return folder_; }
  bool writable() const noexcept { return writable_; }

  /// Begins an LMDB transaction.
  MDB_txn* begin_read() const;
  MDB_txn* begin_write();
  /// Must be called when the write transaction is over.
  void end_write() noexcept { writer_ = std::thread::id{}; }

  /// Throws the Error for an LMDB return code; `doing` completes "while …".
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
  std::atomic<std::thread::id> writer_;  ///< the thread that holds the write lock
};

/// The same for failures before there is an environment.
[[noreturn]] void fail_lmdb(const std::filesystem::path& folder, std::string_view doing, int code);

/// True if every page to which the snapshot numbered `transaction` refers lies within the first `bytes` of the file.
/// Reads with pread, so that a truncated file cannot raise SIGBUS.
bool lmdb_pages_inside(int file, std::uint64_t bytes, std::uint64_t transaction);

/// Checks that data.mdb begins like an LMDB file and contains both meta pages. Throws Error{corrupt}.
void check_lmdb_header(const std::filesystem::path& folder);

}  // namespace signweave::kv
