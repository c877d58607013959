#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "signweave/calls/field.h"

namespace signweave::cli {

/// Refuses a text that is not one of these, suggesting near matches. `--help` lists them.
CLI::Validator one_of(const std::vector<std::string>& names);

/// Refuses a number out of range. `--help` shows the bounds.
CLI::Validator within(const calls::Range& range);
template <typename Number>
CLI::Validator within(Number least, Number most) {
  return within(calls::Range{least, most});
}

}  // namespace signweave::cli
