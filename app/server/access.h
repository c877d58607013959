#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/server/options.h"

namespace signweave::server {

/// Who may ask for what. Pages of other sites reach a server on loopback through the browser of its user: by their
/// origin, which browsers tell, and by a name of theirs that is made to stand for 127.0.0.1, which the Host tells.
class Access {
 public:
  /// Throws Error{bad_input} where another address than loopback is asked for without a token, or a token or an
  /// origin is none.
  explicit Access(const ServerOptions& options);

  /// True where the request is meant for this server: without a token its Host must name loopback or an allowed origin.
  bool host_is_ours(std::string_view host) const;
  /// True where no origin is told, or it is the server's own under this Host, or an allowed one.
  bool origin_is_ours(std::string_view origin, std::string_view host) const;
  /// True for those of `--allow-origin`, which get CORS headers.
  bool origin_is_allowed(std::string_view origin) const;
  /// Looks at "Authorization: Bearer …", and where there is none at `query_token`. True where no token is asked for.
  /// Takes as long for every wrong token of one length.
  bool token_is_right(std::string_view authorization, std::string_view query_token) const;

 private:
  std::string token_;
  std::vector<std::string> origins_;
  std::vector<std::string> hosts_;  // of the allowed origins
};

/// True for 127.0.0.0/8, ::1 and localhost.
bool is_loopback(std::string_view address);

}  // namespace signweave::server
