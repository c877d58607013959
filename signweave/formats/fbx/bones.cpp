#include "signweave/formats/fbx/bones.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"

namespace signweave::fbx {
namespace {

bool is_bone_type(const std::string& type) noexcept {
  return type == "LimbNode" || type == "Limb" || type == "Root";
}

/// [node] true for the nodes that are kept: bones and their ancestors.
std::vector<bool> kept_nodes(const std::vector<Node>& nodes, const std::vector<bool>& bones) {
  std::vector<bool> kept(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!bones[i]) continue;
    for (std::size_t at = i; at != kNone && !kept[at]; at = nodes[at].parent) kept[at] = true;
  }
  return kept;
}

/// `root` and the kept nodes below it, parents first, children in the file's order.
std::vector<std::size_t> tree_below(const std::vector<Node>& nodes, const std::vector<bool>& kept, std::size_t root) {
  std::vector<std::size_t> order;
  std::vector<std::size_t> open{root};
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    order.push_back(node);
    for (auto child = nodes[node].children.rbegin(); child != nodes[node].children.rend(); ++child) {
      if (kept[*child]) open.push_back(*child);
    }
  }
  return order;
}

}  // namespace

std::vector<std::size_t> bones_of(const Source& source, const Scene& scene, std::vector<Notice>& notices) {
  const std::vector<Node>& nodes = scene.nodes;
  std::vector<bool> bones(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) bones[i] = is_bone_type(nodes[i].type);
  if (std::find(bones.begin(), bones.end(), true) == bones.end()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) bones[i] = nodes[i].type == "Null";
    if (std::find(bones.begin(), bones.end(), true) == bones.end()) {
      throw Error(
          ErrorCode::bad_input,
          fmt::format("{}: it has no bones (LimbNode, Limb, Root or Null); export it with its skeleton", source.name));
    }
    notices.push_back({source.name, "none of its nodes has the type of a bone, so its Null nodes are used as bones"});
  }
  const std::vector<bool> kept = kept_nodes(nodes, bones);
  std::vector<std::size_t> best;
  std::size_t most = 0;
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!kept[i] || nodes[i].parent != kNone) continue;
    roots.push_back(i);
    std::vector<std::size_t> tree = tree_below(nodes, kept, i);
    const auto count = static_cast<std::size_t>(
        std::count_if(tree.begin(), tree.end(), [&](std::size_t node) { return static_cast<bool>(bones[node]); }));
    if (count <= most) continue;
    most = count;
    best = std::move(tree);
  }
  if (roots.size() > 1) {
    std::string others;
    for (const std::size_t root : roots) {
      if (root == best[0]) continue;
      if (others.size() > 200) {
        others += " …";
        break;
      }
      others += (others.empty() ? "'" : ", '") + printable(nodes[root].name) + "'";
    }
    notices.push_back({source.name, fmt::format("{} trees of bones; the one of '{}' with {} bones is read, without {}",
                                                roots.size(), printable(nodes[best[0]].name), most, others)});
  }
  if (best.size() > 65535) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: {} bones; a skeleton has at most 65,535", source.name, best.size()));
  }
  return best;
}

}  // namespace signweave::fbx
