#include "bench/stream_load/connection.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace signweave::bench {
namespace {

constexpr unsigned kContinuation = 0, kText = 1, kClose = 8, kPing = 9;
constexpr int kPatience = 20'000;  // milliseconds

thread_local std::array<std::byte, 1 << 18> buffer;

void wait_until_ready(int descriptor, short events) {
  pollfd waiting{.fd = descriptor, .events = events, .revents = 0};
  if (poll(&waiting, 1, kPatience) != 1) throw std::runtime_error("the server sends nothing");
}

MessageHeader header_of(std::span<const std::byte, kMessageHeaderBytes> bytes) {
  MessageHeader header;
  std::memcpy(&header.frames, &bytes[2], sizeof header.frames);
  std::memcpy(&header.left_out, &bytes[4], sizeof header.left_out);
  std::memcpy(&header.first_frame, &bytes[8], sizeof header.first_frame);
  return header;
}

}  // namespace

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Connection::Connection(std::uint16_t port) : descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int on = 1;
  setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  // On the same machine a connection is established at once, or queued.
  if (descriptor_ < 0 || (connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
                          errno != EINPROGRESS)) {
    if (descriptor_ >= 0) close(descriptor_);
    throw std::runtime_error(fmt::format("cannot connect to port {}: {}", port, std::strerror(errno)));
  }
  wait_until_ready(descriptor_, POLLOUT);
}

Connection::~Connection() {
  close(descriptor_);
}

void Connection::send_raw(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent > 0)
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    else if (errno == EAGAIN)
      wait_until_ready(descriptor_, POLLOUT);
    else
      throw std::runtime_error("the server has closed the connection");
  }
}

void Connection::upgrade(std::string_view target) {
  send_raw(
      fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                  "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n",
                  target));
  std::string answer;
  while (!answer.ends_with("\r\n\r\n")) {
    wait_until_ready(descriptor_, POLLIN);
    char one = 0;  // byte by byte, because what follows belongs to the stream
    if (recv(descriptor_, &one, 1, 0) != 1) throw std::runtime_error("refused: " + answer);
    answer += one;
  }
  if (!answer.starts_with("HTTP/1.1 101")) throw std::runtime_error("refused: " + answer);
}

std::string Connection::read_to_end() {
  std::string text;
  for (;;) {
    wait_until_ready(descriptor_, POLLIN);
    const ssize_t got = recv(descriptor_, buffer.data(), buffer.size(), 0);
    if (got <= 0) return text;
    text.append(reinterpret_cast<const char*>(buffer.data()), static_cast<std::size_t>(got));
  }
}

void Connection::send(std::string_view text) {
  // Masked, as required of a client, with zeros: the bytes are unchanged.
  std::string bytes("\x81");
  if (text.size() < 126) {
    bytes += static_cast<char>(0x80 | text.size());
  } else {
    const bool wide = text.size() > 0xffff;
    bytes += static_cast<char>(wide ? 0xff : 0xfe);
    for (int shift = wide ? 56 : 8; shift >= 0; shift -= 8) bytes += static_cast<char>(text.size() >> shift);
  }
  bytes.append(4, '\0');
  bytes += text;
  send_raw(bytes);
}

std::span<const std::byte> Connection::receive() {
  const ssize_t got = recv(descriptor_, buffer.data(), buffer.size(), 0);
  if (got == 0) throw std::runtime_error("the server has closed the connection");
  if (got < 0 && errno != EAGAIN)
    throw std::runtime_error(fmt::format("the connection broke: {}", std::strerror(errno)));
  received_at_ = now();
  return std::span(buffer).first(got > 0 ? static_cast<std::size_t>(got) : 0);
}

/// Takes bytes of a frame's header; true once it is complete.
bool Connection::take_frame_header() {
  const auto needed = [&]() -> std::size_t {
    if (head_bytes_ < 2) return 2;
    const unsigned size = head_[1] & 0x7f;
    return size == 127 ? 10u : size == 126 ? 4u : 2u;
  };
  while (head_bytes_ < needed()) {
    if (rest_.empty()) return false;
    head_[head_bytes_++] = std::to_integer<std::uint8_t>(rest_.front());
    rest_ = rest_.subspan(1);
  }
  if (within_) return true;
  within_ = true;
  payload_ = head_[1] & 0x7f;
  if (head_bytes_ > 2) {
    payload_ = 0;
    for (std::size_t i = 2; i < head_bytes_; ++i) payload_ = payload_ << 8 | head_[i];
  }
  const unsigned opcode = head_[0] & 0x0f;
  if (opcode >= kClose) {
    control_.clear();
  } else if (opcode != kContinuation) {
    binary_ = opcode != kText;
    begin_bytes_ = bytes_ = 0;
    text_.clear();
  }
  bytes_ += head_bytes_;
  return true;
}

std::optional<Connection::Message> Connection::next() {
  while (take_frame_header()) {
    const auto part = rest_.first(std::min<std::uint64_t>(payload_, rest_.size()));
    rest_ = rest_.subspan(part.size());
    payload_ -= part.size();
    bytes_ += part.size();
    const unsigned opcode = head_[0] & 0x0f;
    if (opcode >= kClose) {
      control_.append(reinterpret_cast<const char*>(part.data()), part.size());
    } else if (binary_) {
      const auto begin = part.first(std::min(part.size(), begin_.size() - begin_bytes_));
      std::ranges::copy(begin, begin_.begin() + static_cast<std::ptrdiff_t>(begin_bytes_));
      begin_bytes_ += begin.size();
    } else {
      text_.append(reinterpret_cast<const char*>(part.data()), part.size());
    }
    if (payload_ > 0) return std::nullopt;
    const bool last = (head_[0] & 0x80) != 0;
    within_ = false;
    head_bytes_ = 0;
    if (opcode >= kClose) {
      answer_control(opcode);
    } else if (last) {
      Message message{.binary = binary_, .text = text_, .header = {}, .bytes = bytes_, .at = received_at_};
      if (binary_) message.header = header_of(begin_);
      return message;
    }
  }
  return std::nullopt;
}

void Connection::answer_control(unsigned opcode) {
  if (opcode == kClose) {
    throw std::runtime_error("the server closes the stream: " +
                             control_.substr(std::min<std::size_t>(2, control_.size())));
  }
  if (opcode != kPing) return;
  std::string pong("\x8a");
  pong += static_cast<char>(0x80 | control_.size());
  pong.append(4, '\0');
  send_raw(pong + control_);
}

void Connection::wait_until_readable() const {
  wait_until_ready(descriptor_, POLLIN);
}

Connection::OwnedMessage Connection::wait() {
  while (waiting_.empty()) {
    wait_until_readable();
    read([&](const Message& m) { waiting_.push_back({m.binary, std::string(m.text), m.header, m.at}); });
  }
  OwnedMessage message = std::move(waiting_.front());
  waiting_.pop_front();
  return message;
}

bool is_of_type(std::string_view text, std::string_view type) {
  constexpr std::string_view kBegin = "{\"type\":\"";
  return text.starts_with(kBegin) && text.substr(kBegin.size()).starts_with(type) &&
         text.substr(kBegin.size() + type.size()).starts_with('"');
}

}  // namespace signweave::bench
