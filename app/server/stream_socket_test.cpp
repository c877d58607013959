#include "app/server/stream_socket.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/write.hpp>
#include <string>

namespace signweave::server {
namespace {

using boost::asio::ip::tcp;

std::span<const std::byte> raw(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// A stream's socket with a client, with both methods of sending.
class StreamSocketTest : public ::testing::TestWithParam<SendBatch::Mode> {
 protected:
  StreamSocketTest() {
    sends.use(GetParam());
    tcp::acceptor acceptor(io, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0));
    client.connect(acceptor.local_endpoint());
    socket = std::make_shared<StreamSocket>(acceptor.accept(), 64 * 1024, sends);
    socket->socket().set_option(boost::asio::socket_base::send_buffer_size(16 * 1024));
    socket->held_by(socket);
  }
  /// Reads so many bytes at the client, while the server's side continues.
  std::string received(std::size_t bytes) {
    std::string text(bytes, '\0');
    client.non_blocking(true);
    for (std::size_t have = 0; have < bytes;) {
      boost::system::error_code error;
      have += client.read_some(boost::asio::buffer(text.data() + have, bytes - have), error);
      if (error && error != boost::asio::error::would_block) return text.substr(0, have);
      io.restart();
      io.poll();
    }
    return text;
  }

  boost::asio::io_context io;
  Counter by_one_call;
  SendBatch sends{by_one_call};
  tcp::socket client{io};
  std::shared_ptr<StreamSocket> socket;
};

INSTANTIATE_TEST_SUITE_P(BothDirections, StreamSocketTest,
                         ::testing::Values(SendBatch::Mode::one_call, SendBatch::Mode::call_each),
                         [](const auto& info) {
                           return info.param == SendBatch::Mode::one_call ? "OneCall" : "CallEach";
                         });

TEST_P(StreamSocketTest, AFrameWaitsForTheOthersOfItsTick) {
  const std::string frame(500, 'f');
  sends.collect();
  socket->send_frame(raw(frame));
  EXPECT_FALSE(socket->idle());
  EXPECT_EQ(client.available(), 0u);
  sends.finish();
  EXPECT_TRUE(socket->idle());
  EXPECT_EQ(received(500), frame);
  socket->send_frame(raw(frame));
  EXPECT_EQ(received(500), frame) << "at once if nothing is collected";
}

TEST_P(StreamSocketTest, TextComesAfterTheFrameBeforeIt) {
  sends.collect();
  socket->send_frame(raw("frame"));
  socket->send_text("text");
  sends.finish();
  EXPECT_EQ(received(11), std::string("frame\x81\x04text"));
}

TEST_P(StreamSocketTest, TextComesBeforeTheFrameAfterIt) {
  sends.collect();
  socket->send_text("text");
  EXPECT_EQ(client.available(), 0u) << "they are sent together";
  socket->send_frame(raw("frame"));
  sends.finish();
  EXPECT_EQ(received(11), std::string("\x81\x04textframe"));
  sends.collect();
  socket->send_text("alone");
  sends.finish();
  EXPECT_EQ(received(7), std::string("\x81\x05"
                                     "alone"));
}

TEST_P(StreamSocketTest, AFrameWaitsForUnsentText) {
  const std::string text(60'000, 't');
  int texts = 0;
  while (socket->idle()) {
    socket->send_text(text);
    ++texts;
  }
  sends.collect();
  socket->send_frame(raw("frame"));
  sends.finish();
  socket->send_text("last");
  std::string expected;
  for (int i = 0; i < texts; ++i) expected += std::string("\x81\x7e\xea\x60", 4) + text;
  expected += "frame\x81\x04last";
  EXPECT_TRUE(received(expected.size()) == expected);
}

TEST_P(StreamSocketTest, WhatAClientDoesNotReadAtOnceIsSentLater) {
  int drained = 0;
  socket->on_drained([&] { ++drained; });
  const std::string frame(4 << 20, 'f');
  sends.collect();
  socket->send_frame(raw(frame));
  sends.finish();
  EXPECT_FALSE(socket->idle());
  socket->send_text("text");
  EXPECT_EQ(received(frame.size()), frame);
  EXPECT_EQ(received(6), std::string("\x81\x04text"));
  EXPECT_TRUE(socket->idle());
  EXPECT_EQ(drained, 1);
}

TEST_P(StreamSocketTest, AClientThatHasGoneIsNoticed) {
  client.set_option(boost::asio::socket_base::linger(true, 0));
  client.close();
  sends.collect();
  socket->send_frame(raw("frame"));
  sends.finish();
  EXPECT_TRUE(socket->failed());
  EXPECT_FALSE(socket->idle());
}

TEST_P(StreamSocketTest, MayBeClosedAndDestroyedWhileItsFrameIsCollected) {
  const std::string frame(500, 'f');
  sends.collect();
  socket->send_frame(raw(frame));
  socket->close();
  socket.reset();
  sends.finish();
  EXPECT_EQ(received(1'000), frame) << "what was sent before it was closed, once";
}

}  // namespace
}  // namespace signweave::server
