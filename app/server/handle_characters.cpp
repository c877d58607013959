#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "app/server/answers.h"
#include "app/server/routes.h"
#include "signweave/annotation/document.h"
#include "signweave/core/text.h"
#include "signweave/database/import.h"

namespace signweave::server {

namespace {

/// The server's copy of a linked file: in its media folder, by the file's plain name. Empty if there is none.
std::filesystem::path served_file(const Call& call, const LinkedFile& linked) {
  const std::filesystem::path& folder = call.state.databases.media;
  if (folder.empty()) return {};
  for (const std::string& name : {linked_file_name(linked.relative_url), linked_file_name(linked.url)}) {
    if (name.empty() || name.starts_with('.') || name.find_first_of(std::string_view("/\\\0", 3)) != name.npos)
      continue;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(folder / name, ignored)) return folder / name;
  }
  return {};
}

std::string percent_encoded(const std::string& text) {
  std::string encoded;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') ||
                       byte == '-' || byte == '_' || byte == '.';
    encoded += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return encoded;
}

std::vector<LinkedFile> media_of(Call& call) {
  const Database& database = call.database().database();
  const std::shared_ptr<const Contents> contents = database.contents();
  const RecordingInfo& info = contents->at(call.names.at("recording"));
  call.declare(info.declarations);
  std::vector<LinkedFile> media;
  if (info.document == 0) return media;
  for (LinkedFile& linked : database.document(info.name).linked_files) {
    if (linked.mime_type.starts_with("video/") || linked.mime_type.starts_with("audio/")) {
      media.push_back(std::move(linked));
    }
  }
  return media;
}

}  // namespace

ApiResponse list_characters(Call& call) {
  CharactersAnswer answer;
  for (const calls::SharedCharacter& one : call.state.databases.characters.all()) {
    answer.characters.push_back({.name = one->name,
                                 .file = one->path.filename().string(),
                                 .height = one->character.height,
                                 .face_units = one->character.face_units});
  }
  return json_answer(answer_json<nlohmann::json>(answer));
}

ApiResponse show_character(Call& call) {
  return {.status = 200,
          .content_type = "model/gltf-binary",
          .headers = {},
          .body = {},
          .file = call.state.databases.characters.at(call.names.at("character"))->path};
}

ApiResponse list_media(Call& call) {
  MediaAnswer answer;
  const std::string base =
      fmt::format("/api/databases/{}/recordings/{}/media/", percent_encoded(call.names.at("database")),
                  percent_encoded(call.names.at("recording")));
  for (const LinkedFile& linked : media_of(call)) {
    const bool served = !served_file(call, linked).empty();
    answer.media.push_back({.file = linked_file_name(linked.url.empty() ? linked.relative_url : linked.url),
                            .mime = linked.mime_type,
                            .origin_ms = linked.time_origin.count(),
                            .url = null_unless(served, base + std::to_string(answer.media.size()))});
  }
  return json_answer(answer_json<nlohmann::json>(answer));
}

ApiResponse show_media(Call& call) {
  const std::string& text = call.names.at("number");
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::vector<LinkedFile> media = media_of(call);
  if (error != std::errc{} || end != text.data() + text.size() || number >= media.size()) {
    throw Error(ErrorCode::not_found,
                "no linked medium '" + printable(text) + "' in this recording; see the list of its media");
  }
  const std::filesystem::path file = served_file(call, media[number]);
  if (file.empty()) {
    throw Error(ErrorCode::not_found, "the server does not have '" + linked_file_name(media[number].url) +
                                          "'; serve its folder with --media");
  }
  return {.status = 200, .content_type = media[number].mime_type, .headers = {}, .body = {}, .file = file};
}

}  // namespace signweave::server
