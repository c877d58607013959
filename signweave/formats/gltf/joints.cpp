#include "signweave/formats/gltf/joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "signweave/core/text.h"

namespace signweave::gltf {
namespace {

constexpr std::size_t kMostStoredJoints = 65'535;
constexpr float kStill = 1e-6f;

/// Chooses the joints of a file.
class JointChoice {
 public:
  JointChoice(const Content& content, const NodeForest& forest, const Take& take, std::vector<Notice>& notices)
      : content_(content), forest_(forest), take_(take), notices_(notices), top_(forest.parent.size()) {
    for (const std::size_t node : forest_.order) {
      const std::size_t parent = forest_.parent[node];
      top_[node] = parent == kNoNode ? node : top_[parent];
    }
  }

  std::vector<std::size_t> choose() {
    seeds_.assign(top_.size(), false);
    const bool skinned = seed_skins();
    if (!skinned && !seed_moved()) seed_meshes();
    const std::size_t tree = best_tree(skinned ? "joints" : "moved nodes");
    std::vector<bool> kept(top_.size(), false);
    const std::size_t root = common_node(tree);
    for (const std::size_t node : forest_.order) {
      if (!seeds_[node] || top_[node] != tree) continue;
      for (std::size_t at = node; !kept[at]; at = forest_.parent[at]) {
        kept[at] = true;
        if (at == root) break;
      }
    }
    if (!seeds_[root]) {
      note(fmt::format("its topmost joints are siblings; {}, above them, became the root", node_text(content_, root)));
    }
    if (skinned) {
      keep_moved_above(root, kept);
      report_moved_outside(kept);
    } else {
      keep_all_below(kept);
    }
    std::vector<std::size_t> joints;
    std::ranges::copy_if(forest_.order, std::back_inserter(joints), [&](std::size_t node) { return kept[node]; });
    if (joints.size() > kMostStoredJoints) {
      throw Error(ErrorCode::unsupported, fmt::format("{}: {} joints; at most {} can be stored", content_.name,
                                                      joints.size(), kMostStoredJoints));
    }
    // Uses the file's own order if it has parents first, so that what we wrote is read back unchanged.
    const bool ordered =
        std::ranges::all_of(joints, [&](std::size_t node) { return node == joints[0] || forest_.parent[node] < node; });
    if (ordered) std::ranges::sort(joints);
    return joints;
  }

 private:
  void note(std::string text) { notices_.push_back({content_.name, std::move(text)}); }

  bool seed_skins() {
    bool any = false;
    for (const tinygltf::Skin& skin : content_.model.skins) {
      for (const int joint : skin.joints) {
        seeds_[static_cast<std::size_t>(joint)] = true;
        any = true;
      }
    }
    return any;
  }

  bool is_camera_or_light(std::size_t node) const {
    return content_.model.nodes[node].camera >= 0 || content_.is_light[node];
  }

  bool seed_moved() {
    bool any = false;
    for (std::size_t node = 0; node < seeds_.size(); ++node) {
      seeds_[node] = take_.nodes[node].place_or_turn_or_scale() && !is_camera_or_light(node);
      any = any || seeds_[node];
    }
    return any;
  }

  /// A face alone: the node of its mesh replaces a skeleton.
  void seed_meshes() {
    bool any = false;
    for (std::size_t node = 0; node < seeds_.size(); ++node) {
      seeds_[node] = take_.nodes[node].weights != nullptr;
      any = any || seeds_[node];
    }
    if (any) return;
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: the take '{}' moves no joint; choose another or "
                            "export it with keys",
                            content_.name, printable(take_.name)),
                {{"take", ""}});
  }

  bool is_moved(std::size_t node) const {
    const NodeCurves& curves = take_.nodes[node];
    return (curves.translation && changes(*curves.translation, kStill)) ||
           (curves.rotation && changes(*curves.rotation, kStill)) || (curves.scale && changes(*curves.scale, kStill));
  }

  std::vector<std::size_t> default_tops() const {
    const auto& scenes = content_.model.scenes;
    if (scenes.empty()) return {};
    const int wanted = std::clamp(content_.model.defaultScene, 0, static_cast<int>(scenes.size()) - 1);
    const std::vector<int>& nodes = scenes[static_cast<std::size_t>(wanted)].nodes;
    return {nodes.begin(), nodes.end()};
  }

