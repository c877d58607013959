#pragma once

#include "app/cli/command.h"
#include "signweave/database/database.h"

namespace signweave::cli {

/// After a change: what the corpus teaches of joins is learned and stored. That it could not be stored is told; what
/// was changed stays.
void learn(Database& database, Io& io);

}  // namespace signweave::cli
