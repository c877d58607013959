#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/stream_load/connection.h"

namespace signweave::bench {

/// The frames of many paced streams over a period of time, as their client saw them.
struct Paced {
  double seconds = 0;
  std::uint64_t frames = 0;  ///< received
  /// Frames that were dropped, or arrived when the next one was already due.
  std::uint64_t missed = 0;
  std::uint64_t left_out = 0;  ///< of the late frames
  /// Delay of each frame against its own stream's schedule, seconds, ascending. A stream's start is fitted so that none
  /// of its frames is early and one is on time.
  std::vector<double> lateness;
  double message_bytes = 0;       ///< mean
  double server_cpu_seconds = 0;  ///< from `cpu`, over that time
  double client_cpu_seconds = 0;  ///< of this process
};

/// Reads from all streams in one loop for `seconds`, after `settle` seconds that are not counted. Text messages are
/// skipped. Frames come at `rate`. `cpu` returns the CPU time that the server has used so far.
Paced receive_paced(std::vector<std::unique_ptr<Connection>>& streams, double rate, double settle, double seconds,
                    const std::function<double()>& cpu);

/// The quantile of ascending values at this fraction.
double quantile(const std::vector<double>& ascending, double part);

/// The yardstick: a loop that only sends. Listens on a free port of this machine and prints "listening on PORT" to
/// standard error; to each connection that sends a byte it sends `bytes` bytes, WebSocket frame and numbers of a
/// message of one frame, `rate` times per second, until all have closed. Sleeps for whole ticks, of so many seconds. If
/// `rate` is 0 there is one stream, which is sent messages as fast as it accepts them.
int run_bare_sender(std::size_t streams, std::size_t bytes, double rate, double tick);

}  // namespace signweave::bench
