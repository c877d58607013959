#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace signweave::server {

/// A counter that one thread increments and any thread reads.
class Counter {
 public:
  void add(std::uint64_t n = 1) noexcept {
    // One writer: no read-modify-write is needed, which would cost the frame path a locked instruction.
    value_.store(value_.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
  }
  void subtract(std::uint64_t n = 1) noexcept {
    value_.store(value_.load(std::memory_order_relaxed) - n, std::memory_order_relaxed);
  }
  std::uint64_t value() const noexcept { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> value_ = 0;
};

/// Histogram of durations: counts below each bound. One thread observes, any thread reads.
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

/// The class of a request.
enum class RouteClass { api, file, health, metrics, stream, refused };
constexpr std::size_t kRouteClasses = 6;

/// Counters of one I/O thread.
/// More than fifteen members: one per metric of /metrics.
struct alignas(64) Metrics {
  std::array<std::array<Counter, 6>, kRouteClasses> requests;  ///< [class][status / 100]
  std::array<Histogram, kRouteClasses>
      latency;             ///< [class], from the first byte of the header to the last of the answer
  Counter connections;     ///< open now
  Counter accepted;        ///< since the start
  Counter refused;         ///< because of a limit
  Counter timeouts;        ///< closed because the client was silent
  Counter streams;         ///< open now
  Counter controls;        ///< control messages received
  Counter control_errors;  ///< answered with an error
  Counter frames;          ///< sent
  Counter left_out;        ///< frames dropped
  Counter messages;        ///< messages of frames sent
  Counter bytes;           ///< in these messages
  Counter by_one_call;     ///< messages sent together with others by one system call
  Counter ticks;           ///< paced messages that were due
  Counter late;            ///< of these, late by more than half a frame
  Counter starved;         ///< times that a paced stream had no frame ready in time
  Histogram lateness;      ///< of paced messages
  Histogram prepare;       ///< of computing frames ahead
  Histogram first_frame;   ///< from the requesting control message to the first frame
};

/// Values of the server as a whole.
struct ServerState {
  bool draining = false;
  std::size_t calls = 0;      ///< being answered or waiting to be
  std::size_t databases = 0;  ///< served
};

/// Prometheus' text format, version 0.0.4, for all threads together and for the process.
std::string metrics_text(std::span<const Metrics* const> threads, const ServerState& state);

}  // namespace signweave::server
