#pragma once

#include <sys/socket.h>
#include <sys/uio.h>

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "app/server/metrics.h"

struct io_uring;

namespace signweave::server {

/// Collects what streams have to send at one tick, and sends it together: by one system call (io_uring), or by one
/// `send` each if the kernel refuses that. Neither blocks: when flush() returns, each sender knows how much of its
/// message was sent. Belongs to one thread.
class SendBatch {
 public:
  enum class Mode {
    one_call,   ///< if the kernel allows it; otherwise as call_each
    call_each,  ///< one `send` each
  };
  /// Two buffers sent one after the other; either may be empty.
  using Parts = std::array<std::span<const std::byte>, 2>;
  /// A sender whose messages a batch sends.
  class Sender {
   protected:
    ~Sender() = default;

   private:
    friend class SendBatch;
    /// The bytes to send; called when they are sent, and must stay valid until `sent` is called.
    virtual Parts to_send() const noexcept = 0;
    /// Reports how many bytes were sent, or a negative error number; -EAGAIN if the kernel's buffer is full.
    virtual void sent(long result) noexcept = 0;
  };

  /// Most messages sent together.
  static constexpr std::size_t kMost = 64;

  /// `by_one_call` counts the messages sent together; it must outlive the batch. Starts with call_each.
  explicit SendBatch(Counter& by_one_call);
  ~SendBatch();
  SendBatch(const SendBatch&) = delete;
  SendBatch& operator=(const SendBatch&) = delete;

  /// To be called by the sending thread, and with `call_each` before that thread ends: when the kernel takes down a
  /// ring, it interrupts the blocking calls of the thread that created it.
  void use(Mode mode);
  Mode mode() const noexcept { return ring_ ? Mode::one_call : Mode::call_each; }

  /// Messages may be added from now on, until finish().
  void collect() noexcept { collecting_ = true; }
  bool collecting() const noexcept { return collecting_; }
  /// Adds a sender that is not in the batch yet. If the batch is full, it is sent first. Sender and descriptor must
  /// stay valid until `sent` is called.
  void add(Sender& sender, int descriptor) noexcept;
  /// Sends what was added; collecting continues.
  void flush() noexcept;
  void finish() noexcept {
    flush();
    collecting_ = false;
  }

 private:
  struct Message {
    Sender* sender = nullptr;
    int descriptor = -1;
    long result = 0;
    std::array<iovec, 2> parts{};
    msghdr header{};
  };
  struct CloseRing {
    void operator()(io_uring* ring) const noexcept;
  };
  std::size_t send_by_ring() noexcept;

  Counter& by_one_call_;
  std::unique_ptr<io_uring, CloseRing> ring_;
  std::array<Message, kMost> messages_;
  std::size_t count_ = 0;
  bool collecting_ = false;
};

/// Sends without blocking; returns the bytes sent or a negative error number, as for Sender::sent.
long send_now(int descriptor, std::span<const std::byte> bytes) noexcept;

}  // namespace signweave::server
