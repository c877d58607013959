#include "signweave/formats/fbx/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "signweave/core/text.h"
#include "signweave/formats/fbx/takes.h"

namespace signweave::fbx {
namespace {

/// The properties of a template by name: every node uses them, so they are indexed once.
using Template = std::unordered_map<std::string_view, const Record*>;

/// Properties of an object, with its type's template as fallback.
struct Properties {
  const Source& source;
  const Record* own = nullptr;
  const Template* otherwise = nullptr;

  const Record* find(std::string_view name) const {
    const Record* found = property(own, name);
    if (found == nullptr && otherwise != nullptr) {
      const auto place = otherwise->find(name);
      if (place != otherwise->end()) found = place->second;
    }
    if (found == nullptr) return nullptr;
    for (std::size_t i = 4; i < found->values.size(); ++i) {
      if (found->values[i].kind == Value::Kind::whole || found->values[i].kind == Value::Kind::real) continue;
      source.fail(found->place, fmt::format("{} should be numbers", printable(name)));
    }
    return found;
  }
  double number(std::string_view name, double fallback) const {
    const Record* found = find(name);
    if (found == nullptr) return fallback;
    const double value = found->number(4, fallback);
    if (!(std::abs(value) <= 1e9)) refuse(*found, value);
    return value;
  }
  std::int64_t whole(std::string_view name, std::int64_t fallback) const {
    const Record* found = find(name);
    return found == nullptr ? fallback : found->whole(4, fallback);
  }
  Eigen::Vector3d vector(std::string_view name, double fallback) const {
    Eigen::Vector3d result = Eigen::Vector3d::Constant(fallback);
    const Record* found = find(name);
    if (found == nullptr) return result;
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = found->number(4 + i, fallback);
      if (!(std::abs(value) <= 1e9)) refuse(*found, value);
      result[static_cast<Eigen::Index>(i)] = value;
    }
    return result;
  }
  [[noreturn]] void refuse(const Record& found, double value) const {
    source.fail(found.place, fmt::format("{} is {}; values beyond 1e+09 are not accepted as measurements",
                                         printable(found.text(0)), value));
  }
};

Template node_template(const Record& root) {
  Template properties;
  const Record* definitions = root.child("Definitions");
  if (definitions == nullptr) return properties;
  for (const Record& type : definitions->children) {
    if (type.name != "ObjectType" || type.text(0) != "Model") continue;
    const Record* first = type.child("PropertyTemplate");
    const Record* table = first == nullptr ? nullptr : first->child("Properties70");
    if (table == nullptr) continue;
    for (const Record& one : table->children) properties.emplace(one.text(0), &one);
  }
  return properties;
}

Node node_of(const Source& source, const Record& record, const Template& otherwise) {
  const Properties from{.source = source, .own = &record, .otherwise = &otherwise};
  Node node;
  node.name = object_name(record.text(1));
  node.type = record.text(2);
  node.place = record.place;
  node.translation = from.vector("Lcl Translation", 0);
  node.rotation = from.vector("Lcl Rotation", 0);
  node.scaling = from.vector("Lcl Scaling", 1);
  node.pre_rotation = from.vector("PreRotation", 0);
  node.post_rotation = from.vector("PostRotation", 0);
  node.rotation_offset = from.vector("RotationOffset", 0);
  node.rotation_pivot = from.vector("RotationPivot", 0);
  node.scaling_offset = from.vector("ScalingOffset", 0);
  node.scaling_pivot = from.vector("ScalingPivot", 0);
  node.rotation_active = from.whole("RotationActive", 0) != 0;
  const std::int64_t order = from.whole("RotationOrder", 0);
  const std::int64_t inherit = from.whole("InheritType", 1);
  if (order < 0 || order > 6) {
    source.fail(record.place, fmt::format("node '{}' has the unknown rotation order {}", printable(node.name), order));
  }
  if (inherit < 0 || inherit > 2) {
    source.fail(record.place, fmt::format("node '{}' has the unknown InheritType {}", printable(node.name), inherit));
  }
  node.rotation_order = static_cast<int>(order);
  node.inherit = static_cast<int>(inherit);
  return node;
}

Settings settings_of(const Source& source, const Record& root) {
  Settings settings;
  const Record* record = root.child("GlobalSettings");
  if (record == nullptr) return settings;
  const Properties from{.source = source, .own = record};
  const auto axis = [&](std::string_view name, std::size_t index) {
    const std::string sign = std::string(name) + "Sign";
    settings.axes[index] = static_cast<int>(std::clamp<std::int64_t>(from.whole(name, settings.axes[index]), -1, 3));
    settings.signs[index] = from.whole(sign, 1) < 0 ? -1 : 1;
  };
  axis("CoordAxis", 0);
  axis("UpAxis", 1);
  axis("FrontAxis", 2);
  std::array<int, 3> sorted = settings.axes;
  std::sort(sorted.begin(), sorted.end());
  if (sorted != std::array<int, 3>{0, 1, 2}) {
    source.fail(record->place,
                fmt::format("CoordAxis {}, UpAxis {} and FrontAxis {} are not the three axes 0, 1 and 2; "
                            "export it again",
                            settings.axes[0], settings.axes[1], settings.axes[2]));
  }
  settings.has_axes = from.find("UpAxis") != nullptr;
  settings.has_unit = from.find("UnitScaleFactor") != nullptr;
  settings.unit_factor = from.number("UnitScaleFactor", 1);
  if (!(settings.unit_factor >= 1e-6)) {
    source.fail(record->place, fmt::format("UnitScaleFactor is {}; export it again with a unit", settings.unit_factor));
  }
  settings.time_mode = from.whole("TimeMode", 0);
  settings.custom_rate = from.number("CustomFrameRate", 0);
  return settings;
}

/// Fails if a node is its own ancestor.
void check_tree(const Source& source, const std::vector<Node>& nodes) {
  std::vector<std::size_t> open;
  std::vector<bool> seen(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent == kNone) open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    seen[node] = true;
    open.insert(open.end(), nodes[node].children.begin(), nodes[node].children.end());
  }
  const auto unseen = std::find(seen.begin(), seen.end(), false);
  if (unseen == seen.end()) return;
  const Node& node = nodes[static_cast<std::size_t>(unseen - seen.begin())];
  source.fail(node.place, fmt::format("node '{}' is its own ancestor; export it again", printable(node.name)));
}

}  // namespace

