#include "signweave/formats/gltf/content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/gltf/json.h"
#include "signweave/formats/gltf/uri.h"

namespace signweave::gltf {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_content(const std::string& file, const std::string& what,
                                 ErrorCode code = ErrorCode::bad_input) {
  throw Error(code, fmt::format("{}: {}", file, what));
}

/// The JSON of a file and, for a GLB, the bytes of its first buffer. Borrowed.
struct GlbParts {
  std::string_view json;
  std::optional<std::string_view> bytes;
};

std::uint32_t glb_number(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

GlbParts glb_parts(const std::string& file, std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return {bytes, std::nullopt};
  if (bytes.size() < 20) refuse_content(file, "it ends within the head of a GLB; copy or export it again");
  if (const std::uint32_t version = glb_number(bytes, 4); version != 2) {
    refuse_content(file, fmt::format("GLB of version {}; only 2 is known, export it as that", version));
  }
  const std::uint32_t length = glb_number(bytes, 8);
  if (length > bytes.size()) {
    refuse_content(file, fmt::format("it says that it has {} bytes but has {}; it is cut off, copy or export it again",
                                     length, bytes.size()));
  }
  bytes = bytes.substr(0, std::max<std::size_t>(length, 12));
  GlbParts parts;
  bool first = true;
  for (std::size_t at = 12; bytes.size() - at >= 8; first = false) {
    const std::size_t size = glb_number(bytes, at);
    const std::uint32_t kind = glb_number(bytes, at + 4);
    at += 8;
    if (size > bytes.size() - at) refuse_content(file, "a chunk of the GLB is longer than the file");
    if (first && kind != 0x4E4F534A) refuse_content(file, "the first chunk of the GLB is not JSON");
    if (first) parts.json = bytes.substr(at, size);
    if (!first && kind == 0x004E4942 && !parts.bytes) parts.bytes = bytes.substr(at, size);
    at += size;
    at += std::min<std::size_t>((4 - size % 4) % 4, bytes.size() - at);  // some exporters do not pad chunks
  }
  if (first) refuse_content(file, "the GLB has no chunk");
  return parts;
}

/// Extensions that may be required, because they change the appearance and not the motion. Draco compresses only
/// meshes.
bool is_harmless(const std::string& extension) {
  static constexpr std::array kNames = {
      "EXT_meshopt_compression", "KHR_mesh_quantization", "KHR_draco_mesh_compression",
      "KHR_lights_punctual",     "KHR_xmp_json_ld",       "MSFT_texture_dds"};
  static constexpr std::array kBegins = {"KHR_materials_", "KHR_texture_", "EXT_texture_"};
  return std::ranges::find(kNames, extension) != kNames.end() ||
         std::ranges::any_of(kBegins, [&](const char* begin) { return extension.starts_with(begin); });
}

void require_known_extensions(const std::string& file, const nlohmann::json& json) {
  const auto names = json.find("extensionsRequired");
  if (names == json.end()) return;
  if (!names->is_array()) refuse_content(file, "'extensionsRequired' is not a list");
  for (const nlohmann::json& name : *names) {
    if (!name.is_string()) refuse_content(file, "'extensionsRequired' contains a value that is not text");
    const auto& text = name.get_ref<const std::string&>();
    if (is_harmless(text)) continue;
    refuse_content(file,
                   fmt::format("it needs the extension {}, which is not known; export it without", printable(text)),
                   ErrorCode::unsupported);
  }
}

/// An object's member, or null.
const nlohmann::json& member_of(const nlohmann::json& object, const char* name) {
  static const nlohmann::json kNull;
  if (!object.is_object()) return kNull;
  const auto at = object.find(name);
  return at == object.end() ? kNull : *at;
}

std::vector<MorphMesh> morph_meshes(const nlohmann::json& json) {
  std::vector<MorphMesh> meshes;
  for (const nlohmann::json& mesh : member_of(json, "meshes")) {
    MorphMesh& made = meshes.emplace_back();
    made.name = mesh.value("name", fmt::format("mesh {}", meshes.size() - 1));
    const nlohmann::json& primitives = member_of(mesh, "primitives");
    if (primitives.is_array() && !primitives.empty()) {
      const nlohmann::json& targets = member_of(primitives[0], "targets");
      if (targets.is_array()) made.targets = targets.size();
    }
    if (const nlohmann::json& weights = member_of(mesh, "weights"); made.targets == 0 && weights.is_array()) {
      made.targets = weights.size();
    }
    const nlohmann::json& names = member_of(member_of(mesh, "extras"), "targetNames");
    if (!names.is_array()) continue;
    for (const nlohmann::json& name : names) {
      if (name.is_string()) made.target_names.push_back(name.get<std::string>());
    }
    if (made.target_names.size() != made.targets) made.target_names.clear();
  }
  return meshes;
}

std::vector<std::optional<PackedView>> packed_views(const std::string& file, const nlohmann::json& json) {
  std::vector<std::optional<PackedView>> views;
  const std::size_t buffers = member_of(json, "buffers").size();
  for (const nlohmann::json& view : member_of(json, "bufferViews")) {
    views.emplace_back();
    const nlohmann::json& packing = member_of(member_of(view, "extensions"), "EXT_meshopt_compression");
    if (packing.is_null()) continue;
    const auto refuse = [&](const char* what) {
      refuse_content(file, fmt::format("bufferView {}, EXT_meshopt_compression: {}", views.size() - 1, what));
    };
    const auto number = [&](const char* name, bool needed) -> std::uint64_t {
      const nlohmann::json& value = member_of(packing, name);
      if (value.is_null() && !needed) return 0;
      if (!value.is_number_unsigned()) refuse(fmt::format("'{}' is not a whole number", name).c_str());
      return value.get<std::uint64_t>();
    };
    const auto text = [&](const char* name, const char* otherwise) {
      const nlohmann::json& value = member_of(packing, name);
      return value.is_string() ? value.get<std::string>() : std::string(otherwise);
    };
    PackedView made{.buffer = number("buffer", true),
                    .offset = number("byteOffset", false),
                    .length = number("byteLength", true),
                    .stride = number("byteStride", true),
                    .count = number("count", true),
                    .mode = text("mode", ""),
                    .filter = text("filter", "NONE")};
    if (made.buffer >= buffers) refuse("there is no such buffer");
    views.back() = std::move(made);
  }
  return views;
}

/// Parses with everything removed that tinygltf would follow, decode or copy.
tinygltf::Model model_of(const std::string& file, nlohmann::json json) {
  for (const char* const name : {"buffers", "meshes"}) json.erase(name);
  if (const auto views = json.find("bufferViews"); views != json.end()) {
    for (nlohmann::json& view : *views) view.erase("extensions");
  }
  if (const auto nodes = json.find("nodes"); nodes != json.end()) {
    for (nlohmann::json& node : *nodes) node.erase("extensions");
  }
  if (const auto animations = json.find("animations"); animations != json.end()) {
    for (nlohmann::json& animation : *animations) animation.erase("extras");
  }
  const std::string text = json.dump();
  json = nullptr;
  tinygltf::Model model;
  std::string error;
  std::string warning;
  if (!tinygltf::TinyGLTF().LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE)) {
    refuse_content(file, "not a complete glTF file: " + printable(error));
  }
  return model;
}

std::string outside_bytes(const std::string& place, const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    refuse_content(place, path.string() + " is not a file");
  }
  try {
    return read_file(path);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", place, error.what()), error.remedies());
  }
}

