#include "app/server/access.h"

#include <gtest/gtest.h>

#include "app/server/http_decision.h"
#include "signweave/core/error.h"

namespace signweave::server {
namespace {

const std::string kToken = "0123456789abcdef0123";

TEST(AccessControl, AnyOtherAddressThanLoopbackRequiresAToken) {
  for (const char* address : {"127.0.0.1", "127.8.9.1", "::1", "localhost"}) {
    EXPECT_NO_THROW(AccessControl({.address = address})) << address;
  }
  for (const char* address : {"0.0.0.0", "::", "192.168.1.2", "example.org", "127.0.0.1.evil.org"}) {
    EXPECT_THROW(AccessControl({.address = address}), Error) << address;
    EXPECT_NO_THROW(AccessControl({.address = address, .token = kToken})) << address;
  }
  EXPECT_THROW(AccessControl({.token = "short"}), Error);
  EXPECT_THROW(AccessControl({.token = "with a blank in its middle"}), Error);
}

TEST(AccessControl, TheTokenMustBeTheWholeToken) {
  const AccessControl access({.token = kToken});
  EXPECT_TRUE(access.token_is_right("Bearer " + kToken, ""));
  EXPECT_TRUE(access.token_is_right("bearer " + kToken, ""));
  EXPECT_TRUE(access.token_is_right("", kToken));
  for (const std::string& wrong : std::vector<std::string>{"", kToken, "Bearer", "Bearer " + kToken.substr(1),
                                                           "Bearer " + kToken + "x", "Basic " + kToken}) {
    EXPECT_FALSE(access.token_is_right(wrong, "")) << wrong;
  }
  EXPECT_FALSE(access.token_is_right("Bearer wrong-token-of-20-ch", kToken)) << "the header has priority";
  EXPECT_TRUE(AccessControl(ServerOptions{}).token_is_right("", ""));
}

TEST(AccessControl, AHostOtherThanLoopbackIsRefused) {
  const AccessControl access({.allowed_origins = {"https://signs.example.org"}});
  for (const char* host : {"localhost", "LOCALHOST:8080", "127.0.0.1:8080", "[::1]:8080", "signs.example.org"}) {
    EXPECT_TRUE(access.host_is_ours(host)) << host;
  }
  for (const char* host :
       {"", "evil.example", "127.0.0.1.evil.example:8080", "localhost.evil.example", "192.168.1.2"}) {
    EXPECT_FALSE(access.host_is_ours(host)) << host;
  }
}

TEST(AccessControl, AnOriginIsTheServersOwnOrAllowed) {
  const AccessControl access({.allowed_origins = {"https://signs.example.org"}});
  for (const char* origin : {"", "http://localhost:8080", "HTTP://LOCALHOST:8080", "https://signs.example.org"}) {
    EXPECT_TRUE(access.origin_is_ours(origin, "localhost:8080")) << origin;
  }
  for (const char* origin : {"null", "http://localhost", "http://localhost:8081", "https://localhost:8080",
                             "http://evil.example", "https://signs.example.org.evil.example", "file://"}) {
    EXPECT_FALSE(access.origin_is_ours(origin, "localhost:8080")) << origin;
  }
  for (const char* origin : {"signs.example.org", "https://", "https://*", "https://a/b", "ftp://a"}) {
    EXPECT_THROW(AccessControl({.allowed_origins = {origin}}), Error) << origin;
  }
}

struct AccessCase {
  RequestHead head;
  int status;  // 0: not answered by the decision
};

TEST(Decision, OfHeaders) {
  const ServerOptions open{.allowed_origins = {"https://signs.example.org"}};
  const ServerOptions closed{.token = kToken};
  const std::string bearer = "Bearer " + kToken;
  const auto status_of = [](const RequestHead& head, const ServerOptions& options) {
    const Decision decision = decide(head, options, AccessControl(options));
    return decision.reply ? decision.reply->status : 0;
  };
  const std::string long_target = "/" + std::string(9'000, 'a');
  const AccessCase cases[] = {
      {{.method = "GET", .target = "/api/databases", .host = "localhost"}, 0},
      {{.method = "GET", .target = "/", .host = "localhost"}, 200},
      {{.method = "GET", .target = "/other", .host = "localhost"}, 404},
      {{.method = "POST", .target = "/", .host = "localhost"}, 405},
      {{.method = "DELETE", .target = "/health", .host = "localhost"}, 405},
      {{.method = "GET", .target = "/", .version = 20, .host = "localhost"}, 505},
      {{.method = "GET", .target = "/", .hosts = 0}, 400},
      {{.method = "GET", .target = "/", .hosts = 2, .host = "localhost"}, 400},
      {{.method = "GET", .target = "/", .version = 10, .hosts = 0}, 200},
      {{.method = "GET", .target = "/", .host = "evil.example"}, 421},
      {{.method = "GET", .target = "/%zz", .host = "localhost"}, 400},
      {{.method = "GET", .target = long_target, .host = "localhost"}, 414},
      {{.method = "GET", .target = "/api/databases", .host = "localhost", .origin = "http://evil.example"}, 0},
      {{.method = "POST", .target = "/api/databases", .host = "localhost", .origin = "http://evil.example"}, 403},
      {{.method = "DELETE", .target = "/api/x", .host = "localhost", .origin = "null"}, 403},
      {{.method = "POST", .target = "/api/x", .host = "localhost", .origin = "https://signs.example.org"}, 0},
      {{.method = "OPTIONS", .target = "/api/x", .host = "localhost", .origin = "https://signs.example.org"}, 204},
      {{.method = "OPTIONS", .target = "/api/x", .host = "localhost", .origin = "http://evil.example"}, 403},
      {{.method = "GET", .target = "/api/stream", .host = "localhost"}, 426},
      {{.method = "GET", .target = "/api/stream", .host = "localhost", .upgrade = true}, 0},
      {{.method = "GET",
        .target = "/api/stream",
        .host = "localhost",
        .origin = "http://evil.example",
        .upgrade = true},
       403},
  };
  for (const AccessCase& one : cases) {
    EXPECT_EQ(status_of(one.head, open), one.status)
        << one.head.method << ' ' << one.head.target.substr(0, 40) << ' ' << one.head.host << ' ' << one.head.origin;
  }
  const std::string in_query = "/api/stream?token=" + kToken;
  const std::string call_in_query = "/api/databases?token=" + kToken;
  const AccessCase with_token[] = {
      {{.method = "GET", .target = "/api/databases", .host = "a"}, 401},
      {{.method = "GET", .target = "/api/databases", .host = "a", .authorization = bearer}, 0},
      {{.method = "GET", .target = "/metrics", .host = "a"}, 401},
      {{.method = "GET", .target = "/health", .host = "a"}, 0},
      {{.method = "GET", .target = "/", .host = "a"}, 200},
      {{.method = "GET", .target = "/api/stream", .host = "a", .upgrade = true}, 401},
      {{.method = "GET", .target = in_query, .host = "a", .upgrade = true}, 0},
      {{.method = "GET", .target = call_in_query, .host = "a"}, 401},
  };
  for (const AccessCase& one : with_token) {
    EXPECT_EQ(status_of(one.head, closed), one.status) << one.head.target;
  }
}

}  // namespace
}  // namespace signweave::server
