// Requests of all kinds, over real sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/server/test_server.h"

namespace signweave::server {
namespace {

using testing::Answer;
using testing::ask;
using testing::Client;
using testing::get;
using ::testing::HasSubstr;
using testing::read_answer;
using testing::Serve;
using testing::TestServer;
using testing::upload_line;
using namespace std::chrono_literals;

TEST(Http, SmallPagesOfTheServerItself) {
  const TestServer server;
  EXPECT_THAT(get(server.port(), "/").body, HasSubstr("/api/openapi.json"));
  EXPECT_THAT(get(server.port(), "/").head, HasSubstr("Content-Security-Policy: default-src 'self'"));
  EXPECT_EQ(get(server.port(), "/health").body, "{\"status\": \"ok\"}\n");
  EXPECT_THAT(get(server.port(), "/metrics").body, HasSubstr("signweave_databases 1\n"));
  EXPECT_EQ(get(server.port(), "/api/databases").status, 200);
  EXPECT_EQ(get(server.port(), "/no-such-page").status, 404);
}

TEST(Http, MalformedRequestsAreAnsweredAndClosed) {
  ServerOptions options;
  options.limits.header_bytes = 4'096;
  options.limits.target_bytes = 1'024;
  options.limits.body_bytes = 1'000;
  const TestServer server(options);
  const std::string get_line = "GET / HTTP/1.1\r\nHost: localhost\r\n";
  const std::string post = "POST /api/x HTTP/1.1\r\nHost: localhost\r\n";
  const std::pair<std::string, int> cases[] = {
      {"\r\n\r\n\r\n\r\ngarbage\r\n\r\n", 400},
      {"GET\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n\r\n", 400},
      {"GET / HTTP/9.9\r\nHost: localhost\r\n\r\n", 400},
      {"GET / HTTX/1.1\r\nHost: localhost\r\n\r\n", 400},
      {"GET  / HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
      {get_line + "Host: localhost\r\n\r\n", 400},
      {get_line + "No colon\r\n\r\n", 400},
      {get_line + "Na me: x\r\n\r\n", 400},
      {get_line + "X: a\x01z\r\n\r\n", 400},
      {get_line + "X: " + std::string(8'000, 'x') + "\r\n\r\n", 431},
      {"GET /" + std::string(2'000, 'x') + " HTTP/1.1\r\nHost: localhost\r\n\r\n", 414},
      {"GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
      {"GET http://evil.example/ HTTP/1.1\r\nHost: localhost\r\n\r\n", 400},
      {"BREW / HTTP/1.1\r\nHost: localhost\r\n\r\n", 405},
      {post + "Content-Length: x\r\n\r\n", 400},
      {post + "Content-Length: -1\r\n\r\n", 400},
      {post + "Content-Length: 3\r\nContent-Length: 4\r\n\r\nabcd", 400},
      {post + "Content-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n", 400},
      {post + "Transfer-Encoding: chunked\r\n\r\nzz\r\nab\r\n", 400},
      {post + "Content-Length: 99999999999999999999999\r\n\r\n", 400},
      {post + "Transfer-Encoding: gzip\r\n\r\n" + get_line + "\r\n", 400},
      {post + "Transfer-Encoding: identity\r\n\r\n", 400},
      {post + "Transfer-Encoding: gzip, chunked\r\n\r\n0\r\n\r\n", 400},
      {post + "Content-Length: 1001\r\n\r\n", 413},
      {post + "Transfer-Encoding: chunked\r\n\r\n3e9\r\n" + std::string(1'001, 'x') + "\r\n0\r\n\r\n", 413},
      {"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\nabc", 405},
      {"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n", 421},
      {post + "Origin: http://evil.example\r\nContent-Length: 0\r\n\r\n", 403},
  };
  for (const auto& [request, status] : cases) {
    Client client(server.port());
    client.send(request);
    client.finish_sending();
    const Answer answer = read_answer(client);
    EXPECT_EQ(answer.status, status) << request.substr(0, 120);
    EXPECT_THAT(answer.body, HasSubstr("{\"error\":{\"code\":")) << request.substr(0, 120);
    if (status == 405) {
      EXPECT_THAT(answer.body, HasSubstr("\"method_not_allowed\""));
    }
    if (status == 413) {
      EXPECT_THAT(answer.body, HasSubstr("\"too_large\""));
    }
    EXPECT_EQ(client.read_all(), "") << "the bytes that follow may be anything, after " << request.substr(0, 120);
  }
  EXPECT_EQ(get(server.port(), "/health").status, 200);
}

TEST(Http, ConnectionsServeRequestAfterRequest) {
  const TestServer server;
  Client client(server.port());
  for (int i = 0; i < 3; ++i) {
    client.send("GET /health HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(read_answer(client).status, 200);
  }
  // Several pipelined requests are answered in order, HEAD without a body.
  client.send(
      "GET /health HTTP/1.1\r\nHost: localhost\r\n\r\nHEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n"
      "GET /nothing HTTP/1.1\r\nHost: localhost\r\n\r\nGET /health HTTP/1.0\r\n\r\n");
  EXPECT_EQ(read_answer(client).status, 200);
  const Answer head = read_answer(client, false);
  EXPECT_EQ(head.status, 200);
  EXPECT_THAT(head.head, Not(HasSubstr("Content-Length: 0\r\n")));
  EXPECT_EQ(read_answer(client).status, 404);
  EXPECT_EQ(read_answer(client).status, 200);
  EXPECT_EQ(client.read_all(), "") << "HTTP/1.0 closes";
}

TEST(Http, AClientThatExpectsContinueReceivesIt) {
  const TestServer server;
  Client client(server.port());
  client.send("POST /api/x HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(client.read_until("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  client.send("{}");
  EXPECT_EQ(read_answer(client).status, 404);
}

TEST(Http, FilesAreSentOnlyIfTheyChanged) {
  const kv::TestFolder folder;
  const std::string big(300'000, 'b');
  std::ofstream(folder / "page.html") << "<p>hello";
  std::ofstream(folder / "big.txt") << big;
  const TestServer server({.files = folder / ""});
  const Answer page = get(server.port(), "/page.html");
  EXPECT_EQ(page.body, "<p>hello");
  EXPECT_THAT(page.head, HasSubstr("Content-Type: text/html; charset=utf-8\r\n"));
  EXPECT_THAT(page.head, HasSubstr("X-Content-Type-Options: nosniff\r\n"));
  const std::size_t at = page.head.find("ETag: ") + 6;
  const std::string tag = page.head.substr(at, page.head.find('\r', at) - at);
  EXPECT_EQ(get(server.port(), "/page.html", "If-None-Match: " + tag + "\r\n").status, 304);
  EXPECT_EQ(get(server.port(), "/page.html", "If-None-Match: \"other\"\r\n").status, 200);
  EXPECT_EQ(get(server.port(), "/big.txt").body, big);
  EXPECT_EQ(get(server.port(), "/../page.html").status, 404);
  EXPECT_EQ(get(server.port(), "/").status, 404) << "the folder has no index.html";
}

TEST(Http, RequestedRangesOfFilesAreSent) {
  const kv::TestFolder folder;
  std::string long_text;
  for (int i = 0; long_text.size() < 200'000; ++i) long_text += std::to_string(i) + '\n';
  std::ofstream(folder / "long.txt") << long_text;
  const TestServer server({.files = folder / ""});
  const auto part = [&](const std::string& headers) { return get(server.port(), "/long.txt", headers); };
  const Answer some = part("Range: bytes=100000-170000\r\n");
  EXPECT_EQ(some.status, 206);
  EXPECT_EQ(some.body, long_text.substr(100'000, 70'001));
  EXPECT_THAT(some.head, HasSubstr("Content-Range: bytes 100000-170000/" + std::to_string(long_text.size()) + "\r\n"));
  EXPECT_EQ(part("Range: bytes=-7\r\n").body, long_text.substr(long_text.size() - 7));
  const Answer beyond = part("Range: bytes=9999999-\r\n");
  EXPECT_EQ(beyond.status, 416);
  EXPECT_THAT(beyond.head, HasSubstr("Content-Range: bytes */" + std::to_string(long_text.size()) + "\r\n"));
  const Answer whole = part("Range: bytes=0-1\r\nIf-Range: \"another\"\r\n");
  EXPECT_EQ(whole.status, 200) << "it has changed since";
  EXPECT_EQ(whole.body, long_text);
  EXPECT_THAT(whole.head, HasSubstr("Accept-Ranges: bytes\r\n"));
  // On one connection, a range and then a whole file: nothing of the first affects the second.
  Client client(server.port());
  client.send("GET /long.txt HTTP/1.1\r\nHost: localhost\r\nRange: bytes=5-9\r\n\r\n");
  EXPECT_EQ(read_answer(client).body, long_text.substr(5, 5));
  client.send("GET /long.txt HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(read_answer(client).body, long_text);
}

TEST(Http, AllowedOriginsMayRead) {
  const TestServer server({.allowed_origins = {"https://signs.example.org"}});
  EXPECT_THAT(get(server.port(), "/api/databases", "Origin: https://signs.example.org\r\n").head,
              HasSubstr("Access-Control-Allow-Origin: https://signs.example.org\r\n"));
  EXPECT_THAT(get(server.port(), "/api/databases", "Origin: https://signs.example.org\r\n").head,
              HasSubstr("Access-Control-Expose-Headers: Signweave-Declarations, Signweave-Notices, ETag\r\n"));
  EXPECT_THAT(get(server.port(), "/api/databases", "Origin: https://evil.example\r\n").head,
              Not(HasSubstr("Access-Control")));
}

TEST(Http, SilentConnectionsAreClosedAndAffectNoOthers) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
  const std::size_t count = std::min<std::size_t>(1'000, files.rlim_cur / 2 - 100);
  ServerOptions options;
  options.limits.header_time = 1'500ms;
  const TestServer server(options);
  std::vector<Client> silent;
  for (std::size_t i = 0; i < count; ++i) {
    silent.emplace_back(server.port());
    ASSERT_TRUE(silent.back().connected());
    if (i % 2 == 1) silent.back().send("GET / HTTP/1.1\r\nHos");  // or stop in the middle of a word
  }
  EXPECT_EQ(get(server.port(), "/health").status, 200);
  for (Client& client : silent) EXPECT_EQ(client.read_all(), "");
  std::string metrics;
  for (int i = 0; metrics.find("\nsignweave_connections 1\n") == std::string::npos && i < 100; ++i) {
    std::this_thread::sleep_for(20ms);
    metrics = get(server.port(), "/metrics").body;
  }
  EXPECT_THAT(metrics, HasSubstr("\nsignweave_connections 1\n"));
}

TEST(Http, MoreConnectionsThanAllowedAreRefused) {
  ServerOptions options;
  options.limits.connections = 5;
  const TestServer server(options);
  std::vector<Client> held;
  for (int i = 0; i < 5; ++i) {
    held.emplace_back(server.port());
    held.back().send("GET /health HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(read_answer(held.back()).status, 200);
  }
  const Answer refused = get(server.port(), "/health");
  EXPECT_EQ(refused.status, 503);
  EXPECT_THAT(refused.head, HasSubstr("Retry-After: "));
  held.clear();
  int status = 503;
  for (int i = 0; status == 503 && i < 100; ++i) {  // until the server has noticed that they have closed
    status = get(server.port(), "/health").status;
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_EQ(status, 200);
}

TEST(Http, OneAddressMayNotTakeEverything) {
  ServerOptions options;
  options.limits.connections_per_address = 2;
  options.limits.requests_per_second = 0.001;
  options.limits.request_burst = 3;
  const TestServer server(options);
  Client client(server.port());
  for (int i = 0; i < 4; ++i) {
    client.send("GET /health HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(read_answer(client).status, i < 3 ? 200 : 429);
  }
  Client second(server.port());
  second.send("GET /health HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(read_answer(second).status, 429);
  EXPECT_EQ(get(server.port(), "/health").status, 503);
}

TEST(Http, AnUploadThatBreaksOffLeavesNothing) {
  const TestServer server({}, {testing::demo_folder()}, Serve::for_changes);
  const std::string line = upload_line(server.port());
  {
    Client client(server.port());
    client.send(line + "Content-Length: 1000000\r\n\r\n" + std::string(200'000, 'x'));
    for (int i = 0; i < 200 && server.bodies() == 0; ++i) std::this_thread::sleep_for(10ms);
    EXPECT_EQ(server.bodies(), 1u);
  }
  for (int i = 0; i < 200 && server.bodies() > 0; ++i) std::this_thread::sleep_for(10ms);
  EXPECT_EQ(server.bodies(), 0u);
  EXPECT_EQ(get(server.port(), "/health").status, 200);
}

TEST(Http, AnUploadThatIsRefusedLeavesNothing) {
  ServerOptions options;
  options.limits.file_bytes = 100'000;
  const TestServer server(options, {testing::demo_folder()}, Serve::for_changes);
  const std::string chunked = upload_line(server.port()) + "Transfer-Encoding: chunked\r\n\r\n";
  EXPECT_EQ(ask(server.port(), chunked + "3\r\nabc\r\nZZZ\r\n").status, 400);
  EXPECT_EQ(ask(server.port(), chunked + "186a1\r\n" + std::string(100'001, 'x') + "\r\n0\r\n\r\n").status, 413);
  EXPECT_EQ(server.bodies(), 0u);
  EXPECT_EQ(ask(server.port(), chunked + "3\r\nabc\r\n0\r\n\r\n").status, 200);
}

TEST(Http, AnUnknownUploadIsRefusedBeforeItsBody) {
  const std::string file = "PUT /api/databases/demo/uploads/1/files/x.bvh HTTP/1.1\r\nHost: localhost\r\n";
  const std::string nowhere = "PUT /api/databases/none/uploads/1/files/x.bvh HTTP/1.1\r\nHost: localhost\r\n";
  const std::string length = "Content-Length: 1000000\r\nExpect: 100-continue\r\n\r\n";
  const TestServer reading;
  EXPECT_EQ(ask(reading.port(), file + length).status, 403);
  EXPECT_EQ(ask(reading.port(), nowhere + length).status, 404);
  const TestServer writing({}, {testing::demo_folder()}, Serve::for_changes);
  EXPECT_EQ(ask(writing.port(), file + length).status, 404);
  EXPECT_EQ(writing.bodies(), 0u);
}

/// Repeats a request until the answer has this status, for at most 5 s.
void expect_soon(std::uint16_t port, const std::string& target, int status) {
  int got = 0;
  for (int i = 0; got != status && i < 100; ++i) {
    got = get(port, target).status;
    if (got != status) std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(got, status) << target;
}

TEST(Http, UnreadAnswersHoldBoundedMemory) {
  ServerOptions options;
  options.limits.held_bytes = 100'000;
  const TestServer server(options);
  const std::string motion = "/api/databases/demo/recordings/meteo/motion?format=csv";
  {
    Client slow(server.port(), 4'096);
    slow.send("GET " + motion + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_THAT(slow.read_until("\r\n"), HasSubstr("200 OK")) << "a single answer may have any length";
    const Answer refused = get(server.port(), motion);
    EXPECT_EQ(refused.status, 503);
    EXPECT_THAT(refused.body, HasSubstr("\"busy\""));
    EXPECT_EQ(get(server.port(), "/health").status, 200);
  }
  expect_soon(server.port(), motion, 200);
}

TEST(Http, BodiesThatDoNotEndHoldBoundedMemory) {
  ServerOptions options;
  options.limits.held_bytes = 200'000;
  const TestServer server(options);
  const std::string head =
      "POST /api/databases/demo/query HTTP/1.1\r\nHost: localhost\r\nContent-Length: 500000\r\n\r\n";
  {
    Client first(server.port());
    first.send(head + std::string(200'000, ' '));
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(ask(server.port(), head + std::string(200'000, ' ')).status, 503);
  }
  expect_soon(server.port(), "/api/databases/demo", 200);
}

TEST(Http, ABodyThatStopsIsNotAwaitedForever) {
  ServerOptions options;
  options.limits.body_time = 300ms;
  const TestServer server(options);
  Client client(server.port());
  client.send("POST /api/x HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\nabc");
  EXPECT_EQ(client.read_all(), "");
}

}  // namespace
}  // namespace signweave::server
