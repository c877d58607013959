#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/server/api.h"
#include "signweave/core/error.h"

namespace signweave::server {

/// An error that has its own HTTP status: limits, methods, media types.
class StatusError : public Error {
 public:
  StatusError(int status, std::string name, const std::string& text)
      : Error(ErrorCode::bad_input, text), status_(status), name_(std::move(name)) {}
  int status() const noexcept { return status_; }
  const std::string& name() const noexcept { return name_; }

 private:
  int status_;
  std::string name_;
};

StatusError too_large(const std::string& text);

/// 400 bad_input, 404 not_found, 409 already_exists and conflict, 422 unsupported, 500 corrupt and io, 503 cancelled.
int status_of(const Error& error);
/// {"code", "message"} on one line; for an error in a query also "line", "column", "caret". `redact` removes folders
/// from texts.
nlohmann::json error_json(const Error& error, const std::function<std::string(std::string)>& redact);

ApiResponse error_answer(const Error& error, const std::function<std::string(std::string)>& redact);

template <class Json>
ApiResponse json_answer(const Json& document, int status = 200) {
  return {.status = status,
          .content_type = "application/json",
          .headers = {},
          .body = document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n'};
}

/// The file extension and media type of a format: "bvh" -> ".bvh".
struct AnswerFormat {
  std::string_view name;
  std::string_view extension;
  std::string_view media_type;
};
/// Throws Error{bad_input} if there is no format of this name.
const AnswerFormat& answer_format(std::string_view name);

/// A file, to be saved as `stem` with the format's extension.
ApiResponse file_answer(const AnswerFormat& format, const std::string& stem, std::string body);

/// JSON as ASCII text, for a header.
std::string header_json(const nlohmann::json& document);

}  // namespace signweave::server
