#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace signweave::bench {

/// A separate process, whose costs are read from /proc.
class Process {
 public:
  /// Starts the program, with its standard error in a file. Throws std::runtime_error if it cannot.
  Process(std::vector<std::string> command, std::filesystem::path errors);
  /// Sends SIGTERM, and SIGKILL if it has not ended five seconds later.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits for the first line of its standard error that begins with this text and returns the rest of it. Throws if
  /// there is none within some seconds.
  std::string wait_for_line(std::string_view beginning) const;
  /// CPU time of all its threads, user and system, since its start.
  double cpu_seconds() const;
  /// Memory currently in use.
  double resident_bytes() const;

 private:
  pid_t pid_ = 0;
  std::filesystem::path errors_;
};

/// CPU time used by this process.
double own_cpu_seconds();

}  // namespace signweave::bench
