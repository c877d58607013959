#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/server/server.h"
#include "signweave/kv/test_folder.h"
#include "tests/demo_database.h"

/// A server on its own port, and clients that know just enough of the protocols to use it and to violate them.
namespace signweave::server::testing {

/// A database of the demo, created once for all tests of the program; not opened by any of them.
inline const std::filesystem::path& demo_folder() {
  static const kv::TestFolder folder;
  static const std::filesystem::path database = [] {
    std::filesystem::path path = folder / "demo.db";
    copy_demo_database(path, 1);
    return path;
  }();
  return database;
}

enum class Serve { for_reading, for_changes };

struct TestServer {
  explicit TestServer(ServerOptions options = {}, const std::vector<std::filesystem::path>& folders = {demo_folder()},
                      Serve serve = Serve::for_reading) {
    for (const auto& one : folders) {
      std::filesystem::path served = one;
      if (serve == Serve::for_changes) {  // a copy, because the others are shared
        served = scratch / one.filename();
        std::filesystem::copy(one, served, std::filesystem::copy_options::recursive);
      }
      databases.add(served, serve == Serve::for_changes);
    }
    options.port = 0;
    options.scratch = scratch / "scratch";
    std::filesystem::create_directories(options.scratch);
    api = std::make_unique<Api>(databases, ApiLimits{}, options.scratch);
    server = std::make_unique<Server>(databases, *api, std::move(options));
  }
  std::uint16_t port() const { return server->port(); }
  /// The number of request bodies stored on disk.
  std::size_t bodies() const {
    std::size_t count = 0;
    for (const auto& one : std::filesystem::directory_iterator(scratch / "scratch")) {
      count += one.path().filename().string().starts_with("body-") ? 1 : 0;
    }
    return count;
  }

