#include "signweave/retarget/character.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/retarget/character_extras.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::bad_input, name + ": " + what);
}

/// Pictures are not looked at.
bool no_picture(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

tinygltf::Model load(const std::string& name, std::string_view bytes) {
  if (bytes.size() > 256u << 20) refuse(name, "larger than 256 MiB");
  if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF") refuse(name, "no GLB file");
  tinygltf::Model model;
  std::string error;
  std::string warning;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(no_picture, nullptr);
  const bool done =
      loader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                  static_cast<unsigned>(bytes.size()));
  if (!done) refuse(name, "no glTF that can be read: " + printable(error.substr(0, error.find('\n'))));
  if (!model.extensionsRequired.empty()) {
    throw Error(ErrorCode::unsupported,
                fmt::format("{}: needs the extension {}: give the plain variant of the character", name,
                            printable(model.extensionsRequired.front())));
  }
  return model;
}

/// The joints of the one skin, parents first, in the order of the node tree.
std::shared_ptr<const Skeleton> skeleton_of(const std::string& name, const tinygltf::Model& model) {
  if (model.skins.size() != 1) refuse(name, fmt::format("{} skins: a character has one", model.skins.size()));
  const std::size_t nodes = model.nodes.size();
  std::vector<bool> is_joint(nodes);
  for (const int node : model.skins[0].joints) {
    if (node < 0 || static_cast<std::size_t>(node) >= nodes) refuse(name, "the skin names a node that is not there");
    if (is_joint[static_cast<std::size_t>(node)]) refuse(name, "the skin names a node twice");
    is_joint[static_cast<std::size_t>(node)] = true;
  }
  std::vector<int> parent(nodes, -1);
  for (std::size_t i = 0; i < nodes; ++i) {
    for (const int child : model.nodes[i].children) {
      if (child < 0 || static_cast<std::size_t>(child) >= nodes) refuse(name, "a node's child is not there");
      if (parent[static_cast<std::size_t>(child)] >= 0) refuse(name, "a node has two parents");
      parent[static_cast<std::size_t>(child)] = static_cast<int>(i);
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (is_joint[i] && parent[i] < 0) roots.push_back(static_cast<int>(i));
    if (is_joint[i] && parent[i] >= 0 && !is_joint[static_cast<std::size_t>(parent[i])]) {
      refuse(name, fmt::format("the joint {} lies below a node that is none", printable(model.nodes[i].name)));
    }
  }
  if (roots.size() != 1) refuse(name, fmt::format("{} root joints: a character has one", roots.size()));
  std::vector<Joint> joints;
  const auto add = [&](int node, JointIndex above) {
    const tinygltf::Node& own = model.nodes[static_cast<std::size_t>(node)];
    const auto is = [](const std::vector<double>& values, std::initializer_list<double> wanted) {
      return values.empty() || std::equal(values.begin(), values.end(), wanted.begin(), wanted.end(),
                                          [](double a, double b) { return std::abs(a - b) < 1e-6; });
    };
    if (!own.matrix.empty() || !is(own.rotation, {0, 0, 0, 1}) || !is(own.scale, {1, 1, 1})) {
      refuse(name, fmt::format("the joint {} is turned or scaled at rest", printable(own.name)));
    }
    Vector3f offset = Vector3f::Zero();
    if (!own.translation.empty()) {
      if (own.translation.size() != 3) refuse(name, "a translation has three numbers");
      for (Eigen::Index i = 0; i < 3; ++i) offset[i] = static_cast<float>(own.translation[static_cast<std::size_t>(i)]);
    }
    if (!offset.allFinite() || offset.norm() > 10)
      refuse(name, fmt::format("the joint {} is too far away", printable(own.name)));
    joints.push_back({own.name, above, offset, above == kNoJoint});
    return static_cast<JointIndex>(joints.size()) - 1;
  };
  // Depth first, children in their order. Each node has one parent, so this ends.
  std::vector<std::pair<int, JointIndex>> open = {{roots[0], kNoJoint}};
  while (!open.empty()) {
    const auto [node, above] = open.back();
    open.pop_back();
    const JointIndex joint = add(node, above);
    const std::vector<int>& children = model.nodes[static_cast<std::size_t>(node)].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      if (is_joint[static_cast<std::size_t>(*child)]) open.emplace_back(*child, joint);
    }
  }
  if (joints.size() != model.skins[0].joints.size()) refuse(name, "some joints hang on no root");
  return std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>{});
}

}  // namespace

Character read_character_bytes(const std::string& name, std::string_view bytes) {
  const tinygltf::Model model = load(name, bytes);
  Character character;
  character.skeleton = skeleton_of(name, model);
  const Motion rest(character.skeleton, {30, 1}, 1);
  character.rig = map_rig(rest);
  // Where eyes and top of the head are is told in numbers, and no joint says it.
  if (!model.asset.extras.IsObject() || !model.asset.extras.Has("signweave")) {
    refuse(name, "no asset.extras.signweave: no character of studio/avatar");
  }
  const Extras extras(name, model.asset.extras.Get("signweave"), "asset.extras.signweave");
  read_extras(extras, character);
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
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.good() && !file.eof()) throw Error(ErrorCode::io, path.string() + ": cannot be read");
  return read_character_bytes(path.string(), bytes);
}

}  // namespace signweave
