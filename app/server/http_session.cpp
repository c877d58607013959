#include "app/server/http_session.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <boost/asio/bind_executor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "app/server/stream_session.h"
#include "signweave/core/text.h"

namespace signweave::server {
namespace {

namespace http = boost::beast::http;

constexpr std::size_t kChunk = 64 * 1024;

std::string_view text_of(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

RequestHead head_of_request(const http::request<http::buffer_body>& request) {
  const auto field = [&](http::field name) { return text_of(request[name]); };
  return {.method = text_of(request.method_string()),
          .target = text_of(request.target()),
          .version = request.version(),
          .hosts = request.count(http::field::host),
          .host = field(http::field::host),
          .origin = field(http::field::origin),
          .authorization = field(http::field::authorization),
          .upgrade = boost::beast::websocket::is_upgrade(request)};
}

Reply too_long(std::uint64_t most) {
  return error_reply(413, "too_large", fmt::format("a body must not be longer than {} bytes", most));
}

Reply no_room() {
  Reply refusal = error_reply(503, "busy", "too many long bodies and answers at once; try again");
  refusal.headers.emplace_back("Retry-After", "1");
  return refusal;
}

}  // namespace

HttpSession::HttpSession(IoThread& thread, boost::asio::ip::tcp::socket socket)
    : Connection(thread), socket_(std::move(socket)), buffer_(kChunk + thread.context.options.limits.header_bytes) {}

HttpSession::~HttpSession() {
  if (entered_) thread_.context.addresses.leave(address_);
  if (file_ >= 0) ::close(file_);
  if (body_file_ >= 0) ::close(body_file_);
  std::error_code ignored;
  if (in_file_) std::filesystem::remove(request_.body_file, ignored);
  release();
}

void HttpSession::start() {
  Error error;
  socket_.set_option(boost::asio::ip::tcp::no_delay(true), error);
  const auto remote = socket_.remote_endpoint(error);
  if (error) return;
  address_ = remote.address();
  const ServerLimits& limits = thread_.context.options.limits;
  within(limits.header_time);
  begin_ = Clock::now();
  const bool full = thread_.context.connections > limits.connections;
  if (full || !thread_.context.addresses.enter(address_, begin_)) {
    thread_.metrics.refused.add();
    keep_alive_ = false;
    decision_ = {};
    Reply refusal = error_reply(503, "busy", full ? "too many connections" : "too many connections from this address");
    refusal.headers.emplace_back("Retry-After", "5");
    reply(std::move(refusal));
    return;
  }
  entered_ = true;
  read_first();
}

void HttpSession::close() {
  Error error;
  socket_.close(error);
}

void HttpSession::look(Clock::time_point now) {
  if (state_ == State::answering || now < deadline_ || !socket_.is_open()) return;
  thread_.metrics.timeouts.add();
  close();
}

void HttpSession::drain() {}  // the next answer ends the connection

void HttpSession::read_first() {
  state_ = State::waiting;
  if (buffer_.size() > 0) return read_header();
  socket_.async_wait(boost::asio::ip::tcp::socket::wait_read, [self = shared_from_this()](Error error) {
    if (!error) self->read_header();
  });
}

void HttpSession::read_header() {
  state_ = State::header;
  const ServerLimits& limits = thread_.context.options.limits;
  within(limits.header_time);
  begin_ = Clock::now();
  parser_.emplace();
  parser_->header_limit(limits.header_bytes);
  parser_->body_limit(boost::none);  // counted here, because the limit depends on the path
  http::async_read_header(socket_, buffer_, *parser_,
                          [self = shared_from_this()](Error error, std::size_t) { self->on_header(error); });
}

void HttpSession::on_header(Error error) {
  decision_ = {};
  origin_.clear();
  head_only_ = false;
  if (error) {
    if (error == http::error::end_of_stream ||
        error.category() != http::make_error_code(http::error::bad_method).category()) {
      return close();
    }
    keep_alive_ = false;
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
      return reply(error_reply(431, "bad_input", "the header of the request is too long"));
    }
    return reply(error_reply(400, "bad_input", fmt::format("not HTTP: {}", error.message())));
  }
  keep_alive_ = parser_->keep_alive() && !thread_.context.draining;
  const RequestHead head = head_of_request(parser_->get());
  head_only_ = head.method == "HEAD";
  decision_ = decide(head, thread_.context.options, thread_.context.access);
  if (decision_.allowed_origin) origin_ = head.origin;
  if (!thread_.context.addresses.request(address_, begin_)) {
    thread_.metrics.refused.add();
    Reply refusal = error_reply(429, "busy", "too many requests from this address");
    refusal.headers.emplace_back("Retry-After", "1");
    return reply(std::move(refusal));
  }
  const auto coding = http::field::transfer_encoding;
  const auto& fields = parser_->get();
  if (fields.count(coding) > 1 || (fields.count(coding) == 1 && !boost::beast::iequals(fields[coding], "chunked"))) {
    keep_alive_ = false;  // the end of the body is unknown
    return reply(error_reply(400, "bad_input", "the only supported Transfer-Encoding is chunked"));
  }
  if (decision_.reply) return reply(*std::exchange(decision_.reply, {}));
  handle_request();
}

void HttpSession::handle_request() {
  Context& context = thread_.context;
  switch (decision_.route) {
    case RouteClass::health: {
      const bool draining = context.draining;
      return reply({.status = draining ? 503 : 200,
                    .content_type = "application/json",
                    .headers = {{"Cache-Control", "no-store"}},
                    .body = draining ? "{\"status\": \"draining\"}\n" : "{\"status\": \"ok\"}\n"});
    }
    case RouteClass::metrics:
      return reply({.status = 200,
                    .content_type = "text/plain; version=0.0.4; charset=utf-8",
                    .headers = {{"Cache-Control", "no-store"}},
                    .body = context.metrics()});
    case RouteClass::file:
      return serve_file();
    case RouteClass::stream:
      return upgrade();
    case RouteClass::api:
    case RouteClass::refused:
      break;
  }
  if (context.draining) return reply(error_reply(503, "stopping", "the server is being stopped"));
  const auto& head = parser_->get();
  request_ = {.method = head_only_ ? "GET" : std::string(text_of(head.method_string())),
              .path = {decision_.target.path.begin() + 1, decision_.target.path.end()},
              .query = std::move(decision_.target.query),
              .content_type = std::string(text_of(head[http::field::content_type])),
              .accept = std::string(text_of(head[http::field::accept])),
              .body = {},
              .body_file = {}};
  const bool to_file = context.api.takes_file(request_);
  const ServerLimits& limits = context.options.limits;
  most_body_ = to_file                                ? limits.file_bytes
               : context.api.takes_document(request_) ? limits.score_bytes
                                                      : limits.body_bytes;
  if (parser_->content_length() && *parser_->content_length() > most_body_) return reply(too_long(most_body_));
  body_size_ = 0;
  state_ = State::body;
  within(context.options.limits.body_time);
  to_file ? open_file() : ask_for_body();
}

/// A file is created only if the call may accept it, or anyone could fill the disk.
void HttpSession::open_file() {
  boost::asio::post(thread_.context.disk, [self = shared_from_this()]() mutable {
    IoThread& thread = self->thread_;
    ApiRequest& request = self->request_;
    std::optional<ApiResponse> refusal = thread.context.api.refusal(request);
    if (!refusal) {
      request.body_file = thread.context.options.scratch / fmt::format("body-{}", ++thread.context.files);
      self->body_file_ = ::open(request.body_file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
      self->in_file_ = self->body_file_ >= 0;
    }
    // The session must be destroyed on its own thread, so this thread must not keep a reference.
    boost::asio::post(thread.io, [self = std::move(self), refusal = std::move(refusal)]() mutable {
      if (refusal) return self->answered(*std::move(refusal));
      if (self->in_file_) return self->ask_for_body();
      self->reply(error_reply(500, "io", "the body of the request could not be stored"));
    });
  });
}

void HttpSession::ask_for_body() {
  const bool asked = boost::beast::iequals(parser_->get()[http::field::expect], "100-continue");
  if (parser_->is_done() || !asked) return read_body();
  constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
  boost::asio::async_write(socket_, boost::asio::buffer(kContinue),
                           [self = shared_from_this()](Error error, std::size_t) {
                             if (!error) self->read_body();
                           });
}

void HttpSession::read_body() {
  if (!socket_.is_open()) return;  // closed meanwhile, for instance by a stop
  if (parser_->is_done()) {
    if (body_file_ >= 0) ::close(std::exchange(body_file_, -1));
    return call();
  }
  within(thread_.context.options.limits.body_time);
  chunk_.resize(kChunk);
  parser_->get().body() = {.data = chunk_.data(), .size = chunk_.size(), .more = true};
  http::async_read_some(socket_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
    if (error == http::error::need_buffer) error = {};
    if (error) {
      if (error == http::error::partial_message || error.category() == boost::system::system_category()) {
        return self->close();
      }
      self->keep_alive_ = false;
      return self->reply(error_reply(400, "bad_input", fmt::format("not HTTP: {}", error.message())));
    }
    self->store_body(kChunk - self->parser_->get().body().size);
  });
}

void HttpSession::store_body(std::size_t bytes) {
  if (!socket_.is_open()) return;
  body_size_ += bytes;
  if (body_size_ > most_body_) return reply(too_long(most_body_));
  if (!in_file_) {
    if (body_size_ > kChunk && !hold(bytes)) {
      thread_.metrics.refused.add();
      return reply(no_room());
    }
    request_.body.append(chunk_, 0, bytes);
    return read_body();
  }
  if (bytes == 0) return read_body();
  boost::asio::post(thread_.context.disk, [self = shared_from_this(), bytes, file = body_file_]() mutable {
    std::size_t written = 0;
    while (written < bytes) {
      const ssize_t n = ::write(file, self->chunk_.data() + written, bytes - written);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      written += static_cast<std::size_t>(n);
    }
    IoThread& thread = self->thread_;
    boost::asio::post(thread.io, [self = std::move(self), good = written == bytes] {
      if (good) return self->read_body();
      self->reply(error_reply(507, "io", "the body of the request could not be stored; is the disk full?"));
    });
  });
}

/// Counts bytes held in memory; false if all connections together would hold too many.
bool HttpSession::hold(std::uint64_t bytes) {
  Context& context = thread_.context;
  const std::uint64_t before = context.held.fetch_add(bytes);
  if (before > 0 && before + bytes > context.options.limits.held_bytes) {  // a single one may have any length
    context.held -= bytes;
    return false;
  }
  held_ += bytes;
  return true;
}

void HttpSession::release() {
  thread_.context.held -= std::exchange(held_, 0);
}

void HttpSession::call() {
  if (!socket_.is_open()) return;
  Context& context = thread_.context;
  if (context.calls >= context.options.limits.calls) {
    thread_.metrics.refused.add();
    Reply refusal = error_reply(503, "busy", "too many calls at once; try again");
    refusal.headers.emplace_back("Retry-After", "1");
    return reply(std::move(refusal));
  }
  state_ = State::answering;
  ++context.calls;
  in_file_ = false;  // the call moves it away
  boost::asio::post(context.workers, [self = shared_from_this(), request = std::move(request_)]() mutable {
    IoThread& thread = self->thread_;
    ApiResponse answer;
    if (!thread.context.over) {
      answer = thread.context.api.answer(std::move(request));
    } else if (!request.body_file.empty()) {  // the client has gone
      std::error_code ignored;
      std::filesystem::remove(request.body_file, ignored);
    }
    --thread.context.calls;
    boost::asio::post(thread.io, [self = std::move(self), answer = std::move(answer)]() mutable {
      self->answered(std::move(answer));
    });
  });
}

void HttpSession::answered(ApiResponse answer) {
  release();  // the body was moved into the call
  if (!answer.file.empty()) {
    std::optional<StaticFile> file = open_plain(answer.file);
    if (!file) return reply(error_reply(404, "not_found", "the file no longer exists"));
    file->content_type = std::move(answer.content_type);
    return send_file(*std::move(file), std::move(answer.headers));
  }
  if (answer.body.size() > kChunk && !hold(answer.body.size())) {
    thread_.metrics.refused.add();
    return reply(no_room());
  }
  reply({.status = answer.status,
         .content_type = std::move(answer.content_type),
         .headers = std::move(answer.headers),
         .body = std::move(answer.body)});
}

void HttpSession::upgrade() {
  Context& context = thread_.context;
  const auto refuse = [&](int status, std::string_view code, std::string_view message) {
    reply(error_reply(status, code, message));
  };
  if (context.draining) return refuse(503, "stopping", "the server is being stopped");
  if (context.streams >= context.options.limits.streams) {
    thread_.metrics.refused.add();
    return refuse(503, "busy", "too many streams");
  }
  ServedDatabase* database = nullptr;
  try {
    for (const auto& [name, value] : decision_.target.query) {
      if (name != "database") {
        return refuse(400, "bad_input", fmt::format("/api/stream has no parameter '{}'", printable(name)));
      }
      database = &context.databases.at(value);
    }
  } catch (const signweave::Error& error) {
    return refuse(404, "not_found", error.what());
  }
  if (database == nullptr) {
    if (context.databases.all().size() != 1) {
      return refuse(400, "bad_input", "several databases are served: choose one, /api/stream?database=NAME");
    }
    database = context.databases.all().front().get();
  }
  // Counted in the class of its request, but it lasts as long as the stream.
  thread_.metrics.requests[static_cast<std::size_t>(RouteClass::stream)][1].add();
  state_ = State::ended;
  start_stream(thread_, std::move(socket_), *database, *parser_, std::exchange(entered_, false), address_);
}

}  // namespace signweave::server
