// A server as a whole: many clients at once, and its shutdown. Also run under the thread sanitizer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "app/server/test_server.h"
#include "signweave/core/error.h"

namespace signweave::server {
namespace {

using testing::Client;
using testing::get;
using ::testing::HasSubstr;
using testing::read_answer;
using testing::Serve;
using testing::StreamClient;
using testing::StreamMessage;
using testing::TestServer;
using testing::upload_line;
using namespace std::chrono_literals;

bool has_stream(std::uint16_t port) {
  return get(port, "/metrics").body.find("\nsignweave_streams 1\n") != std::string::npos;
}

TEST(ServerThreads, StreamsAndRequestsAtOnce) {
  const TestServer server;
  std::atomic<int> good = 0;
  std::vector<std::thread> clients;
  for (int i = 0; i < 4; ++i) {
    clients.emplace_back([&] {
      StreamClient client(server.port());
      client.say(R"({"type":"open","rate":120})");
      client.say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
      for (int frame = 0; frame < 60; ++frame) {
        if (!client.next_frames()) return;
      }
      ++good;
    });
    clients.emplace_back([&] {
      for (int n = 0; n < 20; ++n) {
        if (get(server.port(), n % 2 == 0 ? "/api/databases" : "/metrics").status != 200) return;
      }
      ++good;
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(good, 8);
}

TEST(ServerThreads, EndsInGoodOrderWhileItStreams) {
  TestServer server;
  StreamClient client(server.port());
  client.say(R"({"type":"open","rate":120})");
  client.say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
  ASSERT_TRUE(client.next_frames());
  Client waiting(server.port());
  waiting.send("GET /health HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(read_answer(waiting).status, 200);
  server.server->stop();
  StreamMessage message = client.next();
  while (message.opcode == 1 || message.opcode == 2) message = client.next();
  ASSERT_EQ(message.opcode, 8u);
  EXPECT_THAT(message.bytes, HasSubstr("the server is being stopped"));
  waiting.send("GET /health HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(read_answer(waiting).status, 503) << "while a stream is ending the server reports that it drains";
  client.client.send(StreamClient::frame(8, message.bytes));
  server.server->wait();
  EXPECT_FALSE(Client(server.port()).connected());
}

TEST(ServerThreads, EndsEvenIfClientsDoNotAnswer) {
  ServerOptions options;
  options.limits.drain = 500ms;
  TestServer server(options);
  StreamClient stalled(server.port(), {}, {}, 4'096);
  stalled.say(R"({"type":"open","rate":2000,"batch":20})");
  stalled.say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
  Client half(server.port());
  half.send("POST /api/x HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\nabc");
  for (int i = 0; i < 1'000 && !has_stream(server.port()); ++i) std::this_thread::sleep_for(10ms);
  ASSERT_TRUE(has_stream(server.port()));
  const auto begin = std::chrono::steady_clock::now();
  server.server->stop();
  server.server->wait();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 8s);
}

TEST(ServerThreads, EndsWhileFilesAreSent) {
  ServerOptions options;
  options.limits.drain = 100ms;
  for (int round = 0; round < 3; ++round) {
    TestServer server(options, {testing::demo_folder()}, Serve::for_changes);
    const std::string line = upload_line(server.port()) + "Transfer-Encoding: chunked\r\n\r\n";
    std::string chunks;
    for (int i = 0; i < 10'000; ++i) chunks += "1\r\nx\r\n";
    std::vector<std::thread> senders;
    for (int i = 0; i < 4; ++i) {
      senders.emplace_back([&] {
        Client client(server.port());
        if (!client.send(line)) return;
        for (int n = 0; n < 1'000 && client.send(chunks); ++n) {
        }
      });
    }
    for (int i = 0; i < 1'000 && server.bodies() == 0; ++i) std::this_thread::sleep_for(10ms);
    EXPECT_GT(server.bodies(), 0u);
    server.server->stop();
    server.server->wait();
    for (std::thread& sender : senders) sender.join();
    server.server.reset();
    EXPECT_EQ(server.bodies(), 0u);
  }
}

TEST(ServerThreads, EndsWithoutAnsweringAllWaitingCalls) {
  ServerOptions options{.workers = 1};
  options.limits.drain = 50ms;
  TestServer server(options);
  // An answer takes as long as the time that the server has for all waiting calls, and longer than sending all
  // requests.
  std::string utterance = "DEMAIN";
  for (int i = 0; i < 8; ++i) utterance += " MATIN DEMAIN";
  const std::string body = R"({"format":"csv","rate":1000,"utterance":")" + utterance + "\"}";
  const std::string request =
      "POST /api/databases/demo/sign HTTP/1.1\r\nHost: localhost\r\nContent-Type: "
      "application/json\r\nContent-Length: " +
      std::to_string(body.size()) + "\r\n\r\n" + body;
  std::vector<Client> clients;
  for (int i = 0; i < 30; ++i) {
    clients.emplace_back(server.port());
    clients.back().send(request);
  }
  EXPECT_EQ(testing::read_answer(clients.front()).status, 200);
  server.server->stop();
  server.server->wait();
  server.server.reset();
  const auto answered = [](Client& client) { return testing::read_answer(client).status == 200; };
  EXPECT_LT(std::ranges::count_if(clients.begin() + 1, clients.end(), answered), 20);
}

TEST(ServerThreads, AnAddressInUseIsAnError) {
  TestServer server;
  ServerOptions options{.port = server.port(), .scratch = server.scratch / "scratch"};
  EXPECT_THROW(Server(server.databases, *server.api, options), Error);
}

}  // namespace
}  // namespace signweave::server
