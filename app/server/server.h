#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/server/api.h"
#include "app/server/options.h"
#include "app/server/served_database.h"

namespace signweave::server {

/// The network of `signweave serve`: HTTP and streams, on threads of its own. Listens from its constructor on.
class Server {
 public:
  /// Throws Error{bad_input} for an address without a token where one is needed, Error{io} where it cannot listen. All
  /// that is given must outlive it.
  Server(ServedDatabases& databases, Api& api, ServerOptions options);
  /// Stops, as `stop` and `wait` do.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const noexcept;
  /// "http://127.0.0.1:8080"
  std::string url() const;

  /// From now on SIGINT and SIGTERM stop it; a second one ends the process at once.
  void stop_on_signals();
  /// Stops in good order: nobody new is let in, running calls are answered, streams end with a reason. From any thread,
  /// also more than once; returns at once.
  void stop();
  /// Until it has stopped.
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace signweave::server
