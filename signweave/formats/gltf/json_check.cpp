#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/formats/gltf/json.h"

namespace signweave::gltf {
namespace {

enum class Kind { index, indices, whole, flag, text, numbers, object };

/// A member of an object.
struct Member {
  const char* name;
  Kind kind;
  const char* of = "";    ///< the list that an index refers to
  std::size_t count = 0;  ///< of numbers
  bool needed = false;
};

constexpr Member needed(Member member) {
  member.needed = true;
  return member;
}

constexpr Member kNodeMembers[] = {{"name", Kind::text},
                                   {"children", Kind::indices, "nodes"},
                                   {"skin", Kind::index, "skins"},
                                   {"mesh", Kind::index, "meshes"},
                                   {"camera", Kind::whole},
                                   {.name = "matrix", .kind = Kind::numbers, .count = 16},
                                   {.name = "translation", .kind = Kind::numbers, .count = 3},
                                   {.name = "rotation", .kind = Kind::numbers, .count = 4},
                                   {.name = "scale", .kind = Kind::numbers, .count = 3}};
constexpr Member kSkinMembers[] = {{"name", Kind::text},
                                   needed({"joints", Kind::indices, "nodes"}),
                                   {"inverseBindMatrices", Kind::index, "accessors"}};
constexpr Member kSceneMembers[] = {{"name", Kind::text}, {"nodes", Kind::indices, "nodes"}};
constexpr Member kMeshMembers[] = {{"name", Kind::text}};
constexpr Member kAnimationMembers[] = {{"name", Kind::text}};
constexpr Member kChannelMembers[] = {needed({"sampler", Kind::index, "samplers"}), needed({"target", Kind::object})};
constexpr Member kTargetMembers[] = {{"node", Kind::index, "nodes"}, needed({"path", Kind::text})};
constexpr Member kSamplerMembers[] = {needed({"input", Kind::index, "accessors"}),
                                      needed({"output", Kind::index, "accessors"}),
                                      {"interpolation", Kind::text}};
constexpr Member kAccessorMembers[] = {{"bufferView", Kind::index, "bufferViews"},
                                       {"byteOffset", Kind::whole},
                                       needed({"componentType", Kind::whole}),
                                       {"normalized", Kind::flag},
                                       needed({"count", Kind::whole}),
                                       needed({"type", Kind::text}),
                                       {"sparse", Kind::object}};
constexpr Member kSparseMembers[] = {needed({"count", Kind::whole}), needed({"indices", Kind::object}),
                                     needed({"values", Kind::object})};
constexpr Member kSparseIndexMembers[] = {needed({"bufferView", Kind::index, "bufferViews"}),
                                          {"byteOffset", Kind::whole},
                                          needed({"componentType", Kind::whole})};
constexpr Member kSparseValueMembers[] = {needed({"bufferView", Kind::index, "bufferViews"}),
                                          {"byteOffset", Kind::whole}};
constexpr Member kViewMembers[] = {needed({"buffer", Kind::index, "buffers"}),
                                   {"byteOffset", Kind::whole},
                                   needed({"byteLength", Kind::whole}),
                                   {"byteStride", Kind::whole}};
constexpr Member kBufferMembers[] = {{"uri", Kind::text}, needed({"byteLength", Kind::whole})};

/// A list of the file: the name of an element in errors, its members, and the maximum count. tinygltf uses some hundred
/// bytes for each, however short it is in the file.
struct Section {
  const char* name;
  const char* element;
  std::span<const Member> members;
  std::size_t most;
};
constexpr std::size_t kMostAccessors = std::size_t{1} << 22;
constexpr std::size_t kManyNodes = std::size_t{1} << 18;
constexpr std::size_t kManyLists = std::size_t{1} << 16;
const Section kSections[] = {{"scenes", "scene", kSceneMembers, kManyLists},
                             {"nodes", "node", kNodeMembers, kManyNodes},
                             {"skins", "skin", kSkinMembers, kManyLists},
                             {"meshes", "mesh", kMeshMembers, kManyLists},
                             {"animations", "animation", kAnimationMembers, kManyLists},
                             {"accessors", "accessor", kAccessorMembers, kMostAccessors},
                             {"bufferViews", "bufferView", kViewMembers, kMostAccessors},
                             {"buffers", "buffer", kBufferMembers, kManyLists}};

class Checker {
 public:
  Checker(const std::string& file, nlohmann::json& root) : file_(file), root_(root) {}

