#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>

#include "app/server/context.h"

namespace signweave::server {

/// Turns a connection whose request asks for a WebSocket into a stream; it lives until client or server end it.
/// `counted`: the address has entered the address book, and leaves it when the stream ends.
void start_stream(IoThread& thread, boost::asio::ip::tcp::socket socket, ServedDatabase& database,
                  const boost::beast::http::request_parser<boost::beast::http::buffer_body>& request, bool counted,
                  const boost::asio::ip::address& address);

}  // namespace signweave::server
