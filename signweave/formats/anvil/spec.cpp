#include "signweave/formats/anvil/spec.h"

#include <fmt/format.h>

#include <set>

#include "signweave/core/text.h"

namespace signweave::anvil {
namespace {

constexpr std::size_t kDeepestGroup = 64;

class Reader {
 public:
  explicit Reader(const eaf::Xml& xml) : xml_(xml) {}

  Specification run() {
    const pugi::xml_node root = xml_.root();
    if (std::string_view(root.name()) != "annotation-spec") {
      xml_.fail(root, fmt::format("this is not an ANVIL specification: its root element is <{}>; name another in the "
                                  "annotation file's head",
                                  printable(root.name())));
    }
    for (const pugi::xml_node head : root.children("head")) {
      for (const pugi::xml_node types : head.children("valuetype-def")) {
        for (const pugi::xml_node set : types.children("valueset")) sets_.emplace(xml_.attribute(set, "name"));
      }
    }
    for (const pugi::xml_node body : root.children("body")) read_group(body);
    for (TrackSpec& track : specification_.tracks) track.ref = whole_name(track);
    return std::move(specification_);
  }

 private:
  /// Reads nested groups, without recursion.
  void read_group(pugi::xml_node body) {
    struct Level {
      pugi::xml_node next;
      std::string prefix;
    };
    std::vector<Level> levels{{body.first_child(), ""}};
    while (!levels.empty()) {
      const pugi::xml_node node = levels.back().next;
      if (!node) {
        levels.pop_back();
        continue;
      }
      levels.back().next = node.next_sibling();
      const std::string_view kind = node.name();
      if (kind != "group" && kind != "track-spec") continue;
      const std::string name = levels.back().prefix + std::string(xml_.required(node, "name"));
      if (kind == "track-spec") {
        read_track(node, name);
      } else if (levels.size() > kDeepestGroup) {
        xml_.fail(node, fmt::format("more than {} groups inside each other; flatten them", kDeepestGroup));
      } else {
        levels.push_back({node.first_child(), name + "."});
      }
    }
  }

  void read_track(pugi::xml_node node, const std::string& name) {
    TrackSpec track{.name = name,
                    .type = std::string(xml_.attribute(node, "type")),
                    .ref = std::string(xml_.attribute(node, "ref")),
                    .attributes = {}};
    if (!names_.insert(name).second) {
      xml_.fail(node, fmt::format("a second track '{}'; give it a name of its own", printable(name)));
    }
    for (const pugi::xml_node attribute : node.children("attribute")) {
      AttributeSpec one{.name = std::string(xml_.required(attribute, "name")),
                        .values = {},
                        .display = xml_.attribute(attribute, "display") == "true"};
      const std::string type(xml_.attribute(attribute, "valuetype"));
      if (sets_.contains(type)) one.values = type;
      if (attribute.child("value-el")) one.values = name + "." + one.name;
      track.attributes.push_back(std::move(one));
    }
    specification_.tracks.push_back(std::move(track));
  }

  /// A reference gives a track's full name, or the name of one in the same groups.
  std::string whole_name(const TrackSpec& track) const {
    if (track.ref.empty() || names_.contains(track.ref)) return track.ref;
    const std::size_t dot = track.name.rfind('.');
    const std::string sibling = dot == std::string::npos ? track.ref : track.name.substr(0, dot + 1) + track.ref;
    return names_.contains(sibling) ? sibling : track.ref;
  }

  const eaf::Xml& xml_;
  std::set<std::string> sets_;
  std::set<std::string> names_;
  Specification specification_;
};

}  // namespace

const TrackSpec* Specification::find(std::string_view name) const noexcept {
  for (const TrackSpec& track : tracks) {
    if (track.name == name) return &track;
  }
  return nullptr;
}

Specification parse_specification(std::string name, std::string_view text) {
  const eaf::Xml xml(std::move(name), text, "an ANVIL specification");
  refuse_control_characters(xml);
  return Reader(xml).run();
}

}  // namespace signweave::anvil
