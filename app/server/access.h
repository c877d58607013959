#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/server/options.h"

namespace signweave::server {

/// Access control of requests. Pages of other sites can reach a server on loopback through its user's browser:
/// directly, which the Origin header reveals, or through a name of theirs that resolves to 127.0.0.1 (DNS rebinding),
/// which the Host header reveals.
class AccessControl {
 public:
  /// Throws Error{bad_input} if the address is not loopback and there is no token, or if the token or an origin is
  /// malformed.
  explicit AccessControl(const ServerOptions& options);

  /// True if the request is meant for this server: without a token, its Host must be loopback or that of an allowed
  /// origin.
  bool host_is_ours(std::string_view host) const;
  /// True if there is no origin, or if it is the server's own under this Host, or an allowed one.
  bool origin_is_ours(std::string_view origin, std::string_view host) const;
  /// True for origins given by `--allow-origin`, which get CORS headers.
  bool origin_is_allowed(std::string_view origin) const;
  /// Checks "Authorization: Bearer …" or, without that header, `query_token`. True if the server requires no token.
  /// Takes the same time for every wrong token of a given length.
  bool token_is_right(std::string_view authorization, std::string_view query_token) const;

 private:
  std::string token_;
  std::vector<std::string> origins_;
  std::vector<std::string> hosts_;  // hosts of the allowed origins
};

/// True for 127.0.0.0/8, ::1 and localhost.
bool is_loopback(std::string_view address);

}  // namespace signweave::server
