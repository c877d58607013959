#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <memory>
#include <optional>
#include <string>

#include "app/server/context.h"
#include "app/server/http_decision.h"
#include "app/server/static_files.h"

namespace signweave::server {

/// One HTTP connection: reads a request, answers it, reads the next. A request for a WebSocket turns the connection
/// into a stream.
/// More than fifteen members: one state machine, whose steps share socket, request, answer and deadline.
class HttpSession : public Connection, public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(IoThread& thread, boost::asio::ip::tcp::socket socket);
  ~HttpSession() override;
  void start();

  void look(Clock::time_point now) override;
  void drain() override;
  bool busy() const override { return state_ == State::body || state_ == State::answering || state_ == State::sending; }
  void close() override;

 private:
  enum class State {
    waiting,    ///< for the first byte of a request
    header,     ///< a part of it has arrived
    body,       ///< reading the body of the request
    answering,  ///< a call is being answered
    sending,    ///< sending the answer
    ended,      ///< reading what the client still sends, so that it gets the answer
  };
  using Error = boost::system::error_code;

  void read_first();
  void read_header();
  void on_header(Error error);
  void handle_request();
  void open_file();
  void ask_for_body();
  void read_body();
  void store_body(std::size_t bytes);
  void call();
  void answered(ApiResponse answer);
  bool hold(std::uint64_t bytes);
  void release();
  void serve_file();
  void send_file(StaticFile file, std::vector<std::pair<std::string, std::string>> headers);
  void upgrade();
  void reply(Reply reply);
  void send_head();
  void send_next();
  void send_chunk(const char* data, std::size_t size);
  void after_reply();
  void linger();
  void within(std::chrono::milliseconds time) { deadline_ = Clock::now() + time; }

  boost::asio::ip::tcp::socket socket_;
  boost::asio::ip::address address_;
  bool entered_ = false;  // counted in the address book
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::buffer_body>> parser_;
  State state_ = State::waiting;
  Clock::time_point deadline_;
  Clock::time_point begin_;  // when the request began

  Decision decision_;
  bool head_only_ = false;
  bool keep_alive_ = true;
  std::string origin_;  // allowed to read the answer

  ApiRequest request_;
  bool in_file_ = false;  // the body goes into request_.body_file
  int body_file_ = -1;
  std::uint64_t most_body_ = 0;  // most bytes of the body
  std::uint64_t body_size_ = 0;
  std::uint64_t held_ = 0;  // bytes of the body or the answer that count towards those of all connections
  std::string chunk_;       // part of a body or a file

  Reply reply_;
  std::string head_;
  int file_ = -1;             // the answer's body, if it is a file
  std::uint64_t begins_ = 0;  // where in the file the answer's body begins
  std::uint64_t sent_ = 0;    // bytes of the answer's body
  std::uint64_t length_ = 0;
  std::size_t lingered_ = 0;
};

}  // namespace signweave::server