  void check() {
    check_version();
    for (const Section& section : kSections) check_section(section);
    if (const auto scene = root_.find("scene"); scene != root_.end()) index(*scene, root_, "scenes", "scene");
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}", file_, what));
  }

  void check_version() const {
    const auto asset = root_.find("asset");
    if (asset == root_.end() || !asset->is_object()) refuse("not glTF: it has no 'asset' with a version");
    const auto version = asset->find("version");
    if (version == asset->end() || !version->is_string()) refuse("not glTF: its 'asset' has no version");
    const auto& text = version->get_ref<const std::string&>();
    if (text != "2" && !text.starts_with("2.")) {
      refuse(fmt::format("glTF of version {}; only 2 is known, export it as that", printable(text)));
    }
    const auto least = asset->find("minVersion");
    if (least != asset->end() && (!least->is_string() || (*least != "2" && *least != "2.0"))) {
      refuse("it needs a later version of glTF than 2.0; export it as that");
    }
  }

  void check_section(const Section& section) {
    const auto list = root_.find(section.name);
    if (list == root_.end()) return;
    if (!list->is_array()) refuse(fmt::format("'{}' is not a list", section.name));
    if (list->size() > section.most) {
      refuse(fmt::format("it has {} {}, more than any motion needs", list->size(), section.name));
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string place = fmt::format("{} {}", section.element, i);
      nlohmann::json& element = (*list)[i];
      check_members(element, root_, section.members, place);
      if (section.members.data() == kAnimationMembers) check_animation(element, place);
      if (section.members.data() == kAccessorMembers) check_accessor(element, place);
      if (section.members.data() == kViewMembers) check_view(element, place);
    }
  }

  void check_animation(nlohmann::json& animation, const std::string& place) {
    nlohmann::json& samplers = list_of(animation, "samplers", place);
    for (std::size_t i = 0; i < samplers.size(); ++i) {
      check_members(samplers[i], root_, kSamplerMembers, fmt::format("{}, sampler {}", place, i));
    }
    nlohmann::json& channels = list_of(animation, "channels", place);
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const std::string here = fmt::format("{}, channel {}", place, i);
      check_members(channels[i], animation, kChannelMembers, here);
      nlohmann::json& target = channels[i]["target"];
      check_members(target, root_, kTargetMembers, here);
      const std::string path = target["path"].get<std::string>();
      const bool known = path == "translation" || path == "rotation" || path == "scale" || path == "weights";
      if (known && target.contains("node")) continue;
      target["node"] = 0;  // it is kept, so that channels keep their numbers
      target["path"] = "ignored";
    }
  }

  nlohmann::json& list_of(nlohmann::json& object, const char* name, const std::string& place) const {
    nlohmann::json& list = object[name];
    if (list.is_null()) list = nlohmann::json::array();
    if (!list.is_array()) refuse(fmt::format("{}: '{}' is not a list", place, name));
    if (list.size() > kMostAccessors) refuse(fmt::format("{}: {} {}", place, list.size(), name));
    return list;
  }

