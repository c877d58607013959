#pragma once

#include <boost/asio/ip/address.hpp>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace signweave::server {

/// Counts connections and limits the request rate per address; for IPv6 per 64-bit prefix, which one household or
/// machine has. Thread-safe. Without limits it stores nothing and locks nothing.
class AddressBook {
 public:
  using Time = std::chrono::steady_clock::time_point;
  struct Limits {
    std::size_t connections = 0;  ///< 0: no limit
    double rate = 0;              ///< requests per second; 0: no limit
    double burst = 1;
  };
  explicit AddressBook(Limits limits) : limits_(limits) {}

  /// False if the address is at its limit; otherwise the connection is counted until `leave`.
  bool enter(const boost::asio::ip::address& address, Time now);
  void leave(const boost::asio::ip::address& address);
  /// False if the address exceeds its request rate.
  bool request(const boost::asio::ip::address& address, Time now);

 private:
  struct Entry {
    std::size_t connections = 0;
    double left = 0;  // requests that may be made at once
    Time at;
  };
  bool on() const noexcept { return limits_.connections > 0 || limits_.rate > 0; }
  Entry& at(const boost::asio::ip::address& address, Time now);

  Limits limits_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace signweave::server
