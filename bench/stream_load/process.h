#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace signweave::bench {

/// A program beside this one, told apart by the system: what it costs is read from /proc.
class Process {
 public:
  /// Starts it, its standard error in a file. Throws std::runtime_error where it cannot.
  Process(std::vector<std::string> command, std::filesystem::path errors);
  /// SIGTERM, and SIGKILL where it has not ended five seconds later.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// The rest of the first line of its standard error that begins so. Throws where none comes within some seconds.
  std::string wait_for_line(std::string_view beginning) const;
  /// Of all its threads, user and system, since it began.
  double cpu_seconds() const;
  /// Memory that is in use now.
  double resident_bytes() const;

 private:
  pid_t pid_ = 0;
  std::filesystem::path errors_;
};

/// What this process has used.
double own_cpu_seconds();

}  // namespace signweave::bench