/// Fills in the bytes of every buffer.
void add_buffers(Content& content, nlohmann::json& json, const GlbParts& parts, const fs::path& folder) {
  const auto list = json.find("buffers");
  if (list == json.end()) return;
  std::map<fs::path, std::string_view> outside;  // each file is read once, however many buffers refer to it
  for (std::size_t i = 0; i < list->size(); ++i) {
    nlohmann::json& buffer = (*list)[i];
    const std::string place = fmt::format("{}: buffer {}", content.name, i);
    const auto length = buffer["byteLength"].get<std::uint64_t>();
    std::string_view bytes;
    if (const auto uri = buffer.find("uri"); uri != buffer.end()) {
      const std::string text = std::move(uri->get_ref<std::string&>());
      if (is_data_uri(text)) {
        content.owned.push_back(data_of_uri(place, text));
        bytes = content.owned.back();
      } else {
        const fs::path path = path_of_uri(place, text, folder);
        const auto known = outside.find(path);
        if (known == outside.end()) {
          content.owned.push_back(outside_bytes(place, path));
          content.byte_count += content.owned.back().size();
        }
        bytes = known == outside.end() ? outside.emplace(path, content.owned.back()).first->second : known->second;
      }
    } else if (i == 0 && parts.bytes) {
      bytes = *parts.bytes;
    } else {
      // Its views are packed and are really stored elsewhere; one that is not is refused when it is read.
      content.buffers.emplace_back();
      continue;
    }
    if (bytes.size() < length) {
      refuse_content(place, fmt::format("it says {} bytes but has {}; it is cut off, copy or export it again", length,
                                        bytes.size()));
    }
    content.buffers.push_back(bytes.substr(0, length));
  }
}

}  // namespace

Content content_of(const std::string& name, std::string_view bytes, const fs::path& folder) {
  if (bytes.empty()) refuse_content(name, "an empty file");
  const GlbParts parts = glb_parts(name, bytes);
  nlohmann::json json = parse_wanted(name, parts.json);
  check_against_gltf(name, json);
  require_known_extensions(name, json);
  Content content;
  content.name = name;
  content.byte_count = bytes.size();
  add_buffers(content, json, parts, folder);
  content.packed = packed_views(name, json);
  content.meshes = morph_meshes(json);
  for (const nlohmann::json& node : member_of(json, "nodes")) {
    content.is_light.push_back(!member_of(member_of(node, "extensions"), "KHR_lights_punctual").is_null());
  }
  for (const auto& [key, value] : member_of(member_of(json, "asset"), "extras").items()) {
    if (value.is_string()) content.declarations.emplace_back(printable(key), printable(value.get<std::string>()));
  }
  if (const auto animations = json.find("animations"); animations != json.end()) {
    for (nlohmann::json& animation : *animations) {
      const auto extras = animation.find("extras");
      content.tracks.push_back(extras == animation.end() || !extras->is_object() ? nlohmann::json()
                                                                                 : std::move((*extras)["tracks"]));
    }
  }
  content.model = model_of(name, std::move(json));
  return content;
}

std::vector<fs::path> outside_buffers(const std::string& name, std::string_view bytes, const fs::path& folder) {
  std::vector<fs::path> paths;
  const nlohmann::json json = parse_wanted(name, glb_parts(name, bytes).json);
  const nlohmann::json& buffers = member_of(json, "buffers");
  if (!buffers.is_array()) return paths;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const nlohmann::json& uri = member_of(buffers[i], "uri");
    if (!uri.is_string() || is_data_uri(uri.get_ref<const std::string&>())) continue;
    paths.push_back(path_of_uri(fmt::format("{}: buffer {}", name, i), uri.get_ref<const std::string&>(), folder));
  }
  return paths;
}

}  // namespace signweave::gltf
