#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/server/access.h"
#include "app/server/http_reply.h"
#include "app/server/http_target.h"
#include "app/server/metrics.h"

namespace signweave::server {

/// What of a request's header decides where it goes. Texts are borrowed from the request.
struct RequestHead {
  std::string_view method;
  std::string_view target;
  unsigned version = 11;  ///< 10 is HTTP/1.0
  std::size_t hosts = 1;  ///< how many Host headers there are
  std::string_view host;
  std::string_view origin;
  std::string_view authorization;
  bool upgrade = false;  ///< to a WebSocket
};

/// Where a request goes.
struct Decision {
  RouteClass route = RouteClass::refused;
  std::optional<Reply> reply;  ///< already the answer
  HttpTarget target;
  bool allowed_origin = false;  ///< of `--allow-origin`: gets CORS headers
};

/// Decides by the header alone: version, Host, Origin, token, method and path. Calls, files and streams come back
/// without a reply; everything else has one.
Decision decide(const RequestHead& head, const ServerOptions& options, const Access& access);

}  // namespace signweave::server
