#pragma once

#include <boost/asio/async_result.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/role.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "app/server/send_batch.h"
#include "signweave/core/prefetch.h"

namespace signweave::server {

/// The socket under a WebSocket, and the one queue of what goes out on it. Beast reads from it, and writes its own
/// frames (handshake, pong, close) to it, each by one call; messages of frames and of text come in beside, as whole
/// WebSocket frames. So nothing can come between the parts of a frame, and a message of frames costs one `send`, or
/// goes out with those of other streams (SendBatch).
class StreamSocket final : private SendBatch::Sender {
 public:
  using executor_type = boost::asio::ip::tcp::socket::executor_type;

  /// `sends` must outlive it.
  StreamSocket(boost::asio::ip::tcp::socket socket, std::size_t most_unread, SendBatch& sends)
      : socket_(std::move(socket)), most_unread_(most_unread), sends_(sends) {}
  StreamSocket(const StreamSocket&) = delete;
  ~StreamSocket() { settle(); }

  executor_type get_executor() { return socket_.get_executor(); }
  boost::asio::ip::tcp::socket& socket() noexcept { return socket_; }

  /// Called when all has gone out after not all could.
  void on_drained(std::function<void()> drained) { drained_ = std::move(drained); }
  /// Keeps what holds this socket alive while it waits.
  void held_by(std::weak_ptr<void> owner) { owner_ = std::move(owner); }

  /// True where nothing waits to go out: a message of frames may be sent.
  bool idle() const noexcept { return rest_.empty() && queue_.empty() && !failed_ && !closing_; }
  /// Bytes of text and of Beast's frames that wait.
  std::size_t unread() const noexcept { return queue_.size() - queue_begin_; }
  /// True where the connection broke, or the client leaves more unread than it may.
  bool failed() const noexcept { return failed_; }

  /// Sends a whole WebSocket frame, after the text that there is; only while no other is under way. While the batch
  /// collects, it goes out with that. What the kernel does not take at once goes out later, from these same bytes: they
  /// must stay as they are until the socket is idle.
  void send_frame(std::span<const std::byte> frame) noexcept;
  /// Sends now what is still in the batch, so that idle() tells what the client took.
  void settle() noexcept {
    if (in_batch_) sends_.flush();
  }
  /// Brings near what send_frame() reads.
  void prefetch() const noexcept { signweave::prefetch(this, sizeof *this); }
  /// Queues a text message.
  void send_text(std::string_view text);

  // What Beast asks of a stream.
  template <typename Buffers, typename Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return socket_.async_read_some(buffers, std::forward<Handler>(handler));
  }
  template <typename Buffers, typename Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    return boost::asio::async_initiate<Handler, void(boost::system::error_code, std::size_t)>(
        [this](auto&& done, const Buffers& what) {
          const std::size_t size = boost::asio::buffer_size(what);
          if (!failed_) {
            const std::size_t before = queue_.size();
            queue_.resize(before + size);
            boost::asio::buffer_copy(boost::asio::buffer(queue_.data() + before, size), what);
            // After a close frame nothing may follow.
            closing_ = closing_ || (size > 0 && queue_[before] == kCloseFrame);
            queued();
          }
          boost::system::error_code error;
          if (failed_) error = boost::asio::error::connection_aborted;
          boost::asio::post(socket_.get_executor(),
                            boost::beast::bind_handler(std::forward<decltype(done)>(done), error, failed_ ? 0 : size));
        },
        handler, buffers);
  }
  void close() noexcept;

 private:
  static constexpr std::byte kCloseFrame{0x88};
  SendBatch::Parts to_send() const noexcept override;
  void sent(long result) noexcept override;
  void took(std::size_t bytes) noexcept;
  void send_soon() noexcept;
  void queued();
  void flush() noexcept;
  void wait();

  boost::asio::ip::tcp::socket socket_;
  std::size_t most_unread_;
  SendBatch& sends_;
  std::span<const std::byte> rest_;  // of the message of frames that is under way
  std::vector<std::byte> queue_;
  std::size_t queue_begin_ = 0;
  std::size_t before_rest_ = 0;  // bytes of the queue that go before it; the others go after it
  bool in_batch_ = false;
  bool waiting_ = false;
  bool failed_ = false;
  bool closing_ = false;  // Beast has written a close frame
  std::function<void()> drained_;
  std::weak_ptr<void> owner_;
};

inline void beast_close_socket(StreamSocket& socket) {
  socket.close();
}
template <typename Handler>
void async_teardown(boost::beast::role_type, StreamSocket& socket, Handler&& handler) {
  boost::system::error_code error;
  if (socket.unread() == 0) socket.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, error);
  boost::asio::post(socket.get_executor(),
                    boost::beast::bind_handler(std::forward<Handler>(handler), boost::system::error_code{}));
}
inline void teardown(boost::beast::role_type, StreamSocket& socket, boost::system::error_code& error) {
  error = {};
  socket.close();
}

/// The header of an unmasked, final WebSocket frame; at most 10 bytes, written so that they end at `end`. Returns how
/// many there are.
std::size_t write_frame_header(std::byte* end, unsigned opcode, std::size_t payload) noexcept;

}  // namespace signweave::server
