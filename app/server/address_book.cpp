#include "app/server/address_book.h"

#include <algorithm>

namespace signweave::server {
namespace {

/// Above this number of entries, those in the same state as a new entry are removed.
constexpr std::size_t kMany = 10'000;

std::string key_of(const boost::asio::ip::address& address) {
  if (address.is_v4()) {
    const auto bytes = address.to_v4().to_bytes();
    return {bytes.begin(), bytes.end()};
  }
  const auto v6 = address.to_v6();
  const auto bytes = v6.to_bytes();
  if (v6.is_v4_mapped()) return {bytes.begin() + 12, bytes.end()};
  return {bytes.begin(), bytes.begin() + 8};
}

}  // namespace

AddressBook::Entry& AddressBook::at(const boost::asio::ip::address& address, Time now) {
  if (entries_.size() > kMany) {
    std::erase_if(entries_, [&](const auto& item) {
      const double seconds = std::chrono::duration<double>(now - item.second.at).count();
      return item.second.connections == 0 && item.second.left + seconds * limits_.rate >= limits_.burst;
    });
  }
  return entries_.try_emplace(key_of(address), Entry{.left = limits_.burst, .at = now}).first->second;
}

bool AddressBook::enter(const boost::asio::ip::address& address, Time now) {
  if (!on()) return true;
  const std::lock_guard lock(mutex_);
  Entry& entry = at(address, now);
  if (limits_.connections > 0 && entry.connections >= limits_.connections) return false;
  ++entry.connections;
  return true;
}

void AddressBook::leave(const boost::asio::ip::address& address) {
  if (!on()) return;
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(key_of(address));
  if (found != entries_.end() && found->second.connections > 0) --found->second.connections;
}

bool AddressBook::request(const boost::asio::ip::address& address, Time now) {
  if (limits_.rate <= 0) return true;
  const std::lock_guard lock(mutex_);
  Entry& entry = at(address, now);
  const double seconds = std::chrono::duration<double>(now - entry.at).count();
  entry.left = std::min(limits_.burst, entry.left + seconds * limits_.rate);
  entry.at = now;
  if (entry.left < 1) return false;
  entry.left -= 1;
  return true;
}

}  // namespace signweave::server
