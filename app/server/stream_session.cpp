#include "app/server/stream_session.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <optional>

#include "app/server/frame_sender.h"
#include "app/server/stream_text.h"
#include "signweave/choose/known_words.h"

namespace signweave::server {
namespace {

namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;

/// One stream: its control messages and their effects.
class StreamSession final : public Connection, public std::enable_shared_from_this<StreamSession> {
 public:
  StreamSession(IoThread& thread, boost::asio::ip::tcp::socket socket, ServedDatabase& database, bool counted,
                const boost::asio::ip::address& address)
      : Connection(thread),
        database_(database),
        counted_(counted),
        address_(address),
        socket_(std::move(socket), thread.context.options.limits.unread_bytes, thread.sends),
        buffer_(2 * thread.context.options.limits.control_bytes),
        tokens_(thread.context.options.limits.control_rate),
        late_(thread.io) {
    thread_.metrics.streams.add();
    ++thread_.context.streams;
  }
  ~StreamSession() override {
    sender_.reset();
    if (counted_) thread_.context.addresses.leave(address_);
    thread_.metrics.streams.subtract();
    --thread_.context.streams;
  }

  void start(const http::request<http::empty_body>& request) {
    const ServerLimits& limits = thread_.context.options.limits;
    StreamSocket& socket = socket_.next_layer();
    boost::system::error_code ignored;
    socket.socket().set_option(boost::asio::socket_base::send_buffer_size(limits.send_buffer), ignored);
    socket.socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
    socket.held_by(weak_from_this());
    socket.on_drained([this] {
      if (sender_) sender_->drained();
    });
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = std::min<std::chrono::milliseconds>(limits.header_time, std::chrono::seconds(5));
    timeout.idle_timeout = limits.silence;
    timeout.keep_alive_pings = true;
    socket_.set_option(timeout);
    socket_.set_option(websocket::stream_base::decorator(
        [](websocket::response_type& response) { response.set(http::field::server, "signweave"); }));
    socket_.read_message_max(limits.control_bytes);
    socket_.async_accept(request, [self = shared_from_this()](boost::system::error_code error) {
      self->open_ = !error;
      if (!error) self->read();
    });
  }

  void look(Clock::time_point now) override {
    if (!closing_until_ || now < *closing_until_) return;
    thread_.metrics.timeouts.add();
    close();
  }
  void drain() override {
    if (!open_) return close();  // there is no WebSocket yet to close
    if (sender_) sender_->stop();
    late_.cancel();
    if (std::exchange(draining_, true)) return;
    socket_.async_close({websocket::close_code::going_away, "the server is being stopped"},
                        [self = shared_from_this()](boost::system::error_code) {});
  }
  bool busy() const override { return true; }
  void close() override {
    closing_until_.reset();
    late_.cancel();
    socket_.next_layer().close();
  }

 private:
  void say(std::string_view text) { socket_.next_layer().send_text(text); }

  void read() {
    if (!may_read()) return read_late();
    socket_.async_read(
        buffer_, [self = shared_from_this()](boost::system::error_code error, std::size_t) { self->on_read(error); });
  }

  /// Continues reading when there is a token again; until then the client's own socket fills. The timer keeps the
  /// stream alive.
  void read_late() {
    const double rate = thread_.context.options.limits.control_rate;
    const std::chrono::duration<double> wait(std::clamp((1 - tokens_) / rate, 0.005, 10.0));
    late_.expires_after(std::chrono::duration_cast<Clock::duration>(wait));
    late_.async_wait([self = shared_from_this()](boost::system::error_code error) {
      if (!error) self->read();
    });
  }

  /// Limits the wait for a client that does not read what is left for it.
  void close_soon() { closing_until_ = Clock::now() + thread_.context.options.limits.close_time; }

  /// A message takes one token, plus one per KiB; tokens are refilled over time.
  bool may_read() {
    const double rate = thread_.context.options.limits.control_rate;
    const Clock::time_point now = Clock::now();
    tokens_ = std::min(rate, tokens_ + std::chrono::duration<double>(now - counted_at_).count() * rate);
    counted_at_ = now;
    if (tokens_ < 1) return false;
    tokens_ -= 1;
    return true;
  }

