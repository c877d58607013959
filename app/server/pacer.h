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

/// An object woken by a pacer. Belongs to the pacer's thread.
class Paced {
 public:
  static constexpr Clock::time_point kNever = Clock::time_point::max();
  /// The members that a tick needs should be at the object's beginning, within this many bytes.
  static constexpr std::size_t kNearBytes = 192;

  Paced(const Paced&) = delete;
  virtual ~Paced() = default;

  /// Sends what is due at `now`; returns when to be woken next. The frame path: allocates nothing, locks nothing.
  virtual Clock::time_point tick(Clock::time_point now) noexcept = 0;
  /// Prefetches what tick() will read and write: `near` what the object's members point to, then `frame` what that
  /// points to.
  enum class Step { near, frame };
  virtual void prefetch(Step) const noexcept {}
  /// A piece of work that can wait until due ticks are done, such as computing frames ahead. Returns true if there is
  /// more.
  virtual bool work() = 0;

 protected:
  Paced() = default;

 private:
  friend class Pacer;
  using Hook = boost::intrusive::list_member_hook<boost::intrusive::link_mode<boost::intrusive::auto_unlink>>;
  Hook waking_;   // in the list of its tick
  Hook working_;  // in the list of objects that have work to do
  Clock::time_point at_ = kNever;
};

/// One timer for all paced streams of a thread. It wakes at ticks, every 2 ms, so that streams due within one tick
/// share a wake-up and their messages are sent together; then pieces of work run, one at a time, and what falls due
/// between two of them goes first.
class Pacer {
 public:
  Pacer(boost::asio::io_context& io, SendBatch& sends);

  /// Wakes the object at `at` (immediately if that is past), replacing any earlier wake-up; kNever: not at all.
  void wake_at(Paced& paced, Clock::time_point at);
  /// Schedules a piece of work of the object.
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
  bool turning_ = false;  // turn() is running or posted
  /// A timing wheel: an object due at tick t of the clock is in slot t % kSlots; an object due later than the wheel
  /// reaches is in the last slot, and is moved on when that slot comes.
  static constexpr std::int64_t kSlots = 128;
  std::array<List<&Paced::waking_>, kSlots> slots_;
  std::int64_t next_ = 0;  // the first tick not processed yet
  List<&Paced::working_> working_;
};

}  // namespace signweave::server
