#include "app/server/upload_files.h"

#include <fmt/format.h>

#include "app/server/uploads.h"
#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::server {

void resolve(std::string& file, const std::filesystem::path& folder, std::string_view field) {
  if (file.empty()) return;
  Uploads::require_plain(file);
  const std::filesystem::path path = folder / file;
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(ErrorCode::not_found, fmt::format("{}: the upload has no file '{}'; put it first", field, file));
  }
  file = path.string();
}

std::string without_folder(std::string text, const std::string& folder) {
  // From the start each time: joining what is left on both sides may form the folder's name again.
  for (std::size_t at = text.find(folder); at != text.npos; at = text.find(folder)) text.erase(at, folder.size());
  return text;
}

nlohmann::json without_folder(nlohmann::json value, const std::string& folder) {
  if (value.is_string()) return without_folder(value.get<std::string>(), folder);
  if (value.is_structured()) {
    for (nlohmann::json& one : value) one = without_folder(std::move(one), folder);
  }
  return value;
}

}  // namespace signweave::server
