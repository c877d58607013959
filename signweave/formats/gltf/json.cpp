#include "signweave/formats/gltf/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave::gltf {
namespace {

constexpr std::size_t kMostJsonBytes = std::size_t{256} << 20;
constexpr std::size_t kMostJsonDepth = 24;
constexpr std::size_t kMostJsonParts = std::size_t{1} << 22;  // lists, objects and texts that are kept

/// Which members of the objects in a section are kept.
struct WantedSection {
  std::string_view name;
  std::initializer_list<std::string_view> members;
};

const WantedSection kWantedSections[] = {
    {"asset", {"version", "minVersion", "generator", "extras"}},
    {"scene", {}},
    {"scenes", {"name", "nodes"}},
    {"nodes",
     {"name", "children", "skin", "mesh", "camera", "matrix", "translation", "rotation", "scale", "extensions"}},
    {"skins", {"name", "joints", "inverseBindMatrices"}},
    {"meshes", {"name", "weights", "primitives", "extras"}},
    {"animations", {"name", "channels", "samplers", "extras"}},
    {"accessors", {"bufferView", "byteOffset", "componentType", "normalized", "count", "type", "sparse"}},
    {"bufferViews", {"buffer", "byteOffset", "byteLength", "byteStride", "extensions"}},
    {"buffers", {"uri", "byteLength", "extensions"}},
    {"extensionsRequired", {}},
};

const WantedSection* wanted_section(std::string_view name) {
  const auto* const at =
      std::ranges::find_if(kWantedSections, [&](const WantedSection& section) { return section.name == name; });
  return at == std::end(kWantedSections) ? nullptr : at;
}

/// Builds the wanted parts without recursion, whatever the text contains.
class WantedBuilder {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  WantedBuilder(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  nlohmann::json take() { return std::move(root_); }

  bool null() { return value(nullptr); }
  bool boolean(bool flag) { return value(flag); }
  bool number_integer(number_integer_t number) { return value(number); }
  bool number_unsigned(number_unsigned_t number) { return value(number); }
  bool number_float(number_float_t number, const string_t& /*text*/) { return value(number); }
  bool string(string_t& text) { return skipped_ > 0 || !wanted_ ? value(nullptr) : value(std::move(text)); }
  bool binary(binary_t& /*bytes*/) { return value(nullptr); }

  bool start_object(std::size_t /*count*/) { return open(nlohmann::json::object()); }
  bool start_array(std::size_t /*count*/) { return open(nlohmann::json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(string_t& name) {
    if (skipped_ > 0) return true;
    wanted_ = is_wanted(name);
    key_ = std::move(name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& /*token*/, const nlohmann::json::exception& /*error*/) {
    const std::string_view before = text_.substr(0, std::min(position, text_.size()));
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t begin = before.rfind('\n') + 1;  // npos + 1 is 0
    throw Error(ErrorCode::bad_input,
                fmt::format("{}:{}: not JSON from character {} on; the file is cut off or damaged, export it again",
                            file_, line, before.size() - begin));
  }

 private:
  struct Open {
    nlohmann::json* value;
    std::string key;  ///< in its object
  };

  [[noreturn]] void refuse_json(const char* what) const {
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}", file_, what));
  }

  bool is_wanted(std::string_view name) const {
    const std::size_t depth = open_.size();
    if (depth == 1) return wanted_section(name) != nullptr;
    const std::string& section_name = open_[1].key;
    const WantedSection* const section = wanted_section(section_name);
    if (section == nullptr) return false;
    const std::string& within = open_.back().key;
    if (within == "extras" && section_name == "asset") return depth == 3 && name.starts_with("signweave:");
    if (within == "extras") return depth == 4 && name == (section_name == "meshes" ? "targetNames" : "tracks");
    if (within == "extensions") return name == "EXT_meshopt_compression" || name == "KHR_lights_punctual";
    const std::size_t members_at = section_name == "asset" ? 2 : 3;
    if (depth == members_at) return std::ranges::find(section->members, name) != section->members.end();
    if (section_name == "meshes") return name == "targets";
    return name != "extras" && name != "extensions";
  }

  template <typename Value>
  nlohmann::json* add(Value&& added) {
    if (open_.empty()) {
      root_ = std::forward<Value>(added);
      return &root_;
    }
    nlohmann::json& to = *open_.back().value;
    if (to.is_array()) {
      to.push_back(std::forward<Value>(added));
      return &to.back();
    }
    nlohmann::json& member = to[key_];
    member = std::forward<Value>(added);
    return &member;
  }

  bool here_unwanted() { return !open_.empty() && open_.back().value->is_object() && !wanted_; }

  void count_part() {
    if (++parts_ > kMostJsonParts) refuse_json("the JSON has more than 4 million parts, which no motion can need");
  }

  template <typename Value>
  bool value(Value&& added) {
    if (skipped_ > 0 || here_unwanted()) return true;
    if (open_.empty()) refuse_json("not glTF: the JSON is not an object");
    if constexpr (std::is_same_v<std::decay_t<Value>, std::string>) count_part();
    add(std::forward<Value>(added));
    return true;
  }

  bool open(nlohmann::json empty) {
    if (skipped_ > 0 || here_unwanted()) {
      ++skipped_;
      return true;
    }
    if (open_.empty() && empty.is_array()) refuse_json("not glTF: the JSON is not an object");
    if (open_.size() == kMostJsonDepth) refuse_json("JSON nested deeper than any glTF; export it again");
    count_part();
    const bool in_object = !open_.empty() && open_.back().value->is_object();
    std::string key = in_object ? key_ : std::string();
    nlohmann::json* const made = add(std::move(empty));
    open_.push_back({made, std::move(key)});
    wanted_ = true;
    return true;
  }

  bool close() {
    if (skipped_ > 0) {
      --skipped_;
    } else {
      open_.pop_back();
    }
    wanted_ = true;
    return true;
  }

  const std::string& file_;
  std::string_view text_;
  nlohmann::json root_;
  std::vector<Open> open_;
  std::string key_;
  bool wanted_ = true;       ///< whether the value of the last key is kept
  std::size_t skipped_ = 0;  ///< number of open lists and objects that are being skipped
  std::size_t parts_ = 0;
};

}  // namespace

nlohmann::json parse_wanted(const std::string& file, std::string_view text) {
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);  // some programs pad a GLB's JSON with zeros
  if (text.size() > kMostJsonBytes) {
    throw Error(ErrorCode::unsupported, fmt::format("{}: more than 256 MiB of JSON; export it as .glb", file));
  }
  WantedBuilder builder(file, text);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

}  // namespace signweave::gltf
