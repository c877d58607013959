#include "app/server/server.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <csignal>
#include <thread>
#include <vector>

#include "app/server/context.h"
#include "app/server/http_session.h"
#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::server {

using boost::asio::ip::tcp;

struct Server::State {
  State(ServedDatabases& databases, Api& api, ServerOptions options)
      : context(databases, api, std::move(options)),
        acceptor(context.threads.front()->io),
        again(context.threads.front()->io),
        signals(context.threads.front()->io) {}

  void listen();
  void accept();
  void stop();

  Context context;
  tcp::acceptor acceptor;           // on the first thread
  boost::asio::steady_timer again;  // retries after a failed accept
  boost::asio::signal_set signals;
  std::vector<std::thread> threads;
  std::atomic<bool> stopping = false;
  std::uint16_t port = 0;
};

void Server::State::listen() {
  const ServerOptions& options = context.options;
  boost::system::error_code error;
  const std::string address = options.address == "localhost" ? "127.0.0.1" : options.address;
  const tcp::endpoint endpoint(boost::asio::ip::make_address(address, error), options.port);
  if (error) {
    throw Error(ErrorCode::bad_input,
                fmt::format("'{}' is not an address to listen on: give numbers, such as 127.0.0.1 or ::1",
                            printable(options.address)));
  }
  const auto check = [&](const boost::system::error_code& result) {
    if (!result) return;
    throw Error(ErrorCode::io, fmt::format("{}:{}: {}", options.address, options.port, result.message()));
  };
  check(acceptor.open(endpoint.protocol(), error));
  check(acceptor.set_option(tcp::acceptor::reuse_address(true), error));
  check(acceptor.bind(endpoint, error));
  check(acceptor.listen(boost::asio::socket_base::max_listen_connections, error));
  port = acceptor.local_endpoint().port();
}

void Server::State::accept() {
  // Accepts for the thread with the fewest connections.
  IoThread& thread =
      **std::ranges::min_element(context.threads, {}, [](const auto& one) { return one->metrics.connections.value(); });
  acceptor.async_accept(thread.io, [this, &thread](boost::system::error_code error, tcp::socket socket) {
    if (stopping || error == boost::asio::error::operation_aborted) return;
    if (error) {  // such as no free file descriptor: other connections must end first
      again.expires_after(std::chrono::milliseconds(50));
      again.async_wait([this](boost::system::error_code cancelled) {
        if (!cancelled) accept();
      });
      return;
    }
    boost::asio::post(thread.io, [&thread, socket = std::move(socket)]() mutable {
      thread.metrics.accepted.add();
      std::make_shared<HttpSession>(thread, std::move(socket))->start();
    });
    accept();
  });
}

Server::Server(ServedDatabases& databases, Api& api, ServerOptions options)
    : state_(std::make_unique<State>(databases, api, std::move(options))) {
  std::signal(SIGPIPE, SIG_IGN);
  state_->listen();
  state_->accept();
  for (const auto& thread : state_->context.threads) {
    state_->threads.emplace_back([&thread] { thread->run(); });
  }
}

Server::~Server() {
  stop();
  wait();
}

std::uint16_t Server::port() const noexcept {
  return state_->port;
}

std::string Server::url() const {
  const std::string& address = state_->context.options.address;
  const bool v6 = address.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}", v6 ? "[" : "", address, v6 ? "]" : "", port());
}

void Server::State::stop() {
  if (stopping.exchange(true)) return;
  context.draining = true;
  boost::asio::post(context.threads.front()->io, [this] {
    boost::system::error_code ignored;
    acceptor.close(ignored);
    again.cancel();
    for (const auto& thread : context.threads) thread->stop();
  });
}

void Server::stop_on_signals() {
  State& state = *state_;
  state.signals.add(SIGINT);
  state.signals.add(SIGTERM);
  state.signals.async_wait([&state](boost::system::error_code error, int) {
    if (error) return;
    boost::system::error_code ignored;
    state.signals.clear(ignored);  // the next signal has its default effect
    state.stop();
  });
}

void Server::stop() {
  state_->stop();
}

void Server::wait() {
  for (std::thread& thread : state_->threads) {
    if (thread.joinable()) thread.join();
  }
  state_->context.workers.join();
  state_->context.disk.join();
  // Runs the handlers of closed connections to completion, here where no other thread runs them; also those of
  // connections accepted at the last moment.
  std::size_t ran = 1;
  while (ran > 0) {
    ran = 0;
    for (const auto& thread : state_->context.threads) {
      const std::vector<Connection*> left(thread->connections.begin(), thread->connections.end());
      for (Connection* connection : left) connection->close();
      thread->io.restart();
      ran += thread->io.poll();
    }
  }
}

}  // namespace signweave::server
