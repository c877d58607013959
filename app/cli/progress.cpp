#include "app/cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

namespace signweave::cli {

using namespace std::chrono_literals;

Progress::Progress(Io& io, std::string title, std::string stopped)
    : io_(io),
      title_(std::move(title)),
      stopped_(std::move(stopped)),
      start_(std::chrono::steady_clock::now()),
      drawn_(start_) {}

Progress::~Progress() {
  hide();
}

void Progress::hide() {
  if (visible_) io_.err << "\r\x1b[K" << std::flush;
  visible_ = false;
}

void Progress::show(double fraction) {
  if (Interrupts::noted()) {
    hide();
    throw Error(ErrorCode::cancelled, stopped_);
  }
  const auto now = std::chrono::steady_clock::now();
  if (!io_.terminal || now - start_ < 500ms || now - drawn_ < 50ms) return;
  drawn_ = now;
  visible_ = true;
  constexpr int kWidth = 30;
  const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kWidth);
  io_.err << fmt::format("\r\x1b[K{} [{}{}] {:3.0f} %", title_, std::string(static_cast<std::size_t>(full), '#'),
                         std::string(static_cast<std::size_t>(kWidth - full), '.'), fraction * 100.0)
          << std::flush;
}

}  // namespace signweave::cli
