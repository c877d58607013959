#include "app/server/pacer.h"

#include <boost/asio/post.hpp>
#include <utility>

namespace signweave::server {
namespace {

constexpr std::chrono::milliseconds kGrid{1};
/// After so long the sockets are looked at, whatever work is left.
constexpr std::chrono::milliseconds kTurn{2};

Clock::time_point on_grid(Clock::time_point at) {
  return Clock::time_point(std::chrono::ceil<std::chrono::milliseconds>(at.time_since_epoch()));
}

}  // namespace

Pacer::Pacer(boost::asio::io_context& io) : io_(io), timer_(io) {
  heap_.reserve(1'024);
}

void Pacer::wake_at(Paced& paced, Clock::time_point at) {
  if (at == Paced::kNever) {
    if (paced.slot_ != Paced::kNowhere) {
      const std::size_t slot = paced.slot_;
      paced.slot_ = Paced::kNowhere;
      const Slot last = heap_.back();
      heap_.pop_back();
      if (last.paced != &paced) {
        place(slot, last);
        up(slot);
        down(last.paced->slot_);
      }
    }
    return;
  }
  if (paced.slot_ == Paced::kNowhere) {
    heap_.push_back({at, &paced});
    paced.slot_ = heap_.size() - 1;
    up(paced.slot_);
  } else {
    heap_[paced.slot_].at = at;
    up(paced.slot_);
    down(paced.slot_);
  }
  if (!turning_) arm();
}

void Pacer::want_work(Paced& paced) {
  if (!paced.is_linked()) working_.push_back(paced);
  if (!turning_) arm();
}

void Pacer::forget(Paced& paced) noexcept {
  wake_at(paced, Paced::kNever);
  paced.unlink();
}

void Pacer::send_due() {
  for (Clock::time_point now = Clock::now(); !heap_.empty() && heap_.front().at <= now;) {
    Paced& paced = *heap_.front().paced;
    const Clock::time_point next = paced.tick(now);
    wake_at(paced, next > now ? next : now + kGrid);
  }
}

void Pacer::turn() {
  turning_ = true;
  send_due();
  const Clock::time_point end = Clock::now() + kTurn;
  while (!working_.empty()) {
    Paced& paced = working_.front();
    working_.pop_front();
    if (paced.work() && !paced.is_linked()) working_.push_back(paced);
    const Clock::time_point now = Clock::now();
    if (!heap_.empty() && heap_.front().at <= now) send_due();
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
  if (heap_.empty()) return;
  const Clock::time_point at = on_grid(heap_.front().at);
  if (at >= armed_) return;
  armed_ = at;
  timer_.expires_at(at);
  timer_.async_wait([this](boost::system::error_code error) {
    if (error) return;  // armed anew
    armed_ = Paced::kNever;
    if (!turning_) turn();
  });
}

void Pacer::place(std::size_t slot, Slot what) noexcept {
  heap_[slot] = what;
  what.paced->slot_ = slot;
}

void Pacer::up(std::size_t slot) noexcept {
  const Slot what = heap_[slot];
  while (slot > 0 && what.at < heap_[(slot - 1) / 2].at) {
    place(slot, heap_[(slot - 1) / 2]);
    slot = (slot - 1) / 2;
  }
  place(slot, what);
}

void Pacer::down(std::size_t slot) noexcept {
  const Slot what = heap_[slot];
  for (std::size_t child = 2 * slot + 1; child < heap_.size(); child = 2 * slot + 1) {
    if (child + 1 < heap_.size() && heap_[child + 1].at < heap_[child].at) ++child;
    if (what.at <= heap_[child].at) break;
    place(slot, heap_[child]);
    slot = child;
  }
  place(slot, what);
}

}  // namespace signweave::server
