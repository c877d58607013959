#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/server/access.h"
#include "app/server/http_reply.h"
#include "app/server/http_target.h"
#include "app/server/metrics.h"

namespace signweave::server {

/// The parts of a request's header that decide how it is answered. Texts are borrowed from the request.
struct RequestHead {
  std::string_view method;
  std::string_view target;
  unsigned version = 11;  ///< 10 for HTTP/1.0
  std::size_t hosts = 1;  ///< number of Host headers
  std::string_view host;
  std::string_view origin;
  std::string_view authorization;
  bool upgrade = false;  ///< to a WebSocket
};

/// How a request is answered.
struct Decision {
  RouteClass route = RouteClass::refused;
  std::optional<Reply> reply;  ///< set if the answer is decided already
  HttpTarget target;
  bool allowed_origin = false;  ///< given by `--allow-origin`: gets CORS headers
};

/// Decides from the header alone: version, Host, Origin, token, method and path. Calls, files and streams are returned
/// without a reply; everything else has one.
Decision decide(const RequestHead& head, const ServerOptions& options, const AccessControl& access);

}  // namespace signweave::server
