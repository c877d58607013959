#include "app/server/api.h"
#include "signweave/notation/answer_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "app/server/routes.h"
#include "app/wire/text.h"
#include "signweave/core/text.h"

namespace signweave::server {
namespace {

/// Removes what no client needs to know: where the server stores its files.
std::string redacted(const ApiState& state, std::string text) {
  const auto replace = [&](const std::string& folder, const std::string& with) {
    if (folder.empty()) return;
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos; at += with.size()) {
      text.replace(at, folder.size(), with);
    }
  };
  replace((state.scratch / "").string(), "");
  replace(state.scratch.string(), "scratch");
  for (const auto& one : state.databases.all()) {
    replace((one->database().folder() / "").string(), "");
    replace(one->database().folder().string(), one->name());
  }
  return text;
}

std::string path_text(const std::vector<std::string>& path) {
  return fmt::format("/api/{}", fmt::join(path, "/"));
}

/// For a wrong path: the paths with the same number of segments, with the request's names filled in.
std::vector<std::string> paths_like(const std::vector<std::string>& path) {
  std::vector<std::string> like;
  for (const Route& route : routes()) {
    std::vector<std::string> filled;
    for (const std::string_view segment : segments_of(route.path)) {
      const bool named = segment.starts_with('{') && filled.size() < path.size();
      filled.push_back(named ? path[filled.size()] : std::string(segment));
    }
    if (filled.size() != path.size()) continue;
    std::string text = path_text(filled);
    if (std::ranges::find(like, text) == like.end()) like.push_back(std::move(text));
  }
  return like;
}

/// The route of a request. Throws StatusError 405 with the allowed methods, Error{not_found} with near matches.
const Route& route_of(const ApiRequest& request, std::string& allowed) {
  for (const Route& route : routes()) {
    if (!match(route, request.path)) continue;
    if (route.method == request.method) return route;
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", route.method);
  }
  if (!allowed.empty()) {
    throw StatusError(
        405, "method_not_allowed",
        fmt::format("{} takes {}, not {}", printable(path_text(request.path)), allowed, printable(request.method)));
  }
  const std::string path = path_text(request.path);
  throw Error(ErrorCode::not_found, fmt::format("there is nothing at {} (/api/openapi.json lists what there is){}",
                                                printable(path), did_you_mean(path, paths_like(request.path))));
}

/// Checks what a route requires of every request.
void check_request(const Call& call) {
  const Route& route = call.route;
  if (route.source != Source::query) wire::FieldReader(call.request.query, {}).finish();
  const bool has_body = !call.request.body.empty() && !route.takes_file;
  if (has_body && route.source != Source::body && route.takes.empty()) {
    throw Error(ErrorCode::bad_input, fmt::format("{} {} takes no body", route.method, route.path));
  }
  const std::string type = fold_case(trimmed(call.request.content_type.substr(0, call.request.content_type.find(';'))));
  if (has_body && type != "application/json") {
    throw StatusError(
        415, "unsupported_media_type",
        fmt::format("the body must be JSON: send Content-Type: application/json, not '{}'", printable(type)));
  }
  if (route.changes && !call.database().writable()) {
    throw StatusError(403, "read_only",
                      fmt::format("'{}' is served for reading only; serve it with --writable", call.database().name()));
  }
}

ApiResponse answer_call(ApiState& state, const ApiRequest& request, std::string& allowed) {
  const Route& route = route_of(request, allowed);
  Call call{.state = state, .request = request, .route = route, .names = *match(route, request.path)};
  check_request(call);
  ApiResponse response = route.handle(call);
  if (response.status == 200 && route.status != 200) response.status = route.status;
  // In headers, because files and lists have no room for them. Clients would refuse long lists.
  if (!call.declarations.empty()) {
    response.headers.emplace_back("Signweave-Declarations",
                                  header_json(answer_json<nlohmann::json>(call.declarations)));
  }
  if (!call.notices.empty()) {
    std::vector<Notice> notices(
        call.notices.begin(),
        call.notices.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(10, call.notices.size())));
    for (Notice& notice : notices) {
      notice = {redacted(state, notice.where), redacted(state, notice.text), notice.remedies};
    }
    response.headers.emplace_back("Signweave-Notices", header_json(answer_json<nlohmann::json>(notices)));
  }
  return response;
}

/// Returns what `make` returns, or the answer to what it throws.
template <class Make>
ApiResponse guarded(const ApiState& state, const std::string& allowed, Make make) {
  const auto redact = [&](std::string text) { return redacted(state, std::move(text)); };
  try {
    return make();
  } catch (const StatusError& error) {
    ApiResponse response = error_answer(error, redact);
    if (error.status() == 405) response.headers.emplace_back("Allow", allowed);
    return response;
  } catch (const Error& error) {
    return error_answer(error, redact);
  } catch (const std::bad_alloc&) {
    return error_answer(StatusError(503, "no_memory", "not enough memory for this request; request less"), redact);
  } catch (const std::exception& error) {
    return error_answer(Error(ErrorCode::io, error.what()), redact);
  }
}

}  // namespace

Api::Api(ServedDatabases& databases, ApiLimits limits, const std::filesystem::path& scratch) {
  auto* state = new State{{.databases = databases,
                           .limits = limits,
                           .scratch = scratch,
                           .uploads = {scratch / "uploads", limits.uploads, limits.upload_bytes, limits.upload_idle},
                           .jobs = {[this](std::string text) { return redacted(*state_, std::move(text)); },
                                    [this] { state_->uploads.sweep(); }}}};
  state_.reset(state);
  state_->jobs.begin();
}

Api::~Api() = default;

bool Api::takes_file(const ApiRequest& request) const {
  return std::ranges::any_of(routes(), [&](const Route& route) {
    return route.takes_file && route.method == request.method && match(route, request.path);
  });
}

bool Api::takes_document(const ApiRequest& request) const {
  return std::ranges::any_of(routes(), [&](const Route& route) {
    return !route.takes.empty() && route.method == request.method && match(route, request.path);
  });
}

std::optional<ApiResponse> Api::refusal(const ApiRequest& request) {
  std::string allowed;
  bool needed = false;
  ApiResponse response = guarded(*state_, allowed, [&] {
    const Route& route = route_of(request, allowed);
    const Call call{.state = *state_, .request = request, .route = route, .names = *match(route, request.path)};
    check_request(call);
    if (route.require != nullptr) route.require(call);
    needed = true;
    return ApiResponse{};
  });
  if (needed) return std::nullopt;
  return response;
}

ApiResponse Api::answer(ApiRequest request) {
  std::string allowed;
  ApiResponse response = guarded(*state_, allowed, [&] { return answer_call(*state_, request, allowed); });
  if (!request.body_file.empty()) {  // if no call has moved it
    std::error_code ignored;
    std::filesystem::remove(request.body_file, ignored);
  }
  return response;
}

}  // namespace signweave::server