  kv::TestFolder scratch;
  ServedDatabases databases;
  std::unique_ptr<Api> api;
  std::unique_ptr<Server> server;
};

/// A blocking TCP connection with timeouts of 120 s.
class Client {
 public:
  explicit Client(std::uint16_t port, int receive_buffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    const timeval patience{.tv_sec = 120, .tv_usec = 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  Client(Client&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), connected_(other.connected_), read_(std::move(other.read_)) {}
  Client(const Client&) = delete;
  ~Client() {
    if (socket_ >= 0) ::close(socket_);
  }

  bool connected() const { return connected_; }
  /// False if the other side has closed.
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  /// Sends as much as possible without blocking.
  ssize_t send_some(std::string_view bytes) {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  /// Reads so many bytes; fewer if the connection ends before.
  std::string read(std::size_t bytes) {
    while (read_.size() < bytes && more()) {
    }
    return take(std::min(bytes, read_.size()));
  }
  std::string read_until(std::string_view end) {
    std::size_t at = read_.find(end);
    while (at == std::string::npos && more()) at = read_.find(end);
    return take(at == std::string::npos ? read_.size() : at + end.size());
  }
  std::string read_all() {
    while (more()) {
    }
    return take(read_.size());
  }
  void finish_sending() { ::shutdown(socket_, SHUT_WR); }

 private:
  bool more() {
    char buffer[16 * 1024];
    ssize_t n = 0;
    do {  // the kernel interrupts a thread that created an io_uring when it takes the ring down
      n = ::recv(socket_, buffer, sizeof buffer, 0);
    } while (n < 0 && errno == EINTR);
    if (n <= 0) return false;
    read_.append(buffer, static_cast<std::size_t>(n));
    return true;
  }
  std::string take(std::size_t bytes) {
    std::string result = read_.substr(0, bytes);
    read_.erase(0, bytes);
    return result;
  }

  int socket_;
  bool connected_ = false;
  std::string read_;
};

struct Answer {
  int status = 0;
  std::string head;
  std::string body;
};

/// Reads one answer from a connection.
inline Answer read_answer(Client& client, bool body = true) {
  Answer answer;
  answer.head = client.read_until("\r\n\r\n");
  if (answer.head.size() > 12) answer.status = std::stoi(answer.head.substr(9));
  const std::size_t length = answer.head.find("Content-Length: ");
  if (body && length != std::string::npos) {
    answer.body = client.read(std::stoull(answer.head.substr(length + 16)));
  }
  return answer;
}

/// Sends these bytes unchanged and reads the answer.
inline Answer ask(std::uint16_t port, std::string_view request) {
  Client client(port);
  client.send(request);
  return read_answer(client);
}

inline Answer get(std::uint16_t port, const std::string& target, const std::string& headers = {}) {
  return ask(port, "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n");
}

/// Opens an upload for the database "demo" and returns the beginning of a request that sends it a file; headers are to
/// follow.
inline std::string upload_line(std::uint16_t port) {
  const Answer answer =
      ask(port, "POST /api/databases/demo/uploads HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n");
  const std::string id = nlohmann::json::parse(answer.body)["upload"];
  return "PUT /api/databases/demo/uploads/" + id + "/files/x.bvh HTTP/1.1\r\nHost: localhost\r\n";
}

/// A message of a stream.
struct StreamMessage {
  unsigned opcode = 0;  ///< 1 text, 2 binary, 8 close, 9 ping; 0 if the connection ended
  std::string bytes;
  nlohmann::json json() const { return nlohmann::json::parse(bytes); }
};

/// A client of a stream.
class StreamClient {
 public:
  explicit StreamClient(std::uint16_t port, const std::string& query = {}, const std::string& headers = {},
                        int receive_buffer = 0)
      : client(port, receive_buffer) {
    client.send("GET /api/stream" + query +
                " HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                headers + "\r\n");
    answer = read_answer(client);
  }
  static std::string frame(unsigned opcode, std::string_view payload) {
    std::string bytes(1, static_cast<char>(0x80u | opcode));
    const std::size_t more = payload.size() < 126 ? 0 : payload.size() < 65'536 ? 2 : 8;
    bytes += static_cast<char>(0x80u | (more == 0 ? payload.size() : more == 2 ? 126u : 127u));
    for (std::size_t i = 0; i < more; ++i) bytes += static_cast<char>(payload.size() >> (8 * (more - 1 - i)));
    bytes.append(4, '\0');  // a mask that changes nothing
    return bytes.append(payload);
  }
  bool say(std::string_view text) { return client.send(frame(1, text)); }
  /// Answers pings and skips them.
  StreamMessage next() {
    for (;;) {
      StreamMessage message;
      const std::string head = client.read(2);
      if (head.size() < 2) return message;
      const auto byte = [](char c) { return static_cast<std::size_t>(static_cast<unsigned char>(c)); };
      message.opcode = static_cast<unsigned>(byte(head[0]) & 15u);
      std::size_t length = byte(head[1]) & 127u;
      if (length > 125) {
        const std::string more = client.read(length == 126 ? 2 : 8);
        length = 0;
        for (const char c : more) length = length << 8 | byte(c);
      }
      message.bytes = client.read(length);
      if (message.opcode != 9) return message;
      client.send(frame(10, message.bytes));
    }
  }
  /// The next text message of this type; earlier messages are skipped.
  nlohmann::json next(std::string_view type) {
    for (;;) {
      const StreamMessage message = next();
      if (message.opcode == 0 || message.opcode == 8) return nullptr;
      if (message.opcode != 1) continue;
      nlohmann::json json = message.json();
      if (json["type"] == type) return json;
    }
  }
  /// The next message of frames; earlier messages are skipped.
  std::optional<MessageHeader> next_frames() {
    for (;;) {
      const StreamMessage message = next();
      if (message.opcode == 0 || message.opcode == 8) return std::nullopt;
      if (message.opcode != 2) continue;
      MessageHeader header;
      std::memcpy(&header.frames, message.bytes.data() + 2, 2);
      std::memcpy(&header.left_out, message.bytes.data() + 4, 4);
      std::memcpy(&header.first_frame, message.bytes.data() + 8, 8);
      return header;
    }
  }

  Client client;
  Answer answer;  ///< to the handshake
};

}  // namespace signweave::server::testing
