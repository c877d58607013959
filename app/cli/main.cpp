#include <unistd.h>

#include <csignal>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/command.h"

namespace {

/// The engines map their files, so damaged pages may kill the program. It reports this before it ends.
void say_and_end(int signal) {
  constexpr std::string_view kText =
      "signweave: ended by a memory fault; if a database was open, its pages may be damaged: "
      "check with 'signweave check DB', and restore it from a copy\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText.data(), kText.size());
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

int main(int argc, char** argv) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) ::signal(signal, say_and_end);
  std::ios::sync_with_stdio(false);
  signweave::cli::Io io{.out = std::cout, .err = std::cerr, .terminal = ::isatty(STDERR_FILENO) != 0};
  const int status = signweave::cli::dispatch(std::vector<std::string>(argv + 1, argv + argc), io);
  std::cout.flush();
  if (!std::cout) {
    std::cerr << "signweave: the results could not be written (is the disk full?)\n";
    return 1;
  }
  return status;
}
