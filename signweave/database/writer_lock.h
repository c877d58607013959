#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Internal to `database`.
namespace signweave {

/// The file writer.lock, held while a process has a database open for changing. The system lets go of it when the
/// process ends, however it ends, so a crash leaves no lock behind. What is written in it says who that is.
class WriterLock {
 public:
  /// Throws Error{conflict} naming who has it, Error{io}.
  explicit WriterLock(const std::filesystem::path& folder);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

  /// Tells others who has it: "signweave serve at http://127.0.0.1:8080", say.
  void announce(std::string_view who) noexcept;

 private:
  int file_ = -1;
};

/// Who has the database open for changing, as it announced itself; empty where nobody has.
std::string writer_of(const std::filesystem::path& folder);

}  // namespace signweave
