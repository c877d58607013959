#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace signweave::server {

/// An answer, except for its file and how it is sent.
struct Reply {
  int status = 200;
  std::string content_type;  ///< empty if there is no body
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  bool close = false;  ///< the connection ends after this answer
};

/// {"error": {"code": …, "message": …}} with this status.
Reply error_reply(int status, std::string_view code, std::string_view message);

/// The page shown at "/" if no folder is served.
Reply built_in_page();

/// How an answer is written.
struct ReplyForm {
  std::size_t length = 0;   ///< of the body
  bool keep_alive = true;   ///< the connection stays open
  bool http_1_0 = false;    ///< the client speaks HTTP/1.0, so a connection that stays open is announced
  std::string_view origin;  ///< allowed to read the answer; empty: only the server's own
};

/// The status line and the headers, including the security headers that every answer has (what a page may do, no
/// guessing of types). Line breaks in headers become blanks.
std::string head_of(const Reply& reply, const ReplyForm& form);

}  // namespace signweave::server
