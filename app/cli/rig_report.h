#pragma once

#include <string>

#include "app/cli/command.h"
#include "signweave/calls/rig_answer.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave::cli {

/// The rig map of a motion, using the mapping file of `--rig` if `path` is not empty.
RigMap rig_map_of(const Motion& motion, const std::string& path);

/// A row for every part and for every finger; missing parts are reported on `err`, prefixed with `where`.
void print_rig(const Skeleton& skeleton, const RigMap& map, const std::string& where, Io& io);

}  // namespace signweave::cli