  void on_read(boost::system::error_code error) {
    if (error) {
      if (error == boost::beast::error::timeout) thread_.metrics.timeouts.add();
      if (sender_) sender_->stop();
      error == websocket::error::closed ? close_soon() : close();
      return;
    }
    if (!draining_) {
      thread_.metrics.controls.add();
      tokens_ -= static_cast<double>(buffer_.size()) / 1'024;  // long utterances take longer
      if (socket_.got_text()) {
        const auto data = buffer_.data();
        answer({static_cast<const char*>(data.data()), data.size()});
      } else {
        refuse(ErrorCode::bad_input, "control messages must be text; only the server sends frames", {});
      }
    }
    buffer_.consume(buffer_.size());
    if (buffer_.capacity() > 8'192) buffer_.shrink_to_fit();
    read();
  }

  void refuse(ErrorCode code, std::string_view text, std::string_view id) {
    thread_.metrics.control_errors.add();
    say(error_text(code, text, id));
  }

  /// Sends as many of the last clips as fit into a message.
  void send_score(std::string_view id) {
    const std::size_t most = thread_.context.options.limits.unread_bytes / 2;
    std::string text;
    for (std::size_t clips = Player::kMostScoreClips; clips > 0; clips /= 4) {
      text = score_text(id, sender_ ? sender_->score(clips) : std::nullopt, sender_ ? sender_->frame() : 0);
      tokens_ -= static_cast<double>(text.size()) / 4'096;  // generating it takes time
      if (text.size() <= most) return say(text);
    }
    throw Error(ErrorCode::unsupported,
                fmt::format("the score of one clip has {} bytes; the limit of a message is {}", text.size(), most));
  }

  void answer(std::string_view text) {
    std::string id;
    try {
      const ControlMessage message = parse_control(text, words_of(database_.database()));
      id = message.id;
      if (message.control == Control::open) {
        if (sender_) throw Error(ErrorCode::conflict, "'open' must come first, and only once");
        sender_.emplace(thread_, database_, socket_.next_layer(), message.open);
      } else if (message.control == Control::score) {
        send_score(id);
        return;
      } else if (message.control != Control::ping) {
        if (!sender_) sender_.emplace(thread_, database_, socket_.next_layer(), StreamOptions{});
        sender_->control(message);
      }
      say(ok_text(id, sender_ ? sender_->frame() : 0));
      if (message.control != Control::ping) sender_->go();
    } catch (const ControlError& error) {
      refuse(error.code(), error.what(), error.id);
    } catch (const Error& error) {
      thread_.metrics.control_errors.add();
      say(error_text(error, id));
    } catch (const std::exception& error) {  // such as lack of memory: this stream cannot continue, others can
      refuse(ErrorCode::io, error.what(), id);
      if (sender_) sender_->stop();
      draining_ = true;
      close_soon();
      socket_.async_close({websocket::close_code::internal_error, "an error of the server"},
                          [self = shared_from_this()](boost::system::error_code) {});
    }
  }

  ServedDatabase& database_;
  bool counted_;
  boost::asio::ip::address address_;
  websocket::stream<StreamSocket, false> socket_;
  boost::beast::flat_buffer buffer_;
  std::optional<FrameSender> sender_;
  bool open_ = false;  // the handshake is done
  bool draining_ = false;
  double tokens_;
  boost::asio::steady_timer late_;                  // until reading continues
  std::optional<Clock::time_point> closing_until_;  // closed then, whether or not the client has received everything
  Clock::time_point counted_at_ = Clock::now();
};

}  // namespace

void start_stream(IoThread& thread, boost::asio::ip::tcp::socket socket, ServedDatabase& database,
                  const http::request_parser<http::buffer_body>& request, bool counted,
                  const boost::asio::ip::address& address) {
  const auto session = std::make_shared<StreamSession>(thread, std::move(socket), database, counted, address);
  session->start(http::request<http::empty_body>(http::request_header<>(request.get().base())));
}

}  // namespace signweave::server
