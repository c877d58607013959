#include "app/cli/learning.h"

#include <ostream>

#include "signweave/core/error.h"

namespace signweave::cli {

void learn(Database& database, Io& io) {
  try {
    database.learn();
  } catch (const Error& error) {
    io.err << "signweave: weights of the selection: " << one_line(error.what()) << '\n';
    io.status = 1;
  }
}

}  // namespace signweave::cli
