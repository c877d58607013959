#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/stream_load/connection.h"

namespace signweave::bench {

/// What came of many paced streams over a clip of time, as their client saw it.
struct Paced {
  double seconds = 0;
  std::uint64_t frames = 0;  ///< that came
  /// Frames that were left out, or came when the next one was due already.
  std::uint64_t missed = 0;
  std::uint64_t left_out = 0;  ///< of these
  /// Of each frame against its own stream's schedule, seconds, ascending. A stream's start is fitted: none of its
  /// frames came early, and one came at its time.
  std::vector<double> lateness;
  double message_bytes = 0;       ///< mean
  double server_cpu_seconds = 0;  ///< of `cpu`, over that time
  double client_cpu_seconds = 0;  ///< of this process
};

/// Reads from all of them in one loop for `seconds`, after `settle` seconds that do not count. Text messages are passed
/// over. Frames come at `rate`. `cpu` tells what the other side has used so far.
Paced receive_paced(std::vector<std::unique_ptr<Connection>>& streams, double rate, double settle, double seconds,
                    const std::function<double()>& cpu);

/// The value below which that part of ascending values lies.
double quantile(const std::vector<double>& ascending, double part);

/// The yardstick: a loop that only sends. Listens on a free port of this machine and says "listening on PORT" on
/// standard error; to each connection that sends a byte it sends `bytes` bytes, WebSocket frame and numbers of a
/// message of one frame, `rate` times a second, until all have gone. Sleeps for whole ticks, of
/// so many seconds. Where `rate` is 0 there is one stream, and it gets them as fast as it takes them.
int run_bare_sender(std::size_t streams, std::size_t bytes, double rate, double tick);

}  // namespace signweave::bench