  void check_accessor(nlohmann::json& accessor, const std::string& place) {
    const std::string& type = accessor["type"].get_ref<const std::string&>();
    static constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    if (std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes)) {
      refuse(fmt::format("{}: no type '{}'", place, printable(type)));
    }
    require_component(accessor["componentType"], place);
    const auto sparse = accessor.find("sparse");
    if (sparse == accessor.end()) return;
    const std::string here = place + ", sparse";
    check_members(*sparse, root_, kSparseMembers, here);
    nlohmann::json& indices = (*sparse)["indices"];
    nlohmann::json& values = (*sparse)["values"];
    check_members(indices, root_, kSparseIndexMembers, here + " indices");
    check_members(values, root_, kSparseValueMembers, here + " values");
    require_component(indices["componentType"], here + " indices");
    for (const nlohmann::json* number : {&(*sparse)["count"], &indices["byteOffset"], &values["byteOffset"]}) {
      if (number->is_null() || number->get<std::uint64_t>() <= std::numeric_limits<std::int32_t>::max()) continue;
      refuse(fmt::format("{}: {} is past every file's end", here, number->get<std::uint64_t>()));
    }
    for (nlohmann::json* const part : {&indices, &values}) {
      if ((*part)["byteOffset"].is_null()) part->erase("byteOffset");
    }
  }

  void require_component(const nlohmann::json& component, const std::string& place) const {
    const auto number = component.get<std::uint64_t>();
    const bool known = (number >= 5120 && number <= 5123) || number == 5125 || number == 5126;
    if (!known) refuse(fmt::format("{}: no componentType {}", place, number));
  }

  void check_view(nlohmann::json& view, const std::string& place) const {
    const auto stride = view.find("byteStride");
    if (stride == view.end()) return;
    const auto bytes = stride->get<std::uint64_t>();
    if (bytes == 0) {
      view.erase("byteStride");  // some write 0 for "none"
    } else if (bytes < 4 || bytes > 252 || bytes % 4 != 0) {
      refuse(fmt::format("{}: byteStride is {}; it must be a multiple of 4 of at most 252", place, bytes));
    }
  }

  void check_members(nlohmann::json& object, const nlohmann::json& lists, std::span<const Member> members,
                     const std::string& place) {
    if (!object.is_object()) refuse(fmt::format("{}: no object", place));
    for (const Member& member : members) {
      const auto at = object.find(member.name);
      if (at != object.end() && !at->is_null()) {
        check_member(*at, lists, member, place);
        continue;
      }
      if (member.needed) refuse(fmt::format("{}: it has no '{}'", place, member.name));
      if (at != object.end()) object.erase(at);
    }
  }

  void check_member(nlohmann::json& value, const nlohmann::json& lists, const Member& member,
                    const std::string& place) {
    const auto wrong = [&](const char* what) { refuse(fmt::format("{}: '{}' is {}", place, member.name, what)); };
    switch (member.kind) {
      case Kind::index:
        return index(value, lists, member.of, fmt::format("{}: '{}'", place, member.name));
      case Kind::indices: {
        if (!value.is_array()) wrong("no list");
        const std::string here = fmt::format("{}: '{}'", place, member.name);
        for (nlohmann::json& one : value) index(one, lists, member.of, here);
        return;
      }
      case Kind::whole:
        if (!made_whole(value)) wrong("not a whole number of 0 or more");
        return;
      case Kind::flag:
        if (!value.is_boolean()) wrong("neither true nor false");
        return;
      case Kind::text:
        if (!value.is_string()) wrong("no text");
        return;
      case Kind::object:
        if (!value.is_object()) wrong("no object");
        return;
      case Kind::numbers:
        if (!value.is_array() || value.size() != member.count) {
          refuse(fmt::format("{}: '{}' is not a list of {} numbers", place, member.name, member.count));
        }
        for (const nlohmann::json& one : value) {
          if (!one.is_number()) wrong("not a list of numbers");
        }
        return;
    }
  }

  /// JSON distinguishes 1.0 from 1 only by its spelling, and some programs write one for the other.
  static bool made_whole(nlohmann::json& value) {
    if (value.is_number_float()) {
      const double number = value.get<double>();
      if (!(number >= 0 && number <= 9e15) || number != std::floor(number)) return false;
      value = static_cast<std::uint64_t>(number);
    }
    return value.is_number_unsigned() && value.get<std::uint64_t>() <= std::uint64_t{9'000'000'000'000'000};
  }

  void index(nlohmann::json& value, const nlohmann::json& lists, const char* of, const std::string& what) const {
    const auto list = lists.find(of);
    const std::size_t count = list == lists.end() || !list->is_array() ? 0 : list->size();
    if (!made_whole(value)) refuse(fmt::format("{} is not the number of one of its {} {}", what, count, of));
    const auto number = value.get<std::uint64_t>();
    if (number >= count) refuse(fmt::format("{} is {}, but there are {} {}", what, number, count, of));
  }

  const std::string& file_;
  nlohmann::json& root_;
};

}  // namespace

void check_against_gltf(const std::string& file, nlohmann::json& json) {
  Checker(file, json).check();
}

}  // namespace signweave::gltf
