#pragma once

#include <boost/asio/ip/address.hpp>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace signweave::server {

/// Who has how many connections and asks how often, by address; of IPv6 the first 64 bits, which is what one household
/// or machine has. Threads share it. Without limits it keeps nothing and locks nothing.
class AddressBook {
 public:
  using Time = std::chrono::steady_clock::time_point;
  struct Limits {
    std::size_t connections = 0;  ///< 0: no limit
    double rate = 0;              ///< requests a second; 0: no limit
    double burst = 1;
  };
  explicit AddressBook(Limits limits) : limits_(limits) {}

  /// False where it has as many as it may; else it is counted until `leave`.
  bool enter(const boost::asio::ip::address& address, Time now);
  void leave(const boost::asio::ip::address& address);
  /// False where it asks too often.
  bool request(const boost::asio::ip::address& address, Time now);

 private:
  struct Entry {
    std::size_t connections = 0;
    double left = 0;  // requests that it may make at once
    Time at;
  };
  bool on() const noexcept { return limits_.connections > 0 || limits_.rate > 0; }
  Entry& at(const boost::asio::ip::address& address, Time now);

  Limits limits_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace signweave::server
