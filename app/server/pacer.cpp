#include "app/server/pacer.h"

#include <algorithm>
#include <boost/asio/post.hpp>

#include "signweave/core/prefetch.h"

namespace signweave::server {
namespace {

using Ticks = std::chrono::duration<std::int64_t, std::ratio<2, 1'000>>;
constexpr Ticks kTick{1};
/// After this time the sockets are polled, whatever work is left.
constexpr std::chrono::milliseconds kTurn{2};

std::int64_t tick_at(Clock::time_point at) {
  return std::chrono::ceil<Ticks>(at.time_since_epoch()).count();
}
std::int64_t last_tick(Clock::time_point now) {
  return std::chrono::floor<Ticks>(now.time_since_epoch()).count();
}

}  // namespace

Pacer::Pacer(boost::asio::io_context& io, SendBatch& sends) : io_(io), timer_(io), sends_(sends) {}

void Pacer::place(Paced& paced, Clock::time_point at) noexcept {
  paced.waking_.unlink();
  paced.at_ = at;
  if (at == Paced::kNever) return;
  // The slot before next_ may be the one being processed, so nothing is added to it.
  const std::int64_t tick = std::clamp(tick_at(at), next_, next_ + kSlots - 2);
  slots_[static_cast<std::size_t>(tick % kSlots)].push_back(paced);
}

void Pacer::wake_at(Paced& paced, Clock::time_point at) {
  place(paced, at);
  if (!turning_) arm();
}

void Pacer::want_work(Paced& paced) {
  if (!paced.working_.is_linked()) working_.push_back(paced);
  if (!turning_) arm();
}

void Pacer::forget(Paced& paced) noexcept {
  place(paced, Paced::kNever);
  paced.working_.unlink();
}

void Pacer::send_due() noexcept {
  const Clock::time_point now = Clock::now();
  const std::int64_t last = last_tick(now);
  next_ = std::max(next_, last - kSlots + 1);  // there is nothing more than one turn of the wheel
  sends_.collect();
  while (next_ <= last) {
    auto& slot = slots_[static_cast<std::size_t>(next_ % kSlots)];
    ++next_;  // nothing is added to this slot from now on
    send_slot(slot, now);
  }
  sends_.finish();
}

/// The data of hundreds of streams is no longer in the cache when their turn comes: it is prefetched step by step while
/// earlier streams are sent.
void Pacer::send_slot(List<&Paced::waking_>& slot, Clock::time_point now) noexcept {
  constexpr std::size_t kAhead = 3;
  std::array<const Paced*, kAhead> coming{};  // the next, the one after it, and the third
  auto further = slot.begin();
  const auto look_further = [&] {
    std::shift_left(coming.begin(), coming.end(), 1);
    coming.back() = further == slot.end() ? nullptr : &*further++;
    if (coming[2] != nullptr) signweave::prefetch(coming[2], Paced::kNearBytes);
    if (coming[1] != nullptr) coming[1]->prefetch(Paced::Step::near);
    if (coming[0] != nullptr) coming[0]->prefetch(Paced::Step::frame);
  };
  for (std::size_t i = 0; i < kAhead; ++i) look_further();
  while (!slot.empty()) {
    Paced& paced = slot.front();
    look_further();
    const Clock::time_point next = paced.at_ > now ? paced.at_ : paced.tick(now);
    place(paced, next > now ? next : now + kTick);
  }
}

void Pacer::turn() {
  turning_ = true;
  send_due();
  const Clock::time_point end = Clock::now() + kTurn;
  while (!working_.empty()) {
    Paced& paced = working_.front();
    working_.pop_front();
    if (paced.work() && !paced.working_.is_linked()) working_.push_back(paced);
    const Clock::time_point now = Clock::now();
    if (last_tick(now) >= next_) send_due();
    if (now >= end) break;
  }
  turning_ = false;
  arm();
}

void Pacer::arm() {
  if (!working_.empty()) {
    turning_ = true;
    boost::asio::post(io_, [this] { turn(); });
    return;
  }
  std::int64_t tick = next_;
  while (tick < next_ + kSlots && slots_[static_cast<std::size_t>(tick % kSlots)].empty()) ++tick;
  if (tick == next_ + kSlots) return;
  const Clock::time_point at{tick * kTick};
  if (at >= armed_) return;
  armed_ = at;
  timer_.expires_at(at);
  timer_.async_wait([this](boost::system::error_code error) {
    if (error) return;  // armed again
    armed_ = Paced::kNever;
    if (!turning_) turn();
  });
}

}  // namespace signweave::server
