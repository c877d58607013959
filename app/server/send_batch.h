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

/// What streams have to send at one tick, collected and then sent in one go: all of it by one call of the kernel
/// (io_uring), or by one `send` after the other where the kernel refuses that. Nothing waits, either way: when flush()
/// returns, each knows how much of its message went out. Belongs to one thread.
class SendBatch {
 public:
  enum class Way {
    one_call,   ///< where the kernel lets us; else as call_each
    call_each,  ///< a `send` for each
  };
  /// What goes out one after the other; either may be empty.
  using Parts = std::array<std::span<const std::byte>, 2>;
  /// What a batch sends for.
  class Sender {
   protected:
    ~Sender() = default;

   private:
    friend class SendBatch;
    /// What is to be sent; asked for when it is, and must stay as it is until `sent` is called.
    virtual Parts to_send() const noexcept = 0;
    /// How many bytes went out, or an error number, negative; -EAGAIN where the kernel has no room.
    virtual void sent(long result) noexcept = 0;
  };

  /// Messages that are sent in one go at most.
  static constexpr std::size_t kMost = 64;

  /// `by_one_call` counts the messages that went out so; it must outlive the batch. Sends by a call for each at first.
  explicit SendBatch(Counter& by_one_call);
  ~SendBatch();
  SendBatch(const SendBatch&) = delete;
  SendBatch& operator=(const SendBatch&) = delete;

  /// To be called by the thread that sends, and with `call_each` before that ends: the kernel interrupts what a thread
  /// waits for when it takes down a ring that this thread made.
  void use(Way way);
  Way way() const noexcept { return ring_ ? Way::one_call : Way::call_each; }

  /// From now on messages may be added; until finish().
  void collect() noexcept { collecting_ = true; }
  bool collecting() const noexcept { return collecting_; }
  /// Adds a sender that is not in the batch. Sends first what there is, where the batch is full. Sender and descriptor
  /// must stay until `sent` is called.
  void add(Sender& sender, int descriptor) noexcept;
  /// Sends what there is; collects on.
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

/// So many of these bytes went out without waiting, or what went wrong: as Sender::sent is given.
long send_now(int descriptor, std::span<const std::byte> bytes) noexcept;

}  // namespace signweave::server
