#include "signweave/formats/fbx/takes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "signweave/core/text.h"

namespace signweave::fbx {
namespace {

/// The links to each object, in the file's order.
using Belongings = std::unordered_map<const Object*, std::vector<const Link*>>;

bool is_a(const Object* object, std::string_view kind) noexcept {
  return object != nullptr && object->record->name == kind;
}

Animated animated(std::string_view name) noexcept {
  if (name == "Lcl Translation") return Animated::translation;
  if (name == "Lcl Rotation") return Animated::rotation;
  if (name == "Lcl Scaling") return Animated::scaling;
  return Animated::other;
}

std::size_t component(std::string_view name) noexcept {
  if (name.substr(0, 2) == "d|") name.remove_prefix(2);
  return name == "X" ? 0 : name == "Y" ? 1 : name == "Z" ? 2 : kNone;
}

/// The contents of a curve node, whatever it animates.
struct CurveNode {
  std::array<const Record*, 3> curves{};
  std::array<std::optional<double>, 3> values{};
  const Record* percent = nullptr;
};

CurveNode curve_node_of(const Source& source, const Record& record, const std::vector<const Link*>& belongings) {
  CurveNode node;
  for (const Link* link : belongings) {
    if (!is_a(link->from, "AnimationCurve")) continue;
    if (link->property == "d|DeformPercent" || link->property == "DeformPercent") node.percent = link->from->record;
    const std::size_t which = component(link->property);
    if (which == kNone) continue;
    if (node.curves[which] != nullptr) {
      source.fail(link->from->record->place,
                  fmt::format("a second curve for '{}' of one AnimationCurveNode", printable(link->property)));
    }
    node.curves[which] = link->from->record;
  }
  constexpr std::array<std::string_view, 3> kNames{"d|X", "d|Y", "d|Z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const Record* value = property(&record, kNames[i]);
    if (value == nullptr) continue;
    const double number = value->number(4, 0);
    if (!(std::abs(number) <= 1e9)) {
      source.fail(value->place,
                  fmt::format("{} is {}; values beyond 1e+09 are not accepted as measurements", kNames[i], number));
    }
    node.values[i] = number;
  }
  return node;
}

void add_targets(const CurveNode& node, const std::vector<const Link*>& targets, std::size_t layer, Take& take) {
  const bool any = node.curves[0] != nullptr || node.curves[1] != nullptr || node.curves[2] != nullptr;
  for (const Link* target : targets) {
    if (target->to == nullptr || target->property.empty()) continue;
    if (is_a(target->to, "Deformer") && target->property == "DeformPercent" && node.percent != nullptr) {
      take.morphs.push_back({.name = object_name(target->to->record->text(1)), .curve = node.percent, .layer = layer});
    }
    if (target->to->node == kNone || !any) continue;
    take.channels.push_back({.node = target->to->node,
                             .what = animated(target->property),
                             .property = std::string(target->property),
                             .layer = layer,
                             .curves = node.curves,
                             .values = node.values});
  }
}

}  // namespace

std::string object_name(std::string_view text) {
  if (const std::size_t end = text.find(std::string_view("\0\1", 2)); end != std::string_view::npos) {
    return std::string(text.substr(0, end));
  }
  if (const std::size_t colons = text.find("::"); colons != std::string_view::npos) text.remove_prefix(colons + 2);
  return std::string(text);
}

Links links_of(const Source& source, const Record& root, const ObjectTable& table) {
  Links links;
  const Record* connections = root.child("Connections");
  if (connections == nullptr) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: it has no Connections; export it again", source.name));
  }
  for (const Record& one : connections->children) {
    const std::string_view kind = one.text(0);
    if (one.name != "C" || (kind != "OO" && kind != "OP")) continue;
    if (one.values.size() < 3 || one.values[1].kind != Value::Kind::whole || one.values[2].kind != Value::Kind::whole) {
      source.fail(one.place, "a connection must name two objects by their numbers");
    }
    const Object* from = table.find(one.values[1].whole);
    const Object* to = table.find(one.values[2].whole);
    // Objects that are not in the table (meshes, materials …) were skipped; 0 is the scene.
    if (from == nullptr || (to == nullptr && one.values[2].whole != 0)) continue;
    links.push_back({.from = from, .to = to, .property = kind == "OP" ? one.text(3) : std::string_view()});
  }
  return links;
}

std::vector<Take> takes_of(const Source& source, const Record& objects, const ObjectTable& table, const Links& links) {
  Belongings targets;
  Belongings belongings;
  for (const Link& link : links) {
    if (is_a(link.from, "AnimationCurveNode")) targets[link.from].push_back(&link);
    if (link.to != nullptr) belongings[link.to].push_back(&link);
  }
  const std::vector<const Link*> none;
  const auto of = [&](const Belongings& which, const Object* object) -> const std::vector<const Link*>& {
    const auto found = which.find(object);
    return found == which.end() ? none : found->second;
  };
  // Each layer belongs to one take and each curve node to one layer: otherwise a small file could define very many
  // animations.
  std::unordered_set<const Object*> seen;
  const auto once = [&](const Object* object) {
    if (seen.insert(object).second) return;
    source.fail(object->record->place,
                fmt::format("{} '{}' belongs to two others; export it again", printable(object->record->name),
                            printable(object_name(object->record->text(1)))));
  };
  std::vector<Take> takes;
  for (const Record& record : objects.children) {
    if (record.name != "AnimationStack") continue;
    Take take;
    take.name = object_name(record.text(1));
    if (const Record* start = property(&record, "LocalStart")) take.start = start->whole(4, 0);
    if (const Record* stop = property(&record, "LocalStop")) take.stop = stop->whole(4, 0);
    std::size_t layer = 0;
    for (const Link* link : of(belongings, table.find(record.whole(0, 0)))) {
      if (!is_a(link->from, "AnimationLayer")) continue;
      once(link->from);
      for (const Link* node : of(belongings, link->from)) {
        if (!is_a(node->from, "AnimationCurveNode") || !node->property.empty()) continue;
        once(node->from);
        add_targets(curve_node_of(source, *node->from->record, of(belongings, node->from)), of(targets, node->from),
                    layer, take);
      }
      ++layer;
    }
    takes.push_back(std::move(take));
  }
  return takes;
}

}  // namespace signweave::fbx
