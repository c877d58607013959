#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "signweave/live/frame_codec.h"

namespace signweave::bench {

/// Seconds of the steady clock.
double now();

/// A client's end of one stream, cheap enough to run a thousand at a time: only the header of a message of frames is
/// read.
class Connection {
 public:
  struct Message {
    bool binary = false;
    std::string_view text;  ///< valid until the next call
    MessageHeader header;   ///< of a binary message
    std::size_t bytes = 0;  ///< including the WebSocket's header
    double at = 0;          ///< when its last byte was read
  };

  /// Connects to a port on this machine. Throws std::runtime_error if that fails.
  explicit Connection(std::uint16_t port);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Upgrades to a WebSocket. Throws if the server refuses.
  void upgrade(std::string_view target);
  /// Sends one complete text message.
  void send(std::string_view text);
  /// Sends bytes unchanged.
  void send_raw(std::string_view bytes);
  /// Reads everything until the server closes.
  std::string read_to_end();
  /// Reads the available bytes once, and calls `take(const Message&)` for each message that they complete; false if
  /// nothing was available. Throws if the server has closed.
  template <typename Take>
  bool read(Take&& take) {
    const std::span<const std::byte> bytes = receive();
    rest_ = bytes;
    while (const std::optional<Message> message = next()) take(*message);
    return !bytes.empty();
  }
  struct OwnedMessage {
    bool binary = false;
    std::string text;
    MessageHeader header;
    double at = 0;
  };
  /// Waits for the next message, for clients that receive few. Throws after some seconds.
  OwnedMessage wait();

  /// Throws if nothing arrives for some seconds.
  void wait_until_readable() const;
  int descriptor() const noexcept { return descriptor_; }

 private:
  std::span<const std::byte> receive();
  std::optional<Message> next();
  bool take_frame_header();
  void answer_control(unsigned opcode);

  int descriptor_ = -1;
  std::span<const std::byte> rest_;  // received but not processed yet; in the thread's buffer, empty between calls
  double received_at_ = 0;
  // The frame being received.
  std::array<std::uint8_t, 10> head_{};
  std::size_t head_bytes_ = 0;
  std::uint64_t payload_ = 0;  // still to be received
  // The message, which may consist of several frames.
  bool within_ = false;
  bool binary_ = false;
  std::array<std::byte, kMessageHeaderBytes> begin_{};
  std::size_t begin_bytes_ = 0;
  std::size_t bytes_ = 0;
  std::string text_;
  std::string control_;  // a ping or close may come between two frames of a message
  std::deque<OwnedMessage> waiting_;
};

/// {"type": "place", …} is of type "place". Cheap: relies on this server's messages beginning with the type.
bool is_of_type(std::string_view text, std::string_view type);

}  // namespace signweave::bench
