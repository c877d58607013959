#pragma once

#include <filesystem>

#include "signweave/kv/kv_store.h"

/// Internal to this module.
namespace signweave::kv {

/// The file engine.lock of a store whose engine serves one writing process or several that only read. It carries the
/// lock, which the system releases when the process ends, and one line that says whether the last writer closed the
/// store or was killed. (Uses locks of open files, not of processes: they change from reading to writing without a gap,
/// and other handles of the same file do not affect them.)
class StoreLock {
 public:
  /// Throws Error{conflict} if another process holds a conflicting lock, Error{io} if the file cannot be opened.
  StoreLock(const std::filesystem::path& folder, Access access);
  ~StoreLock();
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;

  /// Changes the lock from reading to writing; on failure the old lock is still held. Throws as the constructor does.
  void make_exclusive();
  /// Releases the lock; the object can take it again.
  void release() noexcept;
  /// Changes the lock from writing to reading.
  void make_shared() noexcept;

  /// True if the store was not written to since it was last closed in order.
  bool closed_in_order() const noexcept;
  /// Must be called before the first change and after closing the store. Throws Error{io}.
  void mark(bool closed);

 private:
  void take(short kind) const;

  std::filesystem::path folder_;
  int file_ = -1;
};

}  // namespace signweave::kv
