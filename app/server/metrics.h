#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace signweave::server {

/// A number that one thread counts up and any thread reads.
class Counter {
 public:
  void add(std::uint64_t n = 1) noexcept {
    // One writer: no read-modify-write needed, which would cost the frame path a locked instruction.
    value_.store(value_.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
  }
  void subtract(std::uint64_t n = 1) noexcept {
    value_.store(value_.load(std::memory_order_relaxed) - n, std::memory_order_relaxed);
  }
  std::uint64_t value() const noexcept { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> value_ = 0;
};

/// How many durations lay below each bound. One thread observes, any thread reads.
class Histogram {
 public:
  /// Upper bounds of the buckets, seconds.
  static constexpr std::array kBounds = {0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01,
                                         0.025,  0.05,    0.1,    0.25,  0.5,    1.0,   2.5};
  void observe(double seconds) noexcept;
  std::uint64_t bucket(std::size_t i) const noexcept { return buckets_[i].value(); }
  double sum() const noexcept { return static_cast<double>(nanoseconds_.value()) * 1e-9; }

 private:
  std::array<Counter, kBounds.size() + 1> buckets_;
  Counter nanoseconds_;
};

/// What a request was for.
enum class RouteClass { api, file, health, metrics, stream, refused };
constexpr std::size_t kRouteClasses = 6;

/// What one I/O thread counts.
/// More than fifteen members: a number of /metrics each.
struct alignas(64) Metrics {
  std::array<std::array<Counter, 6>, kRouteClasses> requests;  ///< [class][status / 100]
  std::array<Histogram, kRouteClasses> latency;  ///< [class], first byte of the header to last of the answer
  Counter connections;                           ///< open now
  Counter accepted;                              ///< ever
  Counter refused;                               ///< at a limit
  Counter timeouts;                              ///< closed for their silence
  Counter streams;                               ///< open now
  Counter controls;                              ///< control messages taken
  Counter control_errors;                        ///< answered by an error
  Counter frames;                                ///< sent
  Counter left_out;                              ///< frames
  Counter messages;                              ///< of frames, sent
  Counter bytes;                                 ///< of these
  Counter by_one_call;                           ///< of the messages, sent with others by one call of the kernel
  Counter ticks;                                 ///< paced messages that were due
  Counter late;                                  ///< of these, by more than half a frame
  Counter starved;                               ///< times that a paced stream had no frame made in time
  Histogram lateness;                            ///< of paced messages
  Histogram prepare;                             ///< of making frames ahead
  Histogram first_frame;                         ///< from the control message that asks to the first frame
};

/// What the server as a whole knows.
struct ServerState {
  bool draining = false;
  std::size_t calls = 0;      ///< being answered or waiting for it
  std::size_t databases = 0;  ///< served
};

/// Prometheus' text form, version 0.0.4, of all threads together and of the process.
std::string metrics_text(std::span<const Metrics* const> threads, const ServerState& state);

}  // namespace signweave::server
