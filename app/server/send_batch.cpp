#include "app/server/send_batch.h"

#include <liburing.h>
#include <sys/socket.h>

#include <cassert>
#include <cerrno>

namespace signweave::server {
namespace {

constexpr int kFlags = MSG_DONTWAIT | MSG_NOSIGNAL;

/// Linux can send by io_uring since 5.6; seccomp or the system's settings may forbid it nevertheless.
bool sends(io_uring& ring) noexcept {
  io_uring_probe* const probe = io_uring_get_probe_ring(&ring);
  if (probe == nullptr) return false;
  const bool supported =
      io_uring_opcode_supported(probe, IORING_OP_SEND) != 0 && io_uring_opcode_supported(probe, IORING_OP_SENDMSG) != 0;
  io_uring_free_probe(probe);
  return supported;
}

}  // namespace

long send_now(int descriptor, std::span<const std::byte> bytes) noexcept {
  const ssize_t n = ::send(descriptor, bytes.data(), bytes.size(), kFlags);
  return n >= 0 ? n : -errno;
}

void SendBatch::CloseRing::operator()(io_uring* ring) const noexcept {
  io_uring_queue_exit(ring);
  delete ring;
}

SendBatch::SendBatch(Counter& by_one_call) : by_one_call_(by_one_call) {}

void SendBatch::use(Mode mode) {
  flush();
  ring_.reset();
  if (mode == Mode::call_each) return;
  auto ring = std::make_unique<io_uring>();
  if (io_uring_queue_init(kMost, ring.get(), 0) != 0) return;
  ring_.reset(ring.release());
  if (!sends(*ring_)) ring_.reset();
}

SendBatch::~SendBatch() = default;

void SendBatch::add(Sender& sender, int descriptor) noexcept {
  assert(collecting_);
  if (count_ == kMost) flush();
  Message& message = messages_[count_++];
  message.sender = &sender;
  message.descriptor = descriptor;
}

void SendBatch::flush() noexcept {
  const std::size_t count = count_;
  if (count == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    Message& message = messages_[i];
    const Parts parts = message.sender->to_send();
    std::size_t used = 0;
    for (const std::span<const std::byte> part : parts) {
      if (!part.empty()) message.parts[used++] = {const_cast<std::byte*>(part.data()), part.size()};
    }
    message.header = {};
    message.header.msg_iov = message.parts.data();
    message.header.msg_iovlen = used;
  }
  const std::size_t sent = ring_ ? send_by_ring() : 0;
  for (std::size_t i = sent; i < count; ++i) {
    const ssize_t n = ::sendmsg(messages_[i].descriptor, &messages_[i].header, kFlags);
    messages_[i].result = n >= 0 ? n : -errno;
  }
  count_ = 0;
  for (std::size_t i = 0; i < count; ++i) messages_[i].sender->sent(messages_[i].result);
}

/// Returns how many of the messages, from the first on, the kernel accepted through the ring. If these are not all, the
/// ring is destroyed.
std::size_t SendBatch::send_by_ring() noexcept {
  io_uring* const ring = ring_.get();
  for (std::size_t i = 0; i < count_; ++i) {
    Message& message = messages_[i];
    io_uring_sqe* const entry =
        io_uring_get_sqe(ring);  // the ring has as many entries as there are messages, and none is unsubmitted
    if (message.header.msg_iovlen == 1) {  // cheaper
      io_uring_prep_send(entry, message.descriptor, message.parts[0].iov_base, message.parts[0].iov_len, kFlags);
    } else {
      io_uring_prep_sendmsg(entry, message.descriptor, &message.header, kFlags);
    }
    entry->user_data = i;
    message.result = -EIO;
  }
  std::size_t taken = 0;
  while (taken < count_) {
    const int n = io_uring_submit(ring);
    if (n <= 0 && n != -EINTR) break;
    if (n > 0) taken += static_cast<std::size_t>(n);
  }
  // Sends that must not block are finished when they are accepted: the results are available.
  std::size_t seen = 0;
  while (seen < taken) {
    io_uring_cqe* done = nullptr;
    const int error = io_uring_wait_cqe(ring, &done);
    if (error == -EINTR) continue;
    if (error != 0) break;  // it is unknown what was sent of the remaining messages
    messages_[done->user_data].result = done->res;
    io_uring_cqe_seen(ring, done);
    ++seen;
  }
  by_one_call_.add(taken);
  if (seen < count_) ring_.reset();
  return taken;
}

}  // namespace signweave::server