  /// The root of the tree with the most moved seeds, then the most seeds, then in the displayed scene.
  std::size_t best_tree(const char* what) {
    struct Count {
      std::size_t moved = 0, all = 0, shown = 0;
      auto operator<=>(const Count&) const = default;
    };
    std::map<std::size_t, Count> trees;
    for (std::size_t node = 0; node < seeds_.size(); ++node) {
      if (!seeds_[node]) continue;
      Count& count = trees[top_[node]];
      ++count.all;
      if (take_.nodes[node].place_or_turn_or_scale()) ++count.moved;
    }
    for (const std::size_t top : default_tops()) {
      if (const auto at = trees.find(top); at != trees.end()) at->second.shown = 1;
    }
    const auto best = std::ranges::max_element(trees, [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const auto& [top, count] : trees) {
      if (top == best->first) continue;
      note(fmt::format("{} with {} {} was left out: a motion has one root, and that is under {}",
                       node_text(content_, top), count.all, what, node_text(content_, best->first)));
    }
    return best->first;
  }

  /// The lowest node that is above all seeds of a tree, or the only seed.
  std::size_t common_node(std::size_t tree) const {
    std::vector<std::size_t> below(seeds_.size(), 0);
    std::size_t all = 0;
    for (std::size_t node = 0; node < seeds_.size(); ++node) {
      if (seeds_[node] && top_[node] == tree) {
        below[node] = 1;
        ++all;
      }
    }
    std::size_t lowest = tree;
    bool found = false;
    for (auto at = forest_.order.rbegin(); at != forest_.order.rend(); ++at) {
      if (top_[*at] != tree) continue;
      // Children come after their parents, so the first node in reverse order that has all seeds is the lowest.
      if (!found && below[*at] == all) {
        lowest = *at;
        found = true;
      }
      if (forest_.parent[*at] != kNoNode) below[forest_.parent[*at]] += below[*at];
    }
    return lowest;
  }

  void keep_moved_above(std::size_t root, std::vector<bool>& kept) const {
    std::size_t highest = root;
    for (std::size_t at = forest_.parent[root]; at != kNoNode; at = forest_.parent[at]) {
      if (is_moved(at)) highest = at;
    }
    for (std::size_t at = root; at != highest; at = forest_.parent[at]) kept[at] = true;
    kept[highest] = true;
  }

  void report_moved_outside(const std::vector<bool>& kept) {
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t node = 0; node < kept.size(); ++node) {
      if (kept[node] || seeds_[node] || is_camera_or_light(node) || !is_moved(node)) continue;
      if (count++ == 0) first = node;
    }
    if (count == 0) return;
    note(fmt::format("{}{} moves but belongs to no skin, and was left out", node_text(content_, first),
                     count > 1 ? fmt::format(", like {} more,", count - 1) : std::string()));
  }

  /// Keeps all nodes below moved ones; cameras, lights and meshes there are not joints.
  void keep_all_below(std::vector<bool>& kept) const {
    std::vector<bool> inside(kept.size(), false);
    for (const std::size_t node : forest_.order) {
      const std::size_t parent = forest_.parent[node];
      inside[node] =
          kept[node] ? seeds_[node] || (parent != kNoNode && inside[parent]) : parent != kNoNode && inside[parent];
    }
    for (auto at = forest_.order.rbegin(); at != forest_.order.rend(); ++at) {
      if (!inside[*at] || kept[*at]) continue;
      const tinygltf::Node& node = content_.model.nodes[*at];
      const bool thing = is_camera_or_light(*at) || node.mesh >= 0;
      const bool carries =
          std::ranges::any_of(node.children, [&](int child) { return kept[static_cast<std::size_t>(child)]; });
      kept[*at] = !thing || carries;
    }
  }

  const Content& content_;
  const NodeForest& forest_;
  const Take& take_;
  std::vector<Notice>& notices_;
  std::vector<std::size_t> top_;
  std::vector<bool> seeds_;
};

}  // namespace

NodeForest forest_of(const Content& content) {
  const auto& nodes = content.model.nodes;
  NodeForest forest;
  forest.parent.assign(nodes.size(), kNoNode);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    for (const int child : nodes[node].children) {
      std::size_t& parent = forest.parent[static_cast<std::size_t>(child)];
      if (parent != kNoNode) {
        throw Error(ErrorCode::bad_input, fmt::format("{}: {} is a child of two nodes; export it again", content.name,
                                                      node_text(content, static_cast<std::size_t>(child))));
      }
      parent = node;
    }
  }
  std::vector<std::size_t> open;
  for (std::size_t node = nodes.size(); node-- > 0;) {
    if (forest.parent[node] == kNoNode) open.push_back(node);
  }
  std::vector<bool> met(nodes.size(), false);
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    met[node] = true;
    forest.order.push_back(node);
    const std::vector<int>& children = nodes[node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      open.push_back(static_cast<std::size_t>(*child));
    }
  }
  if (forest.order.size() < nodes.size()) {
    const auto lost = static_cast<std::size_t>(std::ranges::find(met, false) - met.begin());
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: {} is below itself; export it again", content.name, node_text(content, lost)));
  }
  return forest;
}

std::vector<std::size_t> joints_of(const Content& content, const NodeForest& forest, const Take& take,
                                   std::vector<Notice>& notices) {
  return JointChoice(content, forest, take, notices).choose();
}

}  // namespace signweave::gltf
