#include "signweave/retarget/character.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/retarget/character_extras.h"
#include "signweave/retarget/json_value.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::bad_input, name + ": " + what);
}

constexpr std::uintmax_t kMostBytes = 256u << 20;

/// Extensions that a file may require in addition to core glTF: they only change meshes and images, which are ignored.
constexpr std::array<std::string_view, 3> kKnownExtensions = {"EXT_meshopt_compression", "EXT_texture_webp",
                                                              "KHR_mesh_quantization"};

void check_extensions(const std::string& name, const JsonValue& file) {
  if (!file.has("extensionsRequired")) return;
  const JsonValue needed = file["extensionsRequired"];
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const std::string extension = needed[i].text();
    if (std::find(kKnownExtensions.begin(), kKnownExtensions.end(), extension) == kKnownExtensions.end()) {
      throw Error(ErrorCode::unsupported, fmt::format("{}: needs the extension {}", name, printable(extension)));
    }
  }
}

/// A node of the file.
struct Node {
  std::string name;
  std::size_t parent = kNone;
  std::vector<std::size_t> children;
  bool is_joint = false;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

/// Throws if a node has two parents, so the nodes below any root form a tree.
std::vector<Node> nodes_of(const JsonValue& file) {
  const JsonValue list = file["nodes"];
  std::vector<Node> nodes(list.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (list[i].has("name")) nodes[i].name = list[i]["name"].text();
    if (!list[i].has("children")) continue;
    const JsonValue children = list[i]["children"];
    for (std::size_t k = 0; k < children.size(); ++k) {
      const std::size_t child = children[k].index(nodes.size());
      if (nodes[child].parent != Node::kNone) children[k].fail("a node has two parents");
      nodes[child].parent = i;
      nodes[i].children.push_back(child);
    }
  }
  if (file["skins"].size() != 1) file["skins"].fail(fmt::format("{} skins: a character has one", file["skins"].size()));
  const JsonValue joints = file["skins"][0]["joints"];
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Node& node = nodes[joints[i].index(nodes.size())];
    if (node.is_joint) joints[i].fail("the joint is listed twice");
    node.is_joint = true;
  }
  return nodes;
}

/// Returns the offset of a joint from its parent, metres. Throws if it is rotated or scaled at rest.
Vector3f offset_of(const JsonValue& node, const std::string& name) {
  const auto is = [&](const char* key, std::initializer_list<float> wanted) {
    if (!node.has(key)) return true;
    const JsonValue values = node[key];
    if (values.size() != wanted.size()) return false;
    std::size_t i = 0;
    for (const float value : wanted) {
      if (std::abs(values[i++].number(-1e6f, 1e6f) - value) > 1e-6f) return false;
    }
    return true;
  };
  if (node.has("matrix") || !is("rotation", {0, 0, 0, 1}) || !is("scale", {1, 1, 1})) {
    node.fail(fmt::format("the joint {} is rotated or scaled at rest", printable(name)));
  }
  return node.has("translation") ? node["translation"].vector(10) : Vector3f(Vector3f::Zero());
}

/// Returns the joints of the only skin, parents first, in the order of the node tree.
std::shared_ptr<const Skeleton> skeleton_of(const JsonValue& file) {
  const std::vector<Node> nodes = nodes_of(file);
  std::vector<std::size_t> roots;
  std::size_t count = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].is_joint) continue;
    ++count;
    if (nodes[i].parent == Node::kNone) {
      roots.push_back(i);
    } else if (!nodes[nodes[i].parent].is_joint) {
      file.fail(fmt::format("the parent of the joint {} is not a joint", printable(nodes[i].name)));
    }
  }
  if (roots.size() != 1) file.fail(fmt::format("{} root joints: a character has one", roots.size()));
  const JsonValue list = file["nodes"];
  std::vector<Joint> joints;
  // Depth first, children in order. Each node has one parent, so this terminates.
  struct Open {
    std::size_t node;
    JointIndex above;
  };
  std::vector<Open> open = {{roots[0], kNoJoint}};
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    const Node& node = nodes[next.node];
    joints.push_back({node.name, next.above, offset_of(list[next.node], node.name), next.above == kNoJoint});
    const auto joint = static_cast<JointIndex>(joints.size()) - 1;
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      if (nodes[*child].is_joint) open.push_back({*child, joint});
    }
  }
  if (joints.size() != count) file.fail("some joints are not below the root");
  return std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>{});
}

}  // namespace

Character read_character_bytes(const std::string& name, std::string_view bytes) {
  const nlohmann::json json = glb_json(name, bytes);
  const JsonValue file(name, json);
  check_extensions(name, file);
  Character character;
  character.skeleton = skeleton_of(file);
  const Motion rest(character.skeleton, {30, 1}, 1);
  character.rig = map_rig(rest);
  // The positions of the eyes and the top of the head are given as numbers, because no joint marks them.
  const JsonValue asset = file["asset"];
  if (!asset.has("extras") || !asset["extras"].has("signweave")) {
    refuse(name, "no asset.extras.signweave: not a character of studio/avatar");
  }
  read_extras(asset["extras"]["signweave"], character);
  if (!character.rig.has(Part::head)) refuse(name, "no head among the joints");
  const ModelPose pose = to_model_space(*character.skeleton, rest.pose(0));
  const JointIndex head = character.rig[Part::head].joint;
  character.rig[Part::head_top] = {
      .joint = head,
      .offset = Vector3f(0, character.height - pose.positions[static_cast<std::size_t>(head)].y(), 0),
      .evidence = Evidence::file,
      .confidence = 1};
  character.body = signer_body(rest, character.rig);
  if (!character.body) refuse(name, "no shoulders among the joints");
  return character;
}

Character read_character(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw Error(ErrorCode::not_found, path.string() + ": no such file");
  if (std::filesystem::file_size(path, error) > kMostBytes || error) refuse(path.string(), "larger than 256 MiB");
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.good() && !file.eof()) throw Error(ErrorCode::io, path.string() + ": cannot be read");
  return read_character_bytes(path.string(), bytes);
}

}  // namespace signweave
