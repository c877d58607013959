#include "app/server/context.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <vector>

namespace signweave::server {
namespace {

constexpr std::chrono::milliseconds kLook{200};
constexpr std::chrono::milliseconds kLookWhileStopping{20};

}  // namespace

Context::Context(ServedDatabases& served, Api& http_api, ServerOptions server_options)
    : options(std::move(server_options)),
      access(options),
      databases(served),
      api(http_api),
      addresses({.connections = options.limits.connections_per_address,
                 .rate = options.limits.requests_per_second,
                 .burst = options.limits.request_burst}),
      workers(options.workers) {
  for (std::size_t i = 0; i < options.threads; ++i) threads.push_back(std::make_unique<IoThread>(*this));
}

Context::~Context() {
  workers.join();
  disk.join();
}

std::string Context::metrics() const {
  std::vector<const Metrics*> all;
  for (const auto& thread : threads) all.push_back(&thread->metrics);
  return metrics_text(all, {.draining = draining, .calls = calls, .databases = databases.all().size()});
}

Connection::Connection(IoThread& thread) : thread_(thread) {
  thread_.connections.insert(this);
  thread_.metrics.connections.add();
  ++thread_.context.connections;
}

Connection::~Connection() {
  thread_.connections.erase(this);
  thread_.metrics.connections.subtract();
  --thread_.context.connections;
}

IoThread::IoThread(Context& server) : context(server), sends(metrics.by_one_call), pacer(io, sends), look_timer_(io) {}

void IoThread::run() {
  sends.use(context.options.io_uring ? SendBatch::Mode::one_call : SendBatch::Mode::call_each);
  look();
  io.run();
  sends.use(SendBatch::Mode::call_each);
}

void IoThread::stop() {
  boost::asio::post(io, [this] {
    stopping_ = true;
    end_ = Clock::now() + context.options.limits.drain;
    const std::vector<Connection*> now(connections.begin(), connections.end());
    for (Connection* connection : now) connection->drain();
    look();
  });
}

void IoThread::look() {
  const Clock::time_point now = Clock::now();
  const std::vector<Connection*> all(connections.begin(), connections.end());
  bool busy = false;
  for (Connection* connection : all) {
    connection->look(now);
    busy = busy || connection->busy();
  }
  if (stopping_) busy_ = busy;
  // Threads end together, so that an idle one still answers clients that the server is draining.
  busy = std::ranges::any_of(context.threads, [](const auto& thread) { return thread->busy_.load(); });
  if (stopping_ && (!busy || now >= end_)) {
    context.over = true;
    for (Connection* connection : all) connection->close();
    boost::asio::post(io, [this] { io.stop(); });
    return;
  }
  look_timer_.expires_after(stopping_ ? kLookWhileStopping : kLook);
  look_timer_.async_wait([this](boost::system::error_code error) {
    if (!error) look();
  });
}

}  // namespace signweave::server
