#pragma once

#include <string>

#include "app/calls/rig_json.h"
#include "app/cli/command.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave::cli {

/// The map of a motion, with the mapping file of `--rig` where `path` is not empty.
RigMap rig_map_of(const Motion& motion, const std::string& path);

/// A row for every part, a row for every finger; what is missing goes to `err`, told of `where`.
void print_rig(const Skeleton& skeleton, const RigMap& map, const std::string& where, Io& io);

}  // namespace signweave::cli
