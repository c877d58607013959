#include "app/server/http_reply.h"

#include <fmt/format.h>

#include <boost/beast/http/status.hpp>
#include <ctime>
#include <nlohmann/json.hpp>

#include "app/server/static_files.h"

namespace signweave::server {
namespace {

constexpr std::string_view kPage = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>signweave</title>
<h1>signweave</h1>
<p>This is a signweave server: a database of captured signing: search it by meaning and movement, make new signing from it.</p>
<p>Its calls are described by <a href="/api/openapi.json">/api/openapi.json</a>, its streams of frames by docs/stream.md;
what is served: <a href="/api/databases">/api/databases</a>. No folder of pages is served (<code>--files FOLDER</code>).</p>
</html>
)";

/// Scripts and styles only from this server; WebAssembly; pictures and models that a page generates itself.
constexpr std::string_view kPolicy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; media-src 'self' blob:; worker-src 'self' blob:; connect-src 'self' blob: data:; "
    "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

void add(std::string& out, std::string_view name, std::string_view value) {
  const auto plain = [&](std::string_view text) {
    for (const char c : text) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  };
  plain(name);
  out += ": ";
  plain(value);
  out += "\r\n";
}

}  // namespace

Reply error_reply(int status, std::string_view code, std::string_view message) {
  const nlohmann::ordered_json body = {{"error", {{"code", code}, {"message", message}}}};
  return {.status = status,
          .content_type = "application/json",
          .headers = {},
          .body = body.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"};
}

Reply built_in_page() {
  return {.status = 200, .content_type = "text/html; charset=utf-8", .headers = {}, .body = std::string(kPage)};
}

std::string head_of(const Reply& reply, const ReplyForm& form) {
  namespace http = boost::beast::http;
  const auto reason = http::obsolete_reason(http::int_to_status(static_cast<unsigned>(reply.status)));
  std::string out = fmt::format("HTTP/1.1 {} {}\r\n", reply.status, std::string_view(reason.data(), reason.size()));
  add(out, "Date", http_date(std::time(nullptr)));
  add(out, "Server", "signweave");
  if (!reply.content_type.empty()) add(out, "Content-Type", reply.content_type);
  if (reply.status != 304 && reply.status != 204) add(out, "Content-Length", fmt::format("{}", form.length));
  add(out, "X-Content-Type-Options", "nosniff");
  add(out, "Referrer-Policy", "no-referrer");
  add(out, "Cross-Origin-Resource-Policy", form.origin.empty() ? "same-origin" : "cross-origin");
  if (reply.content_type.starts_with("text/html")) add(out, "Content-Security-Policy", kPolicy);
  if (!form.origin.empty()) {
    add(out, "Access-Control-Allow-Origin", form.origin);
    add(out, "Access-Control-Expose-Headers", "Signweave-Declarations, Signweave-Notices, ETag");
    add(out, "Vary", "Origin");
  }
  for (const auto& [name, value] : reply.headers) add(out, name, value);
  if (!form.keep_alive) {
    add(out, "Connection", "close");
  } else if (form.http_1_0) {
    add(out, "Connection", "keep-alive");
  }
  out += "\r\n";
  return out;
}

}  // namespace signweave::server
