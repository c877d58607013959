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

/// The socket under a WebSocket, with the only queue of outgoing bytes. Beast reads from it, and writes its own frames
/// (handshake, pong, close) to it, each by one call; messages of frames and text are added separately, as complete
/// WebSocket frames. So nothing can be sent between the parts of a frame, and a message of frames costs one `send`, or
/// is sent together with those of other streams (SendBatch).
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

  /// Called when everything has been sent after a part of it had to wait.
  void on_drained(std::function<void()> drained) { drained_ = std::move(drained); }
  /// Sets the owner of this socket, which the socket keeps alive while it waits.
  void held_by(std::weak_ptr<void> owner) { owner_ = std::move(owner); }

  /// True if nothing waits to be sent: a message of frames may be sent.
  bool idle() const noexcept { return rest_.empty() && queue_.empty() && !failed_ && !closing_; }
  /// Waiting bytes of text and of Beast's frames.
  std::size_t unread() const noexcept { return queue_.size() - queue_begin_; }
  /// True if the connection broke, or the client leaves more unread than allowed.
  bool failed() const noexcept { return failed_; }

  /// Sends a complete WebSocket frame, after any queued text; only while no other is being sent. While the batch
  /// collects, it is added to the batch. What the kernel does not accept immediately is sent later from the same bytes:
  /// they must stay valid and unchanged until the socket is idle.
  void send_frame(std::span<const std::byte> frame) noexcept;
  /// Sends what is still in the batch, so that idle() shows whether the client has accepted it.
  void settle() noexcept {
    if (in_batch_) sends_.flush();
  }
  /// Prefetches what send_frame() reads.
  void prefetch() const noexcept { signweave::prefetch(this, sizeof *this); }
  /// Queues a text message.
  void send_text(std::string_view text);

  // The interface of a Beast stream.
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
            // Nothing may follow a close frame.
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
  std::span<const std::byte> rest_;  // unsent rest of the current message of frames
  std::vector<std::byte> queue_;
  std::size_t queue_begin_ = 0;
  std::size_t before_rest_ = 0;  // bytes of the queue to send before `rest_`; the others follow it
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

/// Writes the header of an unmasked, final WebSocket frame, at most 10 bytes, so that it ends at `end`. Returns its
/// size.
std::size_t write_frame_header(std::byte* end, unsigned opcode, std::size_t payload) noexcept;

}  // namespace signweave::server
