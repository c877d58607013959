#include "signweave/formats/gltf/character.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "signweave/core/error.h"
#include "signweave/formats/gltf/document.h"
#include "signweave/formats/gltf/keys.h"

namespace signweave::gltf {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t kMagic = 0x46546C67;       // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;   // "JSON"
constexpr std::uint32_t kBytesChunk = 0x004E4942;  // "BIN"
constexpr int kFloat = 5126;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

void append(std::string& out, std::uint32_t value) {
  out.append(reinterpret_cast<const char*>(&value), 4);
}

/// The two chunks of a GLB, borrowed.
struct Chunks {
  std::string_view json;
  std::string_view bytes;
};

Chunks chunks_of(std::string_view file) {
  const auto broken = [](const char* what) { throw Error(ErrorCode::bad_input, fmt::format("not a GLB: {}", what)); };
  if (file.size() < 20 || number_at(file, 0) != kMagic) broken("it does not begin with glTF");
  if (number_at(file, 4) != 2) broken("only version 2 is known");
  Chunks chunks;
  for (std::size_t at = 12; file.size() - at >= 8;) {
    const std::size_t size = number_at(file, at);
    const std::uint32_t kind = number_at(file, at + 4);
    if (size > file.size() - at - 8) broken("it ends within a chunk");
    const std::string_view chunk = file.substr(at + 8, size);
    if (kind == kJsonChunk && chunks.json.empty()) chunks.json = chunk;
    if (kind == kBytesChunk && chunks.bytes.empty()) chunks.bytes = chunk;
    at += 8 + size;
  }
  if (chunks.json.empty() || chunks.bytes.empty()) broken("it lacks one of its two chunks");
  return chunks;
}

/// Appends keys to the contents of a file.
class Adder {
 public:
  Adder(Json& document, std::string bytes) : document_(document), bytes_(std::move(bytes)) {}

  /// Appends rows of `width` floats each; returns the accessor's number.
  std::size_t add(const float* values, std::size_t rows, std::size_t width, const char* type, bool with_bounds) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t size = rows * width * sizeof(float);
    document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}});
    if (size > kMost || bytes_.size() > kMost - size) {
      throw Error(ErrorCode::unsupported,
                  "character and motion are larger than the 4 GiB that a .glb file may have; write a part of it");
    }
    bytes_.append(reinterpret_cast<const char*>(values), size);
    Json accessor = {{"bufferView", document_["bufferViews"].size() - 1},
                     {"componentType", kFloat},
                     {"count", rows * (std::strcmp(type, "SCALAR") == 0 ? width : 1)},
                     {"type", type}};
    if (with_bounds) {
      const auto [least, most] = std::minmax_element(values, values + rows * width);
      accessor["min"] = {*least};
      accessor["max"] = {*most};
    }
    document_["accessors"].push_back(std::move(accessor));
    return document_["accessors"].size() - 1;
  }

  void channel(std::size_t node, const char* path, std::size_t times, std::size_t keys) {
    samplers_.push_back({{"input", times}, {"output", keys}, {"interpolation", "LINEAR"}});
    channels_.push_back({{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  std::string finish(const std::string& name) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    if (!channels_.empty()) {  // glTF has no empty animation
      document_["animations"] = Json::array({{{"name", name}, {"channels", channels_}, {"samplers", samplers_}}});
    }
    document_["buffers"][0]["byteLength"] = bytes_.size();
    return std::move(bytes_);
  }

 private:
  static constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - (std::size_t{64} << 20);
  Json& document_;
  std::string bytes_;
  Json channels_ = Json::array();
  Json samplers_ = Json::array();
};

void add_joints(Adder& adder, const Motion& motion, const std::map<std::string, std::size_t>& nodes,
                std::size_t times) {
  const Skeleton& skeleton = motion.skeleton();
  const auto node_of = [&](JointIndex joint) { return nodes.find(utf8(skeleton.joint(joint).name)); };
  std::vector<Eigen::Vector4f> turns;
  for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
    const auto node = node_of(static_cast<JointIndex>(joint));
    if (node == nodes.end()) continue;
    const bool moves = rotation_keys(motion, joint, turns);
    if (!moves && turns[0].head<3>().isZero(0)) continue;
    adder.channel(node->second, "rotation", times, adder.add(turns[0].data(), turns.size(), 4, "VEC4", false));
  }
  std::vector<Eigen::Vector3f> places;
  for (std::size_t i = 0; i < skeleton.translation_count(); ++i) {
    const auto node = node_of(skeleton.translated_joints()[i]);
    if (node == nodes.end()) continue;
    translation_keys(motion, i, places);
    adder.channel(node->second, "translation", times, adder.add(places[0].data(), places.size(), 3, "VEC3", false));
  }
}

/// Adds the morph weights of every mesh that has a target with a track's name.
void add_weights(Adder& adder, const Json& document, const Motion& motion, std::size_t times) {
  const Json nodes = document.value("nodes", Json::array());
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (!nodes[node].contains("mesh")) continue;
    const Json& mesh = document.at("meshes").at(nodes[node].at("mesh").get<std::size_t>());
    if (!mesh.contains("extras") || !mesh["extras"].contains("targetNames")) continue;
    const auto names = mesh["extras"]["targetNames"].get<std::vector<std::string>>();
    std::vector<float> weights(static_cast<std::size_t>(motion.frame_count()) * names.size());
    bool any = false;
    for (std::size_t target = 0; target < names.size(); ++target) {
      const auto track =
          std::ranges::find_if(motion.tracks(), [&](const ScalarTrack& one) { return one.name == names[target]; });
      if (track == motion.tracks().end()) continue;
      any = true;
      for (std::size_t frame = 0; frame < track->values.size(); ++frame) {
        weights[frame * names.size() + target] = track->values[frame];
      }
    }
    if (!any) continue;
    const auto frames = static_cast<std::size_t>(motion.frame_count());
    adder.channel(node, "weights", times, adder.add(weights.data(), frames, names.size(), "SCALAR", false));
  }
}

