#include <algorithm>
#include <filesystem>

#include "app/server/answers.h"
#include "app/server/routes.h"
#include "signweave/core/text.h"

namespace signweave::server {

void require_render(const Call& call) {
  const std::optional<Render>& render = call.state.databases.render;
  if (!render || render->id != call.names.at("render")) {
    throw Error(ErrorCode::not_found, "no rendering with this name is in progress");
  }
  const std::string& file = call.names.at("file");
  const bool plain =
      !file.empty() && file.size() <= 40 && !file.starts_with('.') &&
      std::ranges::all_of(file, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.'; });
  if (!plain) throw Error(ErrorCode::bad_input, "'" + printable(file) + "' is not a valid name of a rendered file");
}

ApiResponse put_rendered(Call& call) {
  require_render(call);
  const std::filesystem::path to = call.state.databases.render->folder / call.names.at("file");
  std::error_code error;
  if (call.request.body_file.empty()) throw Error(ErrorCode::bad_input, "the request has no body");
  std::filesystem::rename(call.request.body_file, to, error);
  if (error) throw Error(ErrorCode::io, "the rendered file could not be stored: " + error.message());
  const RenderedFile rendered{.file = to.filename().string(), .bytes = std::filesystem::file_size(to, error)};
  return json_answer(answer_json<nlohmann::json>(rendered));
}

}  // namespace signweave::server
