#include "bench/stream_load/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace signweave::bench {

using namespace std::chrono_literals;

Process::Process(std::vector<std::string> command, std::filesystem::path errors) : errors_(std::move(errors)) {
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  std::error_code ignored;
  std::filesystem::remove(errors_, ignored);  // the output of an earlier program is not this one's
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error(fmt::format("cannot start {}", command.front()));
  if (pid_ > 0) return;
  // The child process. It ends with this program, however that ends.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int log = open(errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(log, STDERR_FILENO);
  execv(words[0], words.data());
  _exit(127);
}

Process::~Process() {
  kill(pid_, SIGTERM);
  for (int i = 0; i < 500; ++i) {
    if (waitpid(pid_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(10ms);
  }
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::string Process::wait_for_line(std::string_view beginning) const {
  for (int i = 0; i < 1000; ++i) {
    std::ifstream file(errors_);
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with(beginning) && !file.eof()) return line.substr(beginning.size());
    }
    std::this_thread::sleep_for(10ms);
  }
  std::ifstream file(errors_);
  std::ostringstream text;
  text << file.rdbuf();
  throw std::runtime_error(fmt::format("no line '{}…' from the program, but: {}", beginning, text.str()));
}

double Process::cpu_seconds() const {
  std::ifstream file(fmt::format("/proc/{}/stat", pid_));
  std::string text;
  std::getline(file, text);
  // The name in parentheses may contain anything; after it come the state (field 3) and the rest.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  double user = 0;
  double system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double Process::resident_bytes() const {
  std::ifstream file(fmt::format("/proc/{}/statm", pid_));
  double total = 0;
  double resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double own_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace signweave::bench
