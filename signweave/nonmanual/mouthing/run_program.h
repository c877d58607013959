#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// The file of a program: `program` itself if it contains a slash, otherwise the first executable file of that name in
/// the PATH; nullopt if there is none.
std::optional<std::filesystem::path> find_program(const std::filesystem::path& program);

struct ProgramLimits {
  Milliseconds patience{2000};      ///< then it is killed, with its children
  std::size_t most_bytes = 65'536;  ///< of output; beyond that it is killed
};

/// How a program ended.
struct ProgramResult {
  enum class End { finished, failed, too_long, too_much };
  End end = End::finished;
  int status = 0;      ///< exit status, or the number of the signal, if it failed
  std::string output;  ///< what it wrote to standard output
};

/// Runs a program without a shell, with these arguments, and waits for its end. Its standard input and error are
/// /dev/null; it inherits no other file, and of the environment only PATH, HOME and ESPEAK_DATA_PATH, with the locale
/// C.UTF-8. It runs in a process group of its own. Throws Error{io} if it cannot be started.
ProgramResult run_program(const std::filesystem::path& file, const std::vector<std::string>& arguments,
                          const ProgramLimits& limits = {});

}  // namespace signweave
