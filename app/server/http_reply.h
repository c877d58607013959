#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace signweave::server {

/// An answer but for its file and how it is sent.
struct Reply {
  int status = 200;
  std::string content_type;  ///< empty where there is no body
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  bool close = false;  ///< the connection ends after it
};

/// {"error": {"code": …, "message": …}} of this status.
Reply error_reply(int status, std::string_view code, std::string_view message);

/// What "/" shows where no folder is served.
Reply built_in_page();

/// How an answer is written.
struct ReplyForm {
  std::size_t length = 0;   ///< of the body
  bool keep_alive = true;   ///< the connection stays
  bool http_1_0 = false;    ///< the client speaks HTTP/1.0, and must be told that it does
  std::string_view origin;  ///< that may read the answer; empty: none but the server's own
};

/// The status line and the headers, with those that every answer has: what a page may do, and that nobody guesses its
/// type. Line breaks in headers become blanks.
std::string head_of(const Reply& reply, const ReplyForm& form);

}  // namespace signweave::server
