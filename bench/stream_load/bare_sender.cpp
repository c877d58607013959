#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <queue>

#include "bench/stream_load/paced.h"

namespace signweave::bench {
namespace {

struct Receiver {
  int descriptor = -1;
  std::uint64_t frame = 0;
  double start = 0;
  std::vector<std::byte> message;  // separate for each, as in a server
};

/// A WebSocket frame with a message of one frame, `bytes` in all.
std::vector<std::byte> make_message(std::size_t bytes) {
  std::vector<std::byte> message(bytes, std::byte{1});
  const std::size_t payload = bytes - 4;
  message[0] = std::byte{0x82};
  message[1] = std::byte{126};
  message[2] = static_cast<std::byte>(payload >> 8);
  message[3] = static_cast<std::byte>(payload & 0xff);
  return message;
}

int listen_anywhere() {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(listener, reinterpret_cast<const sockaddr*>(&address), size) != 0 || listen(listener, 1024) != 0 ||
      getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    fmt::print(stderr, "cannot listen: {}\n", std::strerror(errno));
    return -1;
  }
  fmt::print(stderr, "listening on {}\n", ntohs(address.sin_port));
  return listener;
}

}  // namespace

int run_bare_sender(std::size_t streams, std::size_t bytes, double rate, double tick) {
  const bool waits = rate == 0;
  const int listener = listen_anywhere();
  if (listener < 0 || bytes < 4 + kMessageHeaderBytes || bytes > 65'000) return 1;
  const int epoll = epoll_create1(0);
  epoll_event event{.events = EPOLLIN, .data = {.u64 = streams}};
  epoll_ctl(epoll, EPOLL_CTL_ADD, listener, &event);

  struct Due {
    double at;
    std::size_t receiver;
    bool operator<(const Due& other) const { return at > other.at; }
  };
  std::vector<Receiver> receivers;
  receivers.reserve(streams);
  std::priority_queue<Due> due;
  std::size_t gone = 0;
  std::array<epoll_event, 64> events;
  const double end = now() + 300;  // if no client connects
  while (gone < streams && now() < end) {
    while (!due.empty() && due.top().at <= now()) {
      const std::size_t which = due.top().receiver;
      due.pop();
      Receiver& to = receivers[which];
      encode(MessageHeader{.frames = 1, .left_out = 0, .first_frame = to.frame},
             std::span(to.message).subspan(4, kMessageHeaderBytes));
      if (send(to.descriptor, to.message.data(), to.message.size(), MSG_NOSIGNAL | (waits ? 0 : MSG_DONTWAIT)) < 0 &&
          errno != EAGAIN) {
        ++gone;
        close(to.descriptor);
        continue;
      }
      ++to.frame;
      due.push({waits ? to.start : to.start + static_cast<double>(to.frame) / rate, which});
    }
    const double ticks = due.empty() ? 0 : std::ceil(std::max(0.0, due.top().at - now()) / tick);
    const int patience = due.empty() ? 1000 : static_cast<int>(std::lround(1e3 * ticks * tick));
    const int ready = epoll_wait(epoll, events.data(), static_cast<int>(events.size()), patience);
    for (int i = 0; i < ready; ++i) {
      const std::size_t which = events[static_cast<std::size_t>(i)].data.u64;
      if (which == streams) {
        const int descriptor = accept4(listener, nullptr, nullptr, waits ? 0 : SOCK_NONBLOCK);
        if (descriptor < 0 || receivers.size() == streams) continue;
        const int on = 1;
        setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        event.data.u64 = receivers.size();
        epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event);
        receivers.push_back({.descriptor = descriptor, .frame = 0, .start = 0, .message = make_message(bytes)});
      } else {
        char go = 0;
        if (recv(receivers[which].descriptor, &go, 1, 0) == 1) {
          receivers[which].start = now();
          due.push({receivers[which].start, which});
        } else {
          epoll_ctl(epoll, EPOLL_CTL_DEL, receivers[which].descriptor, nullptr);  // its next message will fail
        }
      }
    }
  }
  return 0;
}

}  // namespace signweave::bench
