#include "app/server/access.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/ip/address.hpp>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::server {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

/// "localhost:8080" and "[::1]:8080" without their port and brackets.
std::string name_of_host(std::string_view host) {
  if (host.starts_with('[')) return lower(host.substr(1, host.find(']') - 1));
  return lower(host.substr(0, host.find(':')));
}

bool same_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  }
  return difference == 0;
}

}  // namespace

bool is_loopback(std::string_view address) {
  if (lower(address) == "localhost") return true;
  boost::system::error_code error;
  const auto parsed = boost::asio::ip::make_address(std::string(address), error);
  return !error && parsed.is_loopback();
}

AccessControl::AccessControl(const ServerOptions& options) : token_(options.token) {
  if (token_.empty() && !is_loopback(options.address)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{} can be reached from other machines, so a token is required: give --token-file FILE or "
                            "SIGNWEAVE_TOKEN, or listen on 127.0.0.1",
                            printable(options.address)));
  }
  const bool plain = std::ranges::all_of(token_, [](char c) { return c > 0x20 && c < 0x7f; });
  if (!token_.empty() && (token_.size() < 16 || !plain)) {
    throw Error(ErrorCode::bad_input,
                "the token must have at least 16 characters, all visible ASCII; 'openssl rand -hex 32' generates one");
  }
  for (const std::string& origin : options.allowed_origins) {
    const std::string known = lower(origin);
    const std::size_t slashes = known.find("://");
    const bool good = (known.starts_with("http://") || known.starts_with("https://")) && known.size() > slashes + 3 &&
                      known.find_first_of("/ ?#*", slashes + 3) == std::string::npos;
    if (!good) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("'{}' is not an origin: give scheme and host, such as https://signs.example.org",
                              printable(origin)));
    }
    origins_.push_back(known);
    hosts_.push_back(name_of_host(std::string_view(known).substr(slashes + 3)));
  }
}

bool AccessControl::host_is_ours(std::string_view host) const {
  if (!token_.empty()) return true;
  const std::string name = name_of_host(host);
  return is_loopback(name) || std::ranges::find(hosts_, name) != hosts_.end();
}

bool AccessControl::origin_is_allowed(std::string_view origin) const {
  return std::ranges::find(origins_, lower(origin)) != origins_.end();
}

bool AccessControl::origin_is_ours(std::string_view origin, std::string_view host) const {
  if (origin.empty()) return true;
  return origin_is_allowed(origin) || lower(origin) == fmt::format("http://{}", lower(host));
}

bool AccessControl::token_is_right(std::string_view authorization, std::string_view query_token) const {
  if (token_.empty()) return true;
  constexpr std::string_view kScheme = "bearer ";
  if (authorization.empty()) return same_in_constant_time(query_token, token_);
  if (lower(authorization.substr(0, kScheme.size())) != kScheme) return false;
  return same_in_constant_time(trimmed(authorization.substr(kScheme.size())), token_);
}

}  // namespace signweave::server
