#pragma once

#include <filesystem>

#include "signweave/kv/kv_store.h"

/// Inside this module only.
namespace signweave::kv {

/// The file engine.lock of a store whose engine serves one process that writes, or several that only read. It holds the
/// lock, which the system takes back when the process ends, and one line that tells whether the last writer closed the
/// store or was killed. (Locks of open files, not of processes: they pass from reading to writing without a gap, and
/// other handles of the same file do not disturb them.)
class StoreLock {
 public:
  /// Throws Error{conflict} where another process is in the way, Error{io} where the file cannot be opened.
  StoreLock(const std::filesystem::path& folder, Access access);
  ~StoreLock();
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;

  /// From reading to writing; what was held stays held where that fails. Throws as the constructor does.
  void make_exclusive();
  /// Holds nothing; the object can take it again.
  void let_go() noexcept;
  /// From writing to reading.
  void make_shared() noexcept;

  /// True where nobody wrote since the store was last closed in order.
  bool closed_in_order() const noexcept;
  /// To be called before the first change, and after the store was closed. Throws Error{io}.
  void mark(bool closed);

 private:
  void take(short kind) const;

  std::filesystem::path folder_;
  int file_ = -1;
};

}  // namespace signweave::kv
