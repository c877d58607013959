#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace signweave::server {

/// Limits per client, per address and in total. A request beyond them is refused with a clear answer.
/// More than fifteen members: one per limit.
struct ServerLimits {
  // Connections.
  std::size_t connections = 4'096;
  std::size_t connections_per_address = 0;  ///< 0: no limit
  double requests_per_second = 0;           ///< per address, on average; 0: no limit
  double request_burst = 200;               ///< per address, at once

  // Requests.
  std::uint32_t header_bytes = 16 * 1024;
  std::size_t target_bytes = 8 * 1024;
  std::uint64_t body_bytes = 1 << 20;    ///< of a body that is held in memory
  std::uint64_t score_bytes = 32 << 20;  ///< of a score, which is held in memory as well; a sign takes about 2,000
  std::uint64_t file_bytes = 2'000'000'000;
  std::uint64_t held_bytes = 512 << 20;  ///< of all bodies and answers held in memory; one alone may exceed it
  std::size_t calls = 64;                ///< being answered or waiting to be
  std::chrono::milliseconds header_time{
      10'000};  ///< from the connection, or the request's first byte, to the last byte of its header
  std::chrono::milliseconds body_time{30'000};   ///< without receiving a byte of a body, or sending one of an answer
  std::chrono::milliseconds keep_alive{60'000};  ///< between requests

  // Streams.
  std::size_t streams = 2'000;
  std::size_t control_bytes = 64 * 1024;      ///< of one control message
  double control_rate = 200;                  ///< control messages per second, on average; further ones wait to be read
  std::size_t unread_bytes = 256 * 1024;      ///< of answers that a client does not read, before it is closed
  std::size_t message_bytes = 256 * 1024;     ///< of one message of frames: batches are shortened to fit
  int send_buffer = 64 * 1024;                ///< SO_SNDBUF; the kernel doubles it
  std::chrono::milliseconds silence{60'000};  ///< of a stream's client, including pongs, before it is closed
  std::chrono::milliseconds close_time{
      5'000};  ///< for a stream that is being closed, until its client has received everything

  std::chrono::milliseconds drain{10'000};  ///< for running work when the server is stopped
};

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;                 ///< 0: any free port
  std::size_t threads = 2;                   ///< that serve connections and streams
  std::size_t workers = 2;                   ///< that answer calls
  std::filesystem::path files;               ///< static files; empty: a small built-in page
  std::filesystem::path scratch;             ///< for request bodies stored in files; must exist
  std::string token;                         ///< empty: not required
  std::vector<std::string> allowed_origins;  ///< in addition to the server's own: "https://signs.example.org"
  bool io_uring = true;  ///< streams use it to send everything due at one tick, if the kernel allows it
  ServerLimits limits;
};

}  // namespace signweave::server
