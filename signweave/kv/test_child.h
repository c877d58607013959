#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "signweave/kv/kv_store.h"

/// For tests: runs code in a child process if it may kill or limit the process.
namespace signweave::kv {

/// The outcome of an action in a child process: what it threw ("" if nothing).
struct ChildResult {
  bool finished = false;  ///< false: killed by a signal
  ErrorCode code = ErrorCode::cancelled;
  std::string text;
};
inline ChildResult in_child(const std::function<void()>& action) {
  int ends[2];
  if (::pipe(ends) != 0) return {};
  std::fflush(nullptr);  // otherwise the child might write it, too
  const pid_t child = ::fork();
  if (child == 0) {
    std::string message;
    try {
      action();
    } catch (const Error& error) {
      message = static_cast<char>('0' + static_cast<int>(error.code())) + std::string(error.what());
    } catch (const std::exception& error) {
      message = std::string("?") + error.what();
    }
    ::_exit(::write(ends[1], message.data(), message.size()) == static_cast<ssize_t>(message.size()) ? 0 : 1);
  }
  ::close(ends[1]);
  ChildResult result;
  char buffer[1'000];
  for (ssize_t got = 0; (got = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
    result.text.append(buffer, static_cast<std::size_t>(got));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  result.finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!result.text.empty()) {
    result.code = static_cast<ErrorCode>(result.text[0] - '0');
    result.text.erase(0, 1);
  }
  return result;
}

inline void require(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

/// Runs `action` in a child process that may read the store in `path` but not write to it.
inline ChildResult without_right_to_write(const std::filesystem::path& path, const std::function<void()>& action) {
  namespace fs = std::filesystem;
  fs::permissions(path.parent_path(), fs::perms(0755));
  for (const auto& entry : fs::directory_iterator(path)) fs::permissions(entry.path(), fs::perms(0444));
  fs::permissions(path, fs::perms(0555));
  ChildResult result = in_child([&] {
    if (::geteuid() == 0) require(::setgid(65'534) == 0 && ::setuid(65'534) == 0, "become nobody");
    action();
  });
  fs::permissions(path, fs::perms(0755));
  for (const auto& entry : fs::directory_iterator(path)) fs::permissions(entry.path(), fs::perms(0644));
  return result;
}

/// Applies changes of 20 records each, the first of which is large.
inline void fill(KvStore& store, int changes) {
  for (int i = 0; i < changes; ++i) {
    const auto change = store.write();
    for (int k = 0; k < 20; ++k) {
      const std::string key = std::to_string(i) + '/' + std::to_string(k);
      change->put(bytes_of(key), bytes_of(std::string(k == 0 ? 30'000 : 150, static_cast<char>('a' + i % 26))));
    }
    change->commit();
  }
}

/// Throws if any record of `fill` is missing or wrong.
inline void read_everything(const KvStore& store, int changes) {
  const auto snapshot = store.read();
  for (int i = 0; i < changes; ++i) {
    for (int k = 0; k < 20; ++k) {
      const auto value = snapshot->get(bytes_of(std::to_string(i) + '/' + std::to_string(k)));
      require(value && text_of(*value) == std::string(k == 0 ? 30'000 : 150, static_cast<char>('a' + i % 26)),
              "a value is wrong");
    }
  }
}

}  // namespace signweave::kv
