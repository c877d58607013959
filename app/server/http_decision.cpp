#include "app/server/http_decision.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"

namespace signweave::server {
namespace {

Reply method_not_allowed(std::string_view method, std::string_view allowed) {
  Reply reply = error_reply(405, "method_not_allowed", fmt::format("{} is not allowed here", printable(method)));
  reply.headers.emplace_back("Allow", allowed);
  return reply;
}

Reply preflight() {
  return {.status = 204,
          .content_type = "",
          .headers = {{"Access-Control-Allow-Methods", "GET, HEAD, POST, PUT, DELETE"},
                      {"Access-Control-Allow-Headers", "Authorization, Content-Type"},
                      {"Access-Control-Max-Age", "600"}},
          .body = ""};
}

RouteClass class_of(const HttpTarget& target) {
  const std::string& first = target.path.front();
  if (target.path.size() == 1 && first == "health") return RouteClass::health;
  if (target.path.size() == 1 && first == "metrics") return RouteClass::metrics;
  if (first != "api") return RouteClass::file;
  return target.path.size() == 2 && target.path[1] == "stream" ? RouteClass::stream : RouteClass::api;
}

}  // namespace

Decision decide(const RequestHead& head, const ServerOptions& options, const AccessControl& access) {
  const auto refuse = [](Reply reply) { return Decision{.route = RouteClass::refused, .reply = std::move(reply)}; };
  if (head.version != 10 && head.version != 11) {
    return refuse(error_reply(505, "unsupported", "only HTTP/1.0 and 1.1 are supported"));
  }
  if (head.hosts > 1 || (head.hosts == 0 && head.version == 11)) {
    return refuse(error_reply(400, "bad_input", "a request needs exactly one Host header"));
  }
  if (head.target.size() > options.limits.target_bytes) {
    return refuse(error_reply(414, "bad_input",
                              fmt::format("a path must not be longer than {} bytes", options.limits.target_bytes)));
  }
  if (head.hosts == 1 && !access.host_is_ours(head.host)) {
    return refuse(
        error_reply(421, "bad_input",
                    fmt::format("'{}' is not this server; use --allow-origin to allow it", printable(head.host))));
  }
  std::optional<HttpTarget> target = parse_target(head.target);
  if (!target) return refuse(error_reply(400, "bad_input", "the path cannot be read"));

  Decision decision{.route = class_of(*target), .reply = {}, .target = *std::move(target)};
  decision.allowed_origin = !head.origin.empty() && access.origin_is_allowed(head.origin);
  const auto answer = [&](Reply reply) {
    decision.reply = std::move(reply);
    return decision;
  };
  const bool reads = head.method == "GET" || head.method == "HEAD";
  if (head.method == "OPTIONS" && !head.origin.empty()) {
    return answer(decision.allowed_origin
                      ? preflight()
                      : error_reply(403, "forbidden", "this origin is not allowed; see --allow-origin"));
  }
  const bool needs_own_origin = !reads || decision.route == RouteClass::stream;
  if (needs_own_origin && !access.origin_is_ours(head.origin, head.host)) {
    return answer(error_reply(
        403, "bad_input",
        fmt::format("origin '{}' is not this server's; use --allow-origin to allow it", printable(head.origin))));
  }
  const bool needs_token = decision.route != RouteClass::file && decision.route != RouteClass::health;
  if (needs_token) {
    // A page cannot set headers of a WebSocket, so a stream may pass its token in the query.
    const auto found = decision.target.query.find("token");
    const bool in_query = decision.route == RouteClass::stream && found != decision.target.query.end();
    if (!access.token_is_right(head.authorization, in_query ? std::string_view(found->second) : std::string_view())) {
      Reply reply = error_reply(401, "unauthorized", "a token is needed: Authorization: Bearer TOKEN");
      reply.headers.emplace_back("WWW-Authenticate", "Bearer");
      return answer(std::move(reply));
    }
  }
  decision.target.query.erase("token");
  if (decision.route != RouteClass::api && !reads) return answer(method_not_allowed(head.method, "GET, HEAD"));
  if (decision.route == RouteClass::stream && (!head.upgrade || head.method != "GET")) {
    Reply reply = error_reply(426, "bad_input", "/api/stream is a WebSocket; docs/stream.md describes its protocol");
    reply.headers.emplace_back("Upgrade", "websocket");
    return answer(std::move(reply));
  }
  if (decision.route == RouteClass::file && options.files.empty()) {
    const bool root = decision.target.path.size() == 1 && decision.target.path[0].empty();
    return answer(root ? built_in_page() : error_reply(404, "not_found", "there is no such page"));
  }
  return decision;
}

}  // namespace signweave::server
