#pragma once

#include <chrono>
#include <string>

#include "app/cli/command.h"

namespace signweave::cli {

/// A progress bar on `err`: only on a terminal, only after half a second, gone when it ends.
class Progress {
 public:
  Progress(Io& io, std::string title);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` in [0, 1].
  void show(double fraction);
  /// Takes the bar off the terminal until it is shown again.
  void hide();

 private:
  Io& io_;
  std::string title_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
  bool visible_ = false;
};

}  // namespace signweave::cli
