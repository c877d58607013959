#include "app/server/stream_socket.h"

#include <algorithm>
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

SendBatch::Parts StreamSocket::to_send() const noexcept {
  const std::size_t first = rest_.empty() ? unread() : before_rest_;
  return {std::span(queue_).subspan(queue_begin_, first), rest_};
}

/// To be called when this many bytes of to_send() were sent.
void StreamSocket::took(std::size_t bytes) noexcept {
  const std::size_t of_queue = std::min(bytes, to_send()[0].size());
  queue_begin_ += of_queue;
  before_rest_ -= std::min(before_rest_, of_queue);
  rest_ = rest_.subspan(bytes - of_queue);
  if (queue_begin_ < queue_.size()) return;
  queue_begin_ = 0;
  queue_.clear();
  if (queue_.capacity() > 16 * 1024) queue_ = {};  // a header is long, what follows is not
}

void StreamSocket::send_soon() noexcept {
  if (waiting_ || in_batch_) return;  // it is sent after what is waiting
  if (!sends_.collecting()) return flush();
  in_batch_ = true;
  sends_.add(*this, socket_.native_handle());
}

void StreamSocket::send_frame(std::span<const std::byte> frame) noexcept {
  if (failed_) return;
  rest_ = frame;
  before_rest_ = unread();
  send_soon();
}

void StreamSocket::sent(long result) noexcept {
  in_batch_ = false;
  if (result >= 0) {
    took(static_cast<std::size_t>(result));
  } else if (result != -EAGAIN && result != -EINTR) {
    return close();
  }
  flush();
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
  send_soon();
  if (queue_begin_ > 64 * 1024) {  // otherwise the queue would grow if a client always leaves a little
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(queue_begin_));
    queue_begin_ = 0;
  }
  if (unread() > most_unread_) close();
}

void StreamSocket::flush() noexcept {
  while (!failed_ && !(rest_.empty() && queue_.empty())) {
    const SendBatch::Parts parts = to_send();
    const long n = send_now(socket_.native_handle(), parts[0].empty() ? parts[1] : parts[0]);
    if (n >= 0) {
      took(static_cast<std::size_t>(n));
    } else if (n == -EAGAIN) {
      return wait();
    } else if (n != -EINTR) {
      close();
    }
  }
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
  settle();
  failed_ = true;
  rest_ = {};
  queue_.clear();
  queue_begin_ = 0;
  before_rest_ = 0;
  boost::system::error_code error;
  socket_.close(error);
}

}  // namespace signweave::server
