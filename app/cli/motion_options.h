#pragma once

#include <string>

#include "signweave/formats/bvh.h"

namespace CLI {
class App;
}

namespace signweave::cli {

/// The options that say how a motion file is to be read.
struct MotionOptions {
  std::string up;
  std::string unit;
  std::string root_unit;
  std::string root_order;
  bool mirror = false;
};

void add_motion_options(CLI::App& verb, MotionOptions& options);

/// As checked by the command line's own parser.
bvh::ReadOptions read_options(const MotionOptions& options);

}  // namespace signweave::cli
