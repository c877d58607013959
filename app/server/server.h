#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/server/api.h"
#include "app/server/options.h"
#include "app/server/served_database.h"

namespace signweave::server {

/// The network side of `signweave serve`: HTTP and streams, on its own threads. Listens as soon as it is constructed.
class Server {
 public:
  /// Throws Error{bad_input} if the address requires a token and there is none, Error{io} if it cannot listen. The
  /// arguments must outlive it.
  Server(ServedDatabases& databases, Api& api, ServerOptions options);
  /// Stops, as `stop` and `wait` do.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const noexcept;
  /// "http://127.0.0.1:8080"
  std::string url() const;

  /// From now on SIGINT and SIGTERM stop the server; a second one ends the process immediately.
  void stop_on_signals();
  /// Stops in good order: no new connections are accepted, running calls are answered, streams end with a reason.
  /// Thread-safe, may be called repeatedly; returns immediately.
  void stop();
  /// Waits until the server has stopped.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace signweave::server
