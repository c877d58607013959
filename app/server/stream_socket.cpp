#include "app/server/stream_socket.h"

#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace signweave::server {
namespace {

constexpr unsigned kText = 1;

}  // namespace

std::size_t write_frame_header(std::byte* end, unsigned opcode, std::size_t payload) noexcept {
  const std::size_t more = payload < 126 ? 0 : payload <= 0xffff ? 2 : 8;
  std::byte* to = end - 2 - more;
  *to++ = static_cast<std::byte>(0x80u | opcode);
  *to++ = static_cast<std::byte>(more == 0 ? payload : more == 2 ? 126 : 127);
  for (std::size_t i = 0; i < more; ++i) *to++ = static_cast<std::byte>(payload >> (8 * (more - 1 - i)) & 0xff);
  return 2 + more;
}

std::size_t StreamSocket::send_some(std::span<const std::byte> bytes) noexcept {
  std::size_t sent = 0;
  while (sent < bytes.size() && !failed_) {
    const ssize_t n =
        ::send(socket_.native_handle(), bytes.data() + sent, bytes.size() - sent, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n >= 0) {
      sent += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      break;
    } else if (errno != EINTR) {
      close();
    }
  }
  return sent;
}

void StreamSocket::send_frame(std::span<const std::byte> frame) noexcept {
  if (failed_) return;
  rest_ = frame.subspan(send_some(frame));
  if (!rest_.empty() && !failed_) wait();
}

void StreamSocket::send_text(std::string_view text) {
  if (failed_ || closing_) return;
  std::byte header[10];
  const std::size_t length = write_frame_header(header + sizeof header, kText, text.size());
  const std::byte* begin = header + sizeof header - length;
  queue_.insert(queue_.end(), begin, begin + length);
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  queue_.insert(queue_.end(), bytes, bytes + text.size());
  queued();
}

void StreamSocket::queued() {
  if (!waiting_) flush();
  if (queue_begin_ > 64 * 1024) {  // or a client that always leaves a little would let it grow
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(queue_begin_));
    queue_begin_ = 0;
  }
  if (unread() > most_unread_) close();
}

void StreamSocket::flush() noexcept {
  rest_ = rest_.subspan(send_some(rest_));
  if (rest_.empty()) {
    queue_begin_ += send_some(std::span<const std::byte>(queue_).subspan(queue_begin_));
    if (queue_begin_ == queue_.size()) {
      queue_begin_ = 0;
      queue_.clear();
      if (queue_.capacity() > 16 * 1024) queue_ = {};  // a header is long, what follows is not
    }
  }
  if (!failed_ && !(rest_.empty() && queue_.empty())) wait();
}

void StreamSocket::wait() {
  if (waiting_) return;
  waiting_ = true;
  socket_.async_wait(boost::asio::ip::tcp::socket::wait_write,
                     [this, owner = owner_.lock()](boost::system::error_code error) {
                       waiting_ = false;
                       if (error || failed_) return;
                       flush();
                       if (idle() && drained_) drained_();
                     });
}

void StreamSocket::close() noexcept {
  failed_ = true;
  rest_ = {};
  queue_.clear();
  queue_begin_ = 0;
  boost::system::error_code error;
  socket_.close(error);
}

}  // namespace signweave::server
