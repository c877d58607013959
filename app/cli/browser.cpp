#include "app/cli/browser.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::cli {
namespace {

namespace fs = std::filesystem;

bool runs(const fs::path& program) {
  return ::access(program.c_str(), X_OK) == 0 && fs::is_regular_file(program);
}

/// The path of a program found in the PATH by its plain name; empty if not found.
fs::path in_path(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view left = path == nullptr ? "" : path;
  while (!left.empty()) {
    const std::size_t end = std::min(left.find(':'), left.size());
    fs::path file = fs::path(left.substr(0, end)) / name;
    if (runs(file)) return file;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return {};
}

}  // namespace

fs::path find_browser(const std::string& wanted) {
  const char* const set = std::getenv("CHROMIUM");
  const std::string named = !wanted.empty() ? wanted : set == nullptr ? "" : set;
  if (!named.empty()) {
    fs::path found = named.find('/') != named.npos ? fs::path(named) : in_path(named);
    if (!found.empty() && runs(found)) return found;
    throw Error(ErrorCode::not_found, fmt::format("{}: no such program", printable(named)));
  }
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (fs::path found = in_path(name); !found.empty()) return found;
  }
  throw Error(ErrorCode::not_found,
              "no Chromium found to draw with: install the package chromium, or give a program with --browser");
}

Browser::Browser(const fs::path& program, const std::string& url, const fs::path& folder)
    : said_(folder / "browser.log") {
  std::vector<std::string> words = {program.string(),
                                    "--headless=new",
                                    "--user-data-dir=" + (folder / "profile").string(),
                                    "--no-first-run",
                                    "--hide-scrollbars",
                                    "--mute-audio",
                                    "--disable-quic",
                                    "--disable-background-networking",
                                    "--disable-background-timer-throttling",
                                    "--disable-component-update",
                                    "--disable-sync",
                                    "--use-angle=swiftshader",
                                    "--enable-unsafe-swiftshader"};
  if (::geteuid() == 0) words.emplace_back("--no-sandbox");  // Chromium's own sandbox refuses to work for root
  words.push_back(url);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, 2, said_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&how, 0);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&how, &none);
  const int error = ::posix_spawn(&process_, program.c_str(), &files, &how, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&how);
  if (error != 0) {
    process_ = -1;
    throw Error(ErrorCode::io, fmt::format("{}: {}", program.string(), std::strerror(error)));
  }
}

Browser::~Browser() {
  if (process_ < 0) return;
  ::kill(-process_, SIGTERM);
  for (int i = 0; i < 40; ++i) {
    if (::waitpid(process_, nullptr, WNOHANG) != 0) {
      process_ = -1;
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ::kill(-process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool Browser::running() {
  if (process_ < 0) return false;
  if (::waitpid(process_, nullptr, WNOHANG) == 0) return true;
  ::kill(-process_, SIGKILL);  // its child processes
  process_ = -1;
  return false;
}

std::string Browser::last_words() const {
  std::ifstream in(said_);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!trimmed(line).empty()) last = line;
  }
  return printable(last.substr(0, 300));
}

}  // namespace signweave::cli
