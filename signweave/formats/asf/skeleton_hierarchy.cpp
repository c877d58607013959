#include <fmt/format.h>

#include <string_view>
#include <unordered_map>

#include "signweave/formats/asf/lines.h"
#include "signweave/formats/asf/skeleton.h"

namespace signweave::asf {
namespace {

[[noreturn]] void refuse_kinship(const std::string& file, std::size_t line, const std::string& what) {
  throw Error(ErrorCode::bad_input, fmt::format("{}:{}: {}", file, line, what));
}

using Children = std::vector<std::vector<JointIndex>>;  // [bone], in the file's order

Children children_given(std::vector<Bone>& bones, const std::vector<Kinship>& kinships, const std::string& file) {
  std::unordered_map<std::string_view, JointIndex> index;
  for (std::size_t i = 0; i < bones.size(); ++i) index.emplace(bones[i].name, static_cast<JointIndex>(i));
  const auto bone_of = [&](const std::string& name, std::size_t line) {
    if (same_word(name, "root")) return JointIndex{0};
    const auto found = index.find(name);
    if (found != index.end()) return found->second;
    std::vector<std::string> known;
    for (const Bone& bone : bones) known.push_back(bone.name);
    refuse_kinship(file, line,
                   fmt::format(":hierarchy names {}, which is not a bone of :bonedata{}", in_quotes(name),
                               did_you_mean_bone(name, known)));
  };

  Children children(bones.size());
  std::vector<std::size_t> given_at(bones.size(), 0);
  for (const Kinship& kinship : kinships) {
    const JointIndex parent = bone_of(kinship.names.front(), kinship.line);
    for (std::size_t i = 1; i < kinship.names.size(); ++i) {
      const JointIndex child = bone_of(kinship.names[i], kinship.line);
      const auto at = static_cast<std::size_t>(child);
      const std::string name = in_quotes(bones[at].name);
      if (child == 0)
        refuse_kinship(file, kinship.line, "the root is listed under a bone; it comes first and has no parent");
      if (child == parent)
        refuse_kinship(file, kinship.line, fmt::format("bone {} is its own parent; name another", name));
      if (bones[at].parent == parent) {
        refuse_kinship(file, kinship.line,
                       fmt::format("bone {} is listed twice under {}, also in line {}; remove one", name,
                                   in_quotes(bones[static_cast<std::size_t>(parent)].name), given_at[at]));
      }
      if (bones[at].parent != kNoJoint) {
        refuse_kinship(file, kinship.line,
                       fmt::format("bone {} has the parent {} and, in line {}, {}; a bone has one parent", name,
                                   in_quotes(bones[static_cast<std::size_t>(parent)].name), given_at[at],
                                   in_quotes(bones[static_cast<std::size_t>(bones[at].parent)].name)));
      }
      bones[at].parent = parent;
      given_at[at] = kinship.line;
      children[static_cast<std::size_t>(parent)].push_back(child);
    }
  }
  return children;
}

/// All bones below the root, parents first, depth first, with an explicit list, because chains are thousands long.
std::vector<JointIndex> depth_first(const Children& children) {
  std::vector<JointIndex> order;
  std::vector<JointIndex> open{0};
  while (!open.empty()) {
    const JointIndex bone = open.back();
    open.pop_back();
    order.push_back(bone);
    const std::vector<JointIndex>& on = children[static_cast<std::size_t>(bone)];
    open.insert(open.end(), on.rbegin(), on.rend());
  }
  return order;
}

/// Reports a bone that is not below the root, and the reason.
[[noreturn]] void refuse_loose(const std::vector<Bone>& bones, const std::string& file, std::size_t end_line) {
  std::size_t loose = 0;
  for (std::size_t i = 1; i < bones.size() && loose == 0; ++i) {
    if (bones[i].parent == kNoJoint) loose = i;
  }
  if (loose != 0) {
    refuse_kinship(
        file, bones[loose].line,
        fmt::format("bone {} has no parent; name it in :hierarchy after its parent", in_quotes(bones[loose].name)));
  }
  // Each bone has a parent, so following parents from a bone that does not reach the root leads into a cycle.
  std::vector<std::size_t> seen_from(bones.size(), 0);
  for (std::size_t i = 1; i < bones.size(); ++i) {
    std::size_t at = i;
    for (; at != 0 && seen_from[at] == 0; at = static_cast<std::size_t>(bones[at].parent)) seen_from[at] = i;
    if (at != 0 && seen_from[at] == i) {
      refuse_kinship(
          file, end_line,
          fmt::format("bone {} is its own ancestor through {}; one bone of this cycle must be under the root",
                      in_quotes(bones[at].name), in_quotes(bones[static_cast<std::size_t>(bones[at].parent)].name)));
    }
  }
  refuse_kinship(file, end_line, "not every bone is under the root");
}

}  // namespace

void order_bones(std::vector<Bone>& bones, const std::vector<Kinship>& kinships, const std::string& file,
                 std::size_t end_line) {
  const Children children = children_given(bones, kinships, file);
  const std::vector<JointIndex> order = depth_first(children);
  if (order.size() != bones.size()) refuse_loose(bones, file, end_line);
  std::vector<JointIndex> place(bones.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<JointIndex>(i);
  }
  std::vector<Bone> ordered;
  ordered.reserve(bones.size());
  for (const JointIndex from : order) {
    Bone& bone = bones[static_cast<std::size_t>(from)];
    if (bone.parent != kNoJoint) bone.parent = place[static_cast<std::size_t>(bone.parent)];
    ordered.push_back(std::move(bone));
  }
  bones = std::move(ordered);
}

}  // namespace signweave::asf
