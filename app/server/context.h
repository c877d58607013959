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

/// What all connections of a server share.
struct Context {
  Context(ServedDatabases& served, Api& http_api, ServerOptions server_options);
  ~Context();

  ServerOptions options;
  Access access;
  ServedDatabases& databases;
  Api& api;
  AddressBook addresses;
  std::atomic<bool> draining = false;
  std::atomic<std::size_t> calls = 0;  ///< being answered or waiting for it
  std::atomic<std::size_t> connections = 0;
  std::atomic<std::size_t> streams = 0;
  std::atomic<bool> over = false;        ///< the drain time is: what waits is answered no more
  std::atomic<std::uint64_t> held = 0;   ///< bytes of long bodies and answers in memory
  std::atomic<std::uint64_t> files = 0;  ///< numbers the files in `scratch`
  std::vector<std::unique_ptr<IoThread>> threads;
  // After the threads, for what waits in these holds connections of theirs.
  boost::asio::thread_pool workers;  ///< answer calls
  boost::asio::thread_pool disk{1};  ///< reads and writes files, so that a slow disk delays no stream

  /// The text of /metrics.
  std::string metrics() const;
};

/// A connection of an I/O thread, which it never leaves.
class Connection {
 public:
  explicit Connection(IoThread& thread);
  Connection(const Connection&) = delete;
  virtual ~Connection();

  /// Looked at a few times a second: it closes itself where its time is over.
  virtual void look(Clock::time_point now) = 0;
  /// The server is being stopped: ends what can be ended in good order.
  virtual void drain() = 0;
  /// True while something runs that a stopped server waits for.
  virtual bool busy() const = 0;
  /// Closes now.
  virtual void close() = 0;

 protected:
  IoThread& thread_;
};

/// One thread with its own connections. Each runs on an io_context that nobody else runs, so what is on one takes no
/// locks.
class IoThread {
 public:
  explicit IoThread(Context& server);

  Context& context;
  Metrics metrics;
  std::set<Connection*> connections;
  SendBatch sends;
  boost::asio::io_context io{1};  // after these, for what waits in it holds connections
  Pacer pacer;

  /// Runs until it is told to stop; the whole life of a thread.
  void run();
  /// From any thread: connections end in good order, within the drain time; then run() returns.
  void stop();

 private:
  void look();
  boost::asio::steady_timer look_timer_;
  std::atomic<bool> busy_ = true;  // something runs that a stop waits for, here or there
  bool stopping_ = false;
  Clock::time_point end_;
};

}  // namespace signweave::server
