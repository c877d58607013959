#include "bench/stream_load/paced.h"

#include <sys/epoll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/stream_load/process.h"

namespace signweave::bench {
namespace {

struct Arrival {
  std::uint64_t frame;
  double at;
};

struct Arrivals {
  std::vector<Arrival> of_frames;
  std::uint64_t left_out_first = 0;
  std::uint64_t left_out_last = 0;
};

/// Of one stream: the delay of each frame.
void add_lateness(const Arrivals& arrivals, double rate, Paced& result) {
  if (arrivals.of_frames.empty()) return;
  const auto since_due = [&](const Arrival& a) { return a.at - static_cast<double>(a.frame) / rate; };
  double start = std::numeric_limits<double>::max();
  for (const Arrival& a : arrivals.of_frames) start = std::min(start, since_due(a));
  for (const Arrival& a : arrivals.of_frames) {
    const double late = since_due(a) - start;
    result.lateness.push_back(late);
    if (late >= 1 / rate) ++result.missed;
  }
  result.frames += arrivals.of_frames.size();
  result.left_out += arrivals.left_out_last - arrivals.left_out_first;
}

}  // namespace

Paced receive_paced(std::vector<std::unique_ptr<Connection>>& streams, double rate, double settle, double seconds,
                    const std::function<double()>& cpu) {
  const int epoll = epoll_create1(0);
  std::vector<Arrivals> arrivals(streams.size());
  for (std::size_t i = 0; i < streams.size(); ++i) {
    arrivals[i].of_frames.reserve(static_cast<std::size_t>(1.1 * rate * seconds) + 100);
    epoll_event event{.events = EPOLLIN, .data = {.u64 = i}};
    epoll_ctl(epoll, EPOLL_CTL_ADD, streams[i]->descriptor(), &event);
  }
  Paced result;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
  const auto receive_until = [&](double end, bool counts) {
    std::array<epoll_event, 256> events;
    while (now() < end) {
      const int ready = epoll_wait(epoll, events.data(), static_cast<int>(events.size()), 50);
      for (int i = 0; i < ready; ++i) {
        const std::size_t which = events[static_cast<std::size_t>(i)].data.u64;
        Arrivals& stream = arrivals[which];
        streams[which]->read([&](const Connection::Message& message) {
          if (!message.binary) return;
          stream.left_out_last = message.header.left_out;
          if (!counts) {
            stream.left_out_first = message.header.left_out;
            return;
          }
          ++messages;
          bytes += message.bytes;
          for (std::uint64_t frame = 0; frame < message.header.frames; ++frame) {
            stream.of_frames.push_back({message.header.first_frame + frame, message.at});
          }
        });
      }
    }
  };
  receive_until(now() + settle, false);
  const double begin = now();
  const double others_before = cpu();
  const double own_before = own_cpu_seconds();
  receive_until(begin + seconds, true);
  result.seconds = now() - begin;
  result.server_cpu_seconds = cpu() - others_before;
  result.client_cpu_seconds = own_cpu_seconds() - own_before;
  close(epoll);
  for (const Arrivals& stream : arrivals) add_lateness(stream, rate, result);
  result.missed += result.left_out;
  result.message_bytes = static_cast<double>(bytes) / static_cast<double>(std::max<std::uint64_t>(messages, 1));
  std::sort(result.lateness.begin(), result.lateness.end());
  return result;
}

double quantile(const std::vector<double>& ascending, double part) {
  if (ascending.empty()) return std::nan("");
  const auto at = static_cast<std::size_t>(part * static_cast<double>(ascending.size()));
  return ascending[std::min(at, ascending.size() - 1)];
}

}  // namespace signweave::bench