std::string written(const Json& document, const std::string& bytes) {
  std::string json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out;
  out.reserve(28 + json.size() + bytes.size());
  append(out, kMagic);
  append(out, 2);
  append(out, static_cast<std::uint32_t>(28 + json.size() + bytes.size()));
  append(out, static_cast<std::uint32_t>(json.size()));
  append(out, kJsonChunk);
  out += json;
  append(out, static_cast<std::uint32_t>(bytes.size()));
  append(out, kBytesChunk);
  out += bytes;
  return out;
}

std::string made(std::string_view character, const Motion& motion, const CharacterOptions& options) {
  const Chunks chunks = chunks_of(character);
  Json document = Json::parse(chunks.json);
  for (const Json& name : document.value("extensionsRequired", Json::array())) {
    throw Error(ErrorCode::unsupported,
                fmt::format("the file is packed ({}), which most programs cannot open; make a plain one with "
                            "studio/avatar/build",
                            name.get<std::string>()));
  }
  if (document.at("buffers").size() != 1) throw Error(ErrorCode::bad_input, "not a GLB with one buffer");
  std::map<std::string, std::size_t> nodes;
  for (std::size_t i = 0; i < document.at("nodes").size(); ++i) {
    nodes.emplace(document["nodes"][i].value("name", std::string()), i);
  }
  for (const auto& [name, value] : options.declarations) document["asset"]["extras"][utf8(name)] = utf8(value);
  Adder adder(document, std::string(chunks.bytes));
  const std::vector<float> times = key_times(motion.rate(), motion.frame_count());
  const std::size_t key_frames = adder.add(times.data(), times.size(), 1, "SCALAR", true);
  add_joints(adder, motion, nodes, key_frames);
  add_weights(adder, document, motion, key_frames);
  const std::string bytes = adder.finish(utf8(options.name));
  return written(document, bytes);
}

}  // namespace

std::string on_character(const std::string& file, std::string_view character, const Motion& motion,
                         const CharacterOptions& options) {
  if (motion.frame_count() < 1)
    throw Error(ErrorCode::bad_input, "a motion without frames has nothing to show in glTF");
  require_finite(motion);
  try {
    return made(character, motion, options);
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: not as glTF specifies: {}", file, error.what()));
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", file, error.what()), error.remedies());
  }
}

}  // namespace signweave::gltf
