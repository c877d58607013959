#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/intrusive/list.hpp>
#include <chrono>
#include <cstddef>
#include <vector>

namespace signweave::server {

using Clock = std::chrono::steady_clock;

/// What a pacer wakes. Belongs to the pacer's thread.
class Paced : public boost::intrusive::list_base_hook<boost::intrusive::link_mode<boost::intrusive::auto_unlink>> {
 public:
  static constexpr Clock::time_point kNever = Clock::time_point::max();

  Paced(const Paced&) = delete;
  virtual ~Paced() = default;

  /// Sends what is due at `now`; tells when to be woken next. The frame path: allocates nothing, locks nothing.
  virtual Clock::time_point tick(Clock::time_point now) noexcept = 0;
  /// A piece of work that may wait for the ticks that are due, such as making frames ahead. True: there is more.
  virtual bool work() = 0;

 protected:
  Paced() = default;

 private:
  friend class Pacer;
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  std::size_t slot_ = kNowhere;  // in the pacer's heap
};

/// One timer for all paced streams of a thread. It wakes on whole milliseconds, so that streams that are due within one
/// share a wake; then come pieces of work, one at a time, and what falls due between two of them goes first.
class Pacer {
 public:
  explicit Pacer(boost::asio::io_context& io);

  /// Wakes it then (at once where that is past), and no longer when it was to be woken before; kNever: not at all.
  void wake_at(Paced& paced, Clock::time_point at);
  /// Has it do a piece of work soon.
  void want_work(Paced& paced);
  void forget(Paced& paced) noexcept;

 private:
  struct Slot {
    Clock::time_point at;
    Paced* paced;
  };
  void turn();
  void send_due();
  void arm();
  void place(std::size_t slot, Slot what) noexcept;
  void up(std::size_t slot) noexcept;
  void down(std::size_t slot) noexcept;

  boost::asio::io_context& io_;
  boost::asio::steady_timer timer_;
  Clock::time_point armed_ = Paced::kNever;
  bool turning_ = false;  // within turn(), or it is posted
  std::vector<Slot> heap_;
  boost::intrusive::list<Paced, boost::intrusive::constant_time_size<false>> working_;
};

}  // namespace signweave::server
