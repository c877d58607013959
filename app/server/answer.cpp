#include "app/server/answer.h"

#include <fmt/format.h>

#include "app/wire/fault.h"
#include "signweave/core/text.h"
#include "signweave/formats/file_format.h"

namespace signweave::server {
namespace {

using nlohmann::json;

/// The formats of answers: every file format that is written, by its extension, and those that only HTTP has.
const std::vector<AnswerFormat>& answer_formats() {
  static const std::vector<AnswerFormat> formats = [] {
    std::vector<AnswerFormat> list;
    for (const FileFormat& format : file_formats()) {
      if (format.writes()) list.push_back({format.extension.substr(1), format.extension, format.media_type});
    }
    list.push_back({"frames", ".frames", "application/vnd.signweave.frames"});
    list.push_back({"score", ".score.json", "application/vnd.signweave.score+json"});
    return list;
  }();
  return formats;
}

/// On one line, with options named as the API's fields: "--replace-motion" becomes "replace_motion".
std::string message_of(const std::string& text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) < 0x20) {
      line += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
      continue;
    }
    const bool option = text.compare(i, 2, "--") == 0 && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '(') &&
                        i + 2 < text.size() && text[i + 2] >= 'a' && text[i + 2] <= 'z';
    if (!option) {
      line += c;
      continue;
    }
    for (i += 2; i < text.size() && ((text[i] >= 'a' && text[i] <= 'z') || text[i] == '-'); ++i) {
      line += text[i] == '-' ? '_' : text[i];
    }
    --i;
  }
  return line;
}

}  // namespace

StatusError too_large(const std::string& text) {
  return {413, "too_large", text};
}

int status_of(const Error& error) {
  if (const auto* own = dynamic_cast<const StatusError*>(&error)) return own->status();
  switch (error.code()) {
    case ErrorCode::bad_input:
      return 400;
    case ErrorCode::not_found:
      return 404;
    case ErrorCode::already_exists:
    case ErrorCode::conflict:
      return 409;
    case ErrorCode::unsupported:
      return 422;
    case ErrorCode::cancelled:
      return 503;
    case ErrorCode::corrupt:
    case ErrorCode::io:
      return 500;
  }
  return 500;
}

json error_json(const Error& error, const std::function<std::string(std::string)>& redact) {
  const auto* own = dynamic_cast<const StatusError*>(&error);
  const std::string_view code = own != nullptr ? std::string_view(own->name()) : name_of(error.code());
  return wire::fault_json(error, code, message_of(redact(error.what())));
}

ApiResponse error_answer(const Error& error, const std::function<std::string(std::string)>& redact) {
  return json_answer(json{{"error", error_json(error, redact)}}, status_of(error));
}

const AnswerFormat& answer_format(std::string_view name) {
  std::vector<std::string> known;
  for (const AnswerFormat& format : answer_formats()) {
    if (format.name == name) return format;
    known.emplace_back(format.name);
  }
  throw Error(ErrorCode::bad_input, fmt::format("no format '{}'{}", printable(name), did_you_mean(name, known)));
}

ApiResponse file_answer(const AnswerFormat& format, const std::string& stem, std::string body) {
  std::string name;
  for (const char c : stem.substr(0, 100)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
                       byte == '-' || byte == '_' || byte == '.';
    name += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return {
      .status = 200,
      .content_type = std::string(format.media_type),
      .headers = {{"Content-Disposition", fmt::format("attachment; filename*=UTF-8''{}{}", name, format.extension)}},
      .body = std::move(body)};
}

std::string header_json(const json& document) {
  return document.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace signweave::server