const Record* property(const Record* object, std::string_view name) noexcept {
  const Record* table = object == nullptr ? nullptr : object->child("Properties70");
  if (table == nullptr) return nullptr;
  for (const Record& one : table->children) {
    if (one.text(0) == name) return &one;
  }
  return nullptr;
}

Scene scene_of(const Source& source, const Record& root) {
  Scene scene;
  scene.settings = settings_of(source, root);
  const Record* objects = root.child("Objects");
  if (objects == nullptr) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: it has no Objects; export it again", source.name));
  }
  const Template otherwise = node_template(root);
  ObjectTable table;
  for (const Record& record : objects->children) {
    if (record.values.empty() || record.values[0].kind != Value::Kind::whole || record.values[0].whole == 0) {
      source.fail(record.place, fmt::format("{} has no number as its id", printable(record.name)));
    }
    Object object{.record = &record};
    if (record.name == "Model") {
      object.node = scene.nodes.size();
      scene.nodes.push_back(node_of(source, record, otherwise));
    }
    if (!table.add(record.whole(0, 0), object)) {
      source.fail(record.place, fmt::format("a second object with the number {}", record.whole(0, 0)));
    }
  }
  const Links links = links_of(source, root, table);
  for (const Link& link : links) {
    if (link.from->node == kNone || link.to == nullptr || link.to->node == kNone || !link.property.empty()) continue;
    Node& child = scene.nodes[link.from->node];
    if (link.from == link.to) {
      source.fail(child.place, fmt::format("node '{}' is its own ancestor; export it again", printable(child.name)));
    }
    if (child.parent != kNone) {
      source.fail(child.place, fmt::format("node '{}' has two parents; export it again", printable(child.name)));
    }
    child.parent = link.to->node;
    scene.nodes[link.to->node].children.push_back(link.from->node);
  }
  check_tree(source, scene.nodes);
  scene.takes = takes_of(source, *objects, table, links);
  return scene;
}

}  // namespace signweave::fbx
