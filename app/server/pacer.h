#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/intrusive/list.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "app/server/send_batch.h"

namespace signweave::server {

using Clock = std::chrono::steady_clock;

/// What a pacer wakes. Belongs to the pacer's thread.
class Paced {
 public:
  static constexpr Clock::time_point kNever = Clock::time_point::max();
  /// What a tick needs of the object itself should lie at its begin, within so many bytes.
  static constexpr std::size_t kNearBytes = 192;

  Paced(const Paced&) = delete;
  virtual ~Paced() = default;

  /// Sends what is due at `now`; tells when to be woken next. The frame path: allocates nothing, locks nothing.
  virtual Clock::time_point tick(Clock::time_point now) noexcept = 0;
  /// Brings near what tick() will read and write: `near` what its own members point to, then `frame` what that points
  /// to.
  enum class Step { near, frame };
  virtual void prefetch(Step) const noexcept {}
  /// A piece of work that may wait for the ticks that are due, such as making frames ahead. True: there is more.
  virtual bool work() = 0;

 protected:
  Paced() = default;

 private:
  friend class Pacer;
  using Hook = boost::intrusive::list_member_hook<boost::intrusive::link_mode<boost::intrusive::auto_unlink>>;
  Hook waking_;   // among those of its tick
  Hook working_;  // among those that have work to do
  Clock::time_point at_ = kNever;
};

/// One timer for all paced streams of a thread. It wakes at ticks, every 2 ms, so that streams that are due within one
/// share a wake, and what they send goes out in one go; then come pieces of work, one at a time, and what falls due
/// between two of them goes first.
class Pacer {
 public:
  Pacer(boost::asio::io_context& io, SendBatch& sends);

  /// Wakes it then (at once where that is past), and no longer when it was to be woken before; kNever: not at all.
  void wake_at(Paced& paced, Clock::time_point at);
  /// Has it do a piece of work soon.
  void want_work(Paced& paced);
  void forget(Paced& paced) noexcept;

 private:
  template <Paced::Hook Paced::*hook>
  using List = boost::intrusive::list<Paced, boost::intrusive::member_hook<Paced, Paced::Hook, hook>,
                                      boost::intrusive::constant_time_size<false>>;
  void place(Paced& paced, Clock::time_point at) noexcept;
  void turn();
  void send_due() noexcept;
  void send_slot(List<&Paced::waking_>& slot, Clock::time_point now) noexcept;
  void arm();

  boost::asio::io_context& io_;
  boost::asio::steady_timer timer_;
  SendBatch& sends_;
  Clock::time_point armed_ = Paced::kNever;
  bool turning_ = false;  // within turn(), or it is posted
  /// A wheel: who is woken at tick t of the clock is in slot t % kSlots; who is woken later than the wheel reaches is
  /// in its last slot, and put further on when that comes.
  static constexpr std::int64_t kSlots = 128;
  std::array<List<&Paced::waking_>, kSlots> slots_;
  std::int64_t next_ = 0;  // the first tick that was not gone through
  List<&Paced::working_> working_;
};

}  // namespace signweave::server
