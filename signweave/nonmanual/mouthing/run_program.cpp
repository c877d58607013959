#include "signweave/nonmanual/mouthing/run_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

#include "signweave/core/error.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

bool is_executable(const fs::path& file) {
  std::error_code fault;
  return fs::is_regular_file(file, fault) && ::access(file.c_str(), X_OK) == 0;
}

/// A file descriptor, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const noexcept { return number_; }
  void close() noexcept {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// A started program. Killed with its children, and waited for, at the end.
class Child {
 public:
  Child(const fs::path& file, std::vector<std::string> words, int output) {
    words.insert(words.begin(), file.string());
    std::vector<std::string> settings = {"LC_ALL=C.UTF-8"};
    for (const char* name : {"PATH", "HOME", "ESPEAK_DATA_PATH"}) {
      if (const char* const value = std::getenv(name)) settings.push_back(fmt::format("{}={}", name, value));
    }
    start(file, pointers(words), pointers(settings), output);
  }
  ~Child() {
    if (process_ < 0) return;
    kill_all();
    ::waitpid(process_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void kill_all() const noexcept { ::kill(-process_, SIGKILL); }

  /// Its status as of waitpid, if it has ended by then.
  std::optional<int> wait_until(Clock::time_point deadline) {
    for (;;) {
      int status = 0;
      const pid_t ended = ::waitpid(process_, &status, WNOHANG);
      if (ended == process_ || (ended < 0 && errno != EINTR)) {
        kill_all();  // children that it left
        process_ = -1;
        return ended < 0 ? 0 : status;
      }
      if (Clock::now() >= deadline) return std::nullopt;
      std::this_thread::sleep_for(Milliseconds(1));
    }
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> result;
    for (std::string& word : words) result.push_back(word.data());
    result.push_back(nullptr);
    return result;
  }

  void start(const fs::path& file, std::vector<char*> words, std::vector<char*> settings, int output) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, output, 1);
    posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&files, 3);
    posix_spawnattr_t how;
    posix_spawnattr_init(&how);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&how, 0);
    sigset_t set;
    sigemptyset(&set);
    posix_spawnattr_setsigmask(&how, &set);
    sigaddset(&set, SIGPIPE);
    posix_spawnattr_setsigdefault(&how, &set);
    const int fault = ::posix_spawn(&process_, file.c_str(), &files, &how, words.data(), settings.data());
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&how);
    if (fault != 0) {
      process_ = -1;
      throw Error(ErrorCode::io, fmt::format("{}: {}", file.string(), std::strerror(fault)));
    }
  }

  pid_t process_ = -1;
};

enum class ReadEnd { end_of_file, too_long, too_much };

ReadEnd read_all(int from, const ProgramLimits& limits, Clock::time_point deadline, std::string& output) {
  char buffer[4096];
  for (;;) {
    const auto left = std::chrono::ceil<Milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return ReadEnd::too_long;
    pollfd watched{.fd = from, .events = POLLIN, .revents = 0};
    const int ready = ::poll(&watched, 1, static_cast<int>(std::min<std::int64_t>(left, 60'000)));
    if (ready < 0 && errno != EINTR) return ReadEnd::end_of_file;
    if (ready <= 0) continue;
    const ssize_t count = ::read(from, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return ReadEnd::end_of_file;
    output.append(buffer, static_cast<std::size_t>(count));
    if (output.size() > limits.most_bytes) return ReadEnd::too_much;
  }
}

}  // namespace

std::optional<fs::path> find_program(const fs::path& program) {
  if (program.empty()) return std::nullopt;
  if (program.native().find('/') != std::string::npos) {
    return is_executable(program) ? std::optional(program) : std::nullopt;
  }
  const char* const path = std::getenv("PATH");
  std::string_view left = path == nullptr ? "" : path;
  while (!left.empty()) {
    const std::size_t end = std::min(left.find(':'), left.size());
    // An empty entry means the current folder, from which nothing is run.
    if (end > 0) {
      fs::path file = fs::path(left.substr(0, end)) / program;
      if (is_executable(file)) return file;
    }
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return std::nullopt;
}

ProgramResult run_program(const fs::path& file, const std::vector<std::string>& arguments,
                          const ProgramLimits& limits) {
  const Clock::time_point deadline = Clock::now() + limits.patience;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(ErrorCode::io, fmt::format("pipe: {}", std::strerror(errno)));
  Descriptor reading(ends[0]);
  Descriptor writing(ends[1]);
  Child child(file, arguments, writing.get());
  writing.close();

  ProgramResult result;
  switch (read_all(reading.get(), limits, deadline, result.output)) {
    case ReadEnd::too_much:
      result.end = ProgramResult::End::too_much;
      return result;
    case ReadEnd::too_long:
      result.end = ProgramResult::End::too_long;
      return result;
    case ReadEnd::end_of_file:
      break;
  }
  const std::optional<int> status = child.wait_until(deadline);
  if (!status) {
    result.end = ProgramResult::End::too_long;
  } else if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0) {
    result.end = ProgramResult::End::failed;
    result.status = WIFEXITED(*status) ? WEXITSTATUS(*status) : WTERMSIG(*status);
  }
  return result;
}

}  // namespace signweave
