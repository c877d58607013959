#include "app/cli/interrupts.h"

#include <csignal>

namespace signweave::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void note(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupts::Interrupts() : int_(std::signal(SIGINT, note)), term_(std::signal(SIGTERM, note)) {
  // Signals that were ignored stay ignored, as for background jobs of a shell.
  if (int_ == SIG_IGN) std::signal(SIGINT, SIG_IGN);
  if (term_ == SIG_IGN) std::signal(SIGTERM, SIG_IGN);
}

Interrupts::~Interrupts() {
  std::signal(SIGINT, int_);
  std::signal(SIGTERM, term_);
}

bool Interrupts::noted() noexcept {
  return interrupted != 0;
}

}  // namespace signweave::cli
