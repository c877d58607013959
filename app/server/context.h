#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <memory>
#include <set>
#include <vector>

#include "app/server/access.h"
#include "app/server/address_book.h"
#include "app/server/api.h"
#include "app/server/metrics.h"
#include "app/server/options.h"
#include "app/server/pacer.h"
#include "app/server/served_database.h"

namespace signweave::server {

class IoThread;

/// State shared by all connections of a server.
struct Context {
  Context(ServedDatabases& served, Api& http_api, ServerOptions server_options);
  ~Context();

  ServerOptions options;
  AccessControl access;
  ServedDatabases& databases;
  Api& api;
  AddressBook addresses;
  std::atomic<bool> draining = false;
  std::atomic<std::size_t> calls = 0;  ///< being answered or waiting to be
  std::atomic<std::size_t> connections = 0;
  std::atomic<std::size_t> streams = 0;
  std::atomic<bool> over = false;        ///< the drain time has passed: waiting calls are no longer answered
  std::atomic<std::uint64_t> held = 0;   ///< bytes of long bodies and answers in memory
  std::atomic<std::uint64_t> files = 0;  ///< numbers the files in `scratch`
  std::vector<std::unique_ptr<IoThread>> threads;
  // Declared after the threads, because what waits in these pools holds connections of the threads.
  boost::asio::thread_pool workers;  ///< answer calls
  boost::asio::thread_pool disk{1};  ///< reads and writes files, so that a slow disk does not delay streams

  /// The text of /metrics.
  std::string metrics() const;
};

/// A connection owned by an I/O thread, which never changes.
class Connection {
 public:
  explicit Connection(IoThread& thread);
  Connection(const Connection&) = delete;
  virtual ~Connection();

  /// Called a few times a second: closes the connection if its deadline has passed.
  virtual void look(Clock::time_point now) = 0;
  /// Called when the server is being stopped: ends what can be ended in good order.
  virtual void drain() = 0;
  /// True while work is running that a stopping server waits for.
  virtual bool busy() const = 0;
  /// Closes the connection immediately.
  virtual void close() = 0;

 protected:
  IoThread& thread_;
};

/// One thread with its own connections. Only this thread runs its io_context, so its state needs no locks.
class IoThread {
 public:
  explicit IoThread(Context& server);

  Context& context;
  Metrics metrics;
  std::set<Connection*> connections;
  SendBatch sends;
  boost::asio::io_context io{1};  // declared after these, because what waits in it holds connections
  Pacer pacer;

  /// Runs until stop(): the whole life of a thread.
  void run();
  /// Thread-safe: connections end in good order, within the drain time; then run() returns.
  void stop();

 private:
  void look();
  boost::asio::steady_timer look_timer_;
  std::atomic<bool> busy_ = true;  // work is running that a stop waits for, on this thread or another
  bool stopping_ = false;
  Clock::time_point end_;
};

}  // namespace signweave::server
