#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "app/cli/command.h"

int main(int argc, char** argv) {
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
