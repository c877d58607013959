#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

#include "app/server/http_session.h"

// A connection sends its answers in chunks, so that a client that accepts nothing can be distinguished from a slow one.

namespace signweave::server {
namespace {

namespace http = boost::beast::http;

constexpr std::size_t kReplyChunk = 64 * 1024;
constexpr std::chrono::milliseconds kLinger{2'000};
constexpr std::size_t kMostLingered = 8 << 20;

}  // namespace

void HttpSession::serve_file() {
  const Context& context = thread_.context;
  std::optional<StaticFile> file = open_static(context.options.files, decision_.target.path);
  if (!file) return reply(error_reply(404, "not_found", "there is no such page"));
  send_file(*std::move(file), {});
}

void HttpSession::send_file(StaticFile file, std::vector<std::pair<std::string, std::string>> headers) {
  const auto& request = parser_->get();
  const auto field = [&](http::field name) {
    const auto text = request[name];
    return std::string_view(text.data(), text.size());
  };
  const std::string_view known = field(http::field::if_none_match);
  const bool unchanged = known.empty() ? field(http::field::if_modified_since) == file.last_modified
                                       : known == "*" || known.find(file.etag) != std::string_view::npos;
  const std::string_view still = field(http::field::if_range);
  std::optional<ByteRange> range;
  if (!unchanged && (still.empty() || still == file.etag || still == file.last_modified)) {
    range = range_of(field(http::field::range), file.size);
  }
  headers.insert(headers.end(), {{"ETag", file.etag},
                                 {"Last-Modified", file.last_modified},
                                 {"Cache-Control", "no-cache"},
                                 {"Accept-Ranges", "bytes"}});
  if (range && range->end == 0) {
    ::close(file.descriptor);
    Reply refusal = error_reply(416, "bad_input", "the Range is outside the file");
    refusal.headers.emplace_back("Content-Range", fmt::format("bytes */{}", file.size));
    return reply(std::move(refusal));
  }
  Reply answer{.status = unchanged ? 304
                         : range   ? 206
                                   : 200,
               .content_type = unchanged ? "" : file.content_type,
               .headers = std::move(headers),
               .body = ""};
  if (unchanged) {
    ::close(file.descriptor);
  } else {
    file_ = file.descriptor;
    begins_ = range ? range->begin : 0;
    length_ = range ? range->end - range->begin : file.size;
    if (range) {
      answer.headers.emplace_back("Content-Range",
                                  fmt::format("bytes {}-{}/{}", range->begin, range->end - 1, file.size));
    }
  }
  reply(std::move(answer));
}

void HttpSession::reply(Reply reply) {
  reply_ = std::move(reply);
  state_ = State::sending;
  sent_ = 0;
  if (file_ < 0) length_ = reply_.body.size();
  // The unread rest of a body would be taken for the next request.
  const bool read_whole = parser_ && parser_->is_done();
  keep_alive_ = keep_alive_ && read_whole && !reply_.close && !thread_.context.draining;
  if (body_file_ >= 0) ::close(std::exchange(body_file_, -1));
  if (std::exchange(in_file_, false)) {  // no call has taken it
    std::error_code ignored;
    std::filesystem::remove(request_.body_file, ignored);
  }
  const auto route = static_cast<std::size_t>(decision_.route);
  thread_.metrics.requests[route][static_cast<std::size_t>(reply_.status / 100)].add();
  head_ = head_of(reply_, {.length = length_,
                           .keep_alive = keep_alive_,
                           .http_1_0 = parser_ && parser_->is_header_done() && parser_->get().version() == 10,
                           .origin = origin_});
  if (head_only_ || reply_.status == 304 || reply_.status == 204) length_ = 0;
  send_head();
}

void HttpSession::send_head() {
  within(thread_.context.options.limits.body_time);
  const std::size_t with = file_ >= 0 ? 0 : std::min<std::size_t>(kReplyChunk, length_);
  sent_ = with;
  const std::array parts = {boost::asio::buffer(head_), boost::asio::buffer(reply_.body.data(), with)};
  boost::asio::async_write(socket_, parts, [self = shared_from_this()](Error error, std::size_t) {
    if (error) return self->close();
    self->send_next();
  });
}

void HttpSession::send_next() {
  if (!socket_.is_open()) return;
  if (sent_ >= length_) return after_reply();
  within(thread_.context.options.limits.body_time);
  const auto chunk = static_cast<std::size_t>(std::min<std::uint64_t>(kReplyChunk, length_ - sent_));
  if (file_ < 0) return send_chunk(reply_.body.data() + sent_, chunk);
  chunk_.resize(kReplyChunk);
  boost::asio::post(thread_.context.disk, [self = shared_from_this(), chunk, at = begins_ + sent_]() mutable {
    const ssize_t n = ::pread(self->file_, self->chunk_.data(), chunk, static_cast<off_t>(at));
    IoThread& thread = self->thread_;
    boost::asio::post(thread.io, [self = std::move(self), n] {
      if (n <= 0) return self->close();  // the file has become shorter: the announced length cannot be sent
      self->send_chunk(self->chunk_.data(), static_cast<std::size_t>(n));
    });
  });
}

void HttpSession::send_chunk(const char* data, std::size_t size) {
  boost::asio::async_write(socket_, boost::asio::buffer(data, size),
                           [self = shared_from_this()](Error error, std::size_t sent) {
                             if (error) return self->close();
                             self->sent_ += sent;
                             self->send_next();
                           });
}

void HttpSession::after_reply() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
  const std::chrono::duration<double> took = Clock::now() - begin_;
  thread_.metrics.latency[static_cast<std::size_t>(decision_.route)].observe(took.count());
  reply_ = {};
  request_ = {};
  release();
  chunk_ = {};
  if (!keep_alive_) return linger();
  within(thread_.context.options.limits.keep_alive);
  read_first();
}

void HttpSession::linger() {
  if (state_ != State::ended) {
    state_ = State::ended;
    within(kLinger);
    Error error;
    socket_.shutdown(boost::asio::ip::tcp::socket::shutdown_send, error);
    chunk_.resize(kReplyChunk);
  }
  // Closing with unread bytes would reset the connection, and the client might never see its answer.
  socket_.async_read_some(boost::asio::buffer(chunk_), [self = shared_from_this()](Error error, std::size_t bytes) {
    self->lingered_ += bytes;
    if (error || self->lingered_ > kMostLingered) return self->close();
    self->linger();
  });
}

}  // namespace signweave::server
