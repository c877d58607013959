#pragma once

#include <chrono>
#include <string>

#include "app/cli/command.h"
#include "app/cli/interrupts.h"

namespace signweave::cli {

/// A progress bar on `err`: only on a terminal, only after half a second, erased when it ends. While it exists, Ctrl-C
/// ends the work in good order: the next `show` throws Error{cancelled, stopped}.
class Progress {
 public:
  Progress(Io& io, std::string title, std::string stopped = "stopped; nothing was changed");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` in [0, 1].
  void show(double fraction);
  /// Erases the bar from the terminal until it is shown again.
  void hide();

 private:
  Io& io_;
  std::string title_;
  std::string stopped_;
  Interrupts interrupts_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
  bool visible_ = false;
};

}  // namespace signweave::cli
