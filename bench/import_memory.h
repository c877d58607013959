#pragma once

// The memory used by an import.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "bench/measure.h"
#include "signweave/database/import.h"

namespace signweave::bench {

/// Anonymous memory of this process in bytes, without the pages of mapped files.
inline std::size_t anonymous_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("RssAnon:")) return std::stoull(line.substr(8)) * 1024;
  }
  throw std::runtime_error("/proc/self/status has no RssAnon");
}

/// Run as a separate program: imports a file and prints the largest growth of anonymous memory, sampled every half a
/// millisecond, and the size of the motion, both in bytes.
inline int import_and_tell(const std::filesystem::path& bvh_path, const std::filesystem::path& folder) {
  Database::create(folder, {});
  Database database(folder, kv::Access::read_write);
  const std::size_t before = anonymous_memory();
  std::atomic<std::size_t> most = before;
  std::atomic<bool> done = false;
  std::thread watcher([&] {
    while (!done) {
      most = std::max<std::size_t>(most, anonymous_memory());
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  });
  const ImportReport report = import_recording(database, {.name = "long", .motion = bvh_path, .annotation = {}}, {});
  done = true;
  watcher.join();
  const auto skeleton = database.skeleton("long");
  const std::size_t motion =
      static_cast<std::size_t>(report.frames) *
      (skeleton->joint_count() * sizeof(Eigen::Quaternionf) + skeleton->translation_count() * sizeof(Eigen::Vector3f));
  fmt::print("{} {} {}\n", most - before, motion, report.frames);
  return 0;
}

inline void measure_memory(const std::filesystem::path& bvh_path, const std::string& name, std::int64_t frames,
                           const std::string& goal) {
  const Folder folder("import_memory");
  const std::string program = std::filesystem::read_symlink("/proc/self/exe");
  const std::string database = folder.path() / "db";
  const std::string printed = folder.path() / "printed";
  std::string words[] = {program, "--import-memory", bvh_path, database};
  char* const arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 1, printed.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = 0;
  const int fault = posix_spawn(&process, program.c_str(), &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  if (fault != 0) throw std::runtime_error("cannot start a process for the import");
  int status = 0;
  waitpid(process, &status, 0);
  std::size_t grown = 0;
  std::size_t motion = 0;
  long long imported = 0;
  if (status != 0 || !(std::ifstream(printed) >> grown >> motion >> imported)) {
    throw std::runtime_error("the import in a separate process failed");
  }
  if (imported != frames) throw std::runtime_error(name + ": a different number of frames was imported");
  const double mega = 1e-6;
  print("import_memory/" + name, static_cast<double>(grown) * mega, "MB", static_cast<double>(motion) * mega,
        static_cast<double>(grown) / static_cast<double>(motion), goal);
}

}  // namespace signweave::bench
