#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Internal to `database`.
namespace signweave {

/// The file writer.lock, held while a process has a database open for changing. The system releases it when the process
/// ends, even by a crash. Its content names the process.
class WriterLock {
 public:
  /// Throws Error{conflict} that names the process that holds it, Error{io}.
  explicit WriterLock(const std::filesystem::path& folder);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

  /// Sets the name that others see, such as "signweave serve at http://127.0.0.1:8080".
  void announce(std::string_view who) noexcept;

 private:
  int file_ = -1;
};

/// Returns the announced name of the process that has the database open for changing; empty: none has.
std::string writer_of(const std::filesystem::path& folder);

}  // namespace signweave
