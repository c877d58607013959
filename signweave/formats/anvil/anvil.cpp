#include "signweave/formats/anvil/anvil.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/anvil/spec.h"
#include "signweave/formats/anvil/times.h"

namespace signweave::anvil {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWanted = "an ANVIL file";

std::string mime_type(std::string_view element, std::string_view url) {
  const std::string extension = fold_case(fs::path(std::string(url)).extension().string());
  constexpr std::pair<std::string_view, std::string_view> kKnown[] = {
      {".mp4", "video/mp4"},       {".mpg", "video/mpeg"},  {".mpeg", "video/mpeg"}, {".mov", "video/quicktime"},
      {".avi", "video/x-msvideo"}, {".wav", "audio/x-wav"}, {".mp3", "audio/mpeg"}};
  for (const auto& [known, type] : kKnown) {
    if (extension == known) return std::string(type);
  }
  return element == "audio" ? "audio/unknown" : element == "video" ? "video/unknown" : "unknown";
}

class Parser {
 public:
  Parser(const eaf::Xml& xml, const Specification& specification) : xml_(xml) {
    for (const TrackSpec& track : specification.tracks) specs_.emplace(track.name, &track);
  }

  File run() {
    const pugi::xml_node root = xml_.root();
    if (std::string_view(root.name()) != "annotation") {
      xml_.fail(root, fmt::format("this is not an ANVIL file: its root element is <{}>; give a file as ANVIL saves it",
                                  printable(root.name())));
    }
    for (const pugi::xml_node head : root.children("head")) read_head(head);
    for (const pugi::xml_node body : root.children("body")) {
      for (const pugi::xml_node track : body.children("track")) read_track(track);
    }
    link_tracks();
    settle_times(xml_, tracks_, file_.notices);
    for (const Track& track : tracks_) add_tiers(track);
    return std::move(file_);
  }

 private:
  void read_head(pugi::xml_node head) {
    AnnotationDocument& document = file_.document;
    for (const pugi::xml_node child : head.children()) {
      const std::string_view kind = child.name();
      if (kind == "info") {
        const std::string key(xml_.attribute(child, "key"));
        const std::string value(trimmed(xml_.content(child)));
        if (document.author.empty() && (key == "coder" || key == "author")) document.author = value;
        document.properties.emplace_back(key, value);
      } else if (kind != "specification" && !xml_.attribute(child, "src").empty()) {
        const std::string url(xml_.attribute(child, "src"));
        document.linked_files.push_back({.url = url,
                                         .relative_url = {},
                                         .mime_type = mime_type(kind, url),
                                         .media = kind == "video" || kind == "audio"});
      }
    }
  }

  void read_track(pugi::xml_node node) {
    Track track;
    track.node = node;
    track.name = xml_.required(node, "name");
    if (!names_.emplace(track.name, tracks_.size()).second) {
      xml_.fail(node, fmt::format("a second track '{}'; give it a name of its own", printable(track.name)));
    }
    const auto spec = specs_.find(track.name);
    const TrackSpec* known = spec == specs_.end() ? nullptr : spec->second;
    std::string_view type = xml_.attribute(node, "type");
    if (type.empty() && known != nullptr) type = known->type;
    track.ref_name = xml_.attribute(node, "ref");
    if (track.ref_name.empty() && known != nullptr) track.ref_name = known->ref;
    if (known != nullptr) {
      for (const AttributeSpec& one : known->attributes) add_attribute(track, one.name, one.values, one.display);
    }
    for (const pugi::xml_node child : node.children()) {
      const std::string_view kind = child.name();
      if (kind == "el") read_element(track, child, {});
      if (kind != "el-group") continue;
      for (const pugi::xml_node inner : child.children("el")) read_element(track, inner, child);
    }
    track.kind = kind_of(node, type, !track.elements.empty());
    choose_main(track);
    tracks_.push_back(std::move(track));
  }

  TrackKind kind_of(pugi::xml_node node, std::string_view type, bool has_elements) {
    std::string name = fold_case(type);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == '_'; }, ' ');
    if (name == "primary" || name.empty()) return TrackKind::primary;
    if (name == "primarypoint" || name == "primary point") return TrackKind::point;
    if (name == "singleton" || name == "symbolic association") return TrackKind::singleton;
    if (name == "span") return TrackKind::span;
    if (name == "subdivision") return TrackKind::subdivision;
    if (name == "symbolic subdivision") return TrackKind::parts;
    if (has_elements) {
      file_.notices.push_back(
          xml_.notice(node, fmt::format("a track of the unknown type '{}': read as a primary one", printable(type))));
    }
    return TrackKind::primary;
  }

  std::size_t add_attribute(Track& track, std::string_view name, std::string_view values = {}, bool display = false) {
    const auto [at, added] = track.attribute_places.emplace(name, track.attributes.size());
    if (added) track.attributes.push_back({std::string(name), std::string(values), display});
    return at->second;
  }

  void read_element(Track& track, pugi::xml_node node, pugi::xml_node group) {
    Element element{.node = node, .group = group, .number = ++elements_};
    const std::string_view written = xml_.attribute(node, "index");
    element.index = static_cast<std::int64_t>(track.elements.size());
    if (!written.empty()) element.index = index_in(xml_, node, "index", written);
    if (!track.places.emplace(element.index, track.elements.size()).second) {
      xml_.fail(node, fmt::format("a second element {} in track '{}'; give it an index of its own", element.index,
                                  printable(track.name)));
    }
    for (const pugi::xml_node child : node.children()) {
      const std::string_view kind = child.name();
      const bool comment = kind == "comment";
      if (!comment && kind != "attribute") continue;
      const std::string_view name = comment ? kind : xml_.required(child, "name");
      std::string value = value_of(child);
      if (comment && value.empty()) continue;
      const std::size_t place = add_attribute(track, name);
      for (const Value& other : element.values) {
        if (other.attribute != place) continue;
        xml_.fail(child, fmt::format("a second '{}' in one element; take one out", printable(name)));
      }
      element.values.push_back({place, std::move(value)});
    }
    track.elements.push_back(std::move(element));
  }

  /// The value's text; links to elements as "TRACK[INDEX]".
  std::string value_of(pugi::xml_node node) const {
    std::string value(trimmed(xml_.content(node)));
    for (const pugi::xml_node link : node.children("value-link")) {
      if (!value.empty()) value += ", ";
      value += fmt::format("{}[{}]", xml_.attribute(link, "ref-track"), xml_.attribute(link, "ref-index"));
    }
    return value;
  }

  static void choose_main(Track& track) {
    const std::string_view last = std::string_view(track.name).substr(track.name.rfind('.') + 1);
    for (const std::string_view wanted : {last, std::string_view("token")}) {
      const auto found = track.attribute_places.find(std::string(wanted));
      if (found == track.attribute_places.end()) continue;
      track.main = found->second;
      return;
    }
    const auto shown = std::find_if(track.attributes.begin(), track.attributes.end(),
                                    [](const AttributeSpec& one) { return one.display; });
    if (shown != track.attributes.end()) track.main = static_cast<std::size_t>(shown - track.attributes.begin());
  }

  void link_tracks() {
    for (Track& track : tracks_) {
      if (track.kind == TrackKind::primary || track.kind == TrackKind::point) continue;
      if (track.elements.empty() && track.ref_name.empty()) continue;
      if (track.ref_name.empty()) {
        xml_.fail(track.node, fmt::format("track '{}' refers to no track; add a ref", printable(track.name)));
      }
      const auto found = names_.find(track.ref_name);
      if (found == names_.end()) {
        if (track.elements.empty()) continue;  // the track has no elements, and neither does the one it refers to
        std::vector<std::string> known;
        for (const Track& other : tracks_) known.push_back(other.name);
        xml_.fail(track.node,
                  fmt::format("track '{}' refers to track '{}', which is not in the file; name one that is{}",
                              printable(track.name), printable(track.ref_name), did_you_mean(track.ref_name, known)));
      }
      track.ref = found->second;
    }
  }

  /// The id of a type of this kind; adds the type to the document if it is missing.
  std::string type_of(Stereotype stereotype, const std::string& values) {
    constexpr std::string_view kNames[] = {"primary", "subdivision", "inside", "parts", "attribute"};
    std::string id(kNames[static_cast<std::size_t>(stereotype)]);
    if (!values.empty()) id += " of " + values;
    if (types_.insert(id).second) file_.document.types.push_back({id, stereotype, values});
    return id;
  }

  static Stereotype stereotype_of(const Track& track) {
    if (track.ref == kNone) return Stereotype::none;
    switch (track.kind) {
      case TrackKind::primary:
      case TrackKind::point:
      case TrackKind::span:
        return Stereotype::none;
      case TrackKind::singleton:
        return Stereotype::symbolic_association;
      case TrackKind::parts:
        return Stereotype::symbolic_subdivision;
      case TrackKind::subdivision:
        return track.has_gaps ? Stereotype::included_in : Stereotype::time_subdivision;
    }
    return Stereotype::none;
  }

  /// A name that no track and no other tier has.
  std::string free_name(std::string name) {
    while (names_.contains(name) || !attribute_tiers_.insert(name).second) name += " (attribute)";
    return name;
  }

  void add_tiers(const Track& track) {
    const Stereotype stereotype = stereotype_of(track);
    const bool under = stereotype != Stereotype::none;
    std::vector<Tier> tiers(std::max<std::size_t>(track.attributes.size(), 1));
    tiers[track.main].id = track.name;
    tiers[track.main].type =
        type_of(stereotype, track.attributes.empty() ? std::string() : track.attributes[track.main].values);
    if (under) tiers[track.main].parent = tracks_[track.ref].name;
    for (std::size_t i = 0; i < track.attributes.size(); ++i) {
      if (i == track.main) continue;
      tiers[i].id = free_name(track.name + "." + track.attributes[i].name);
      tiers[i].type = type_of(Stereotype::symbolic_association, track.attributes[i].values);
      tiers[i].parent = track.name;
    }
    for (const std::size_t place : track.order) {
      const Element& element = track.elements[place];
      Annotation annotation{.id = fmt::format("a{}", element.number), .label = {}, .span = element.span};
      annotation.aligned = element.aligned;
      if (under) annotation.parent = fmt::format("a{}", tracks_[track.ref].elements[element.parent].number);
      std::size_t part = 1;
      for (const Value& value : element.values) {
        if (value.attribute == track.main) {
          annotation.label = value.text;
          continue;
        }
        tiers[value.attribute].annotations.push_back({.id = fmt::format("{}.{}", annotation.id, ++part),
                                                      .label = value.text,
                                                      .span = element.span,
                                                      .parent = annotation.id,
                                                      .aligned = false});
      }
      tiers[track.main].annotations.push_back(std::move(annotation));
    }
    std::rotate(tiers.begin(), tiers.begin() + static_cast<std::ptrdiff_t>(track.main),
                tiers.begin() + static_cast<std::ptrdiff_t>(track.main) + 1);
    std::move(tiers.begin(), tiers.end(), std::back_inserter(file_.document.tiers));
  }

  const eaf::Xml& xml_;
  std::unordered_map<std::string_view, const TrackSpec*> specs_;
  File file_;
  std::vector<Track> tracks_;
  std::unordered_map<std::string, std::size_t> names_;
  std::unordered_set<std::string> attribute_tiers_;
  std::unordered_set<std::string> types_;
  std::size_t elements_ = 0;  ///< in the file so far
};

/// The specification that the head names; empty if it names none.
std::string specification_name(const eaf::Xml& xml) {
  const std::string source(xml.attribute(xml.root().child("head").child("specification"), "src"));
  return source.substr(source.find_last_of("/\\") + 1);  // npos + 1 is 0
}

fs::path specification_in(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  if (name.empty() || name == "." || name == "..") return {};
  const fs::path path = folder / name;
  return fs::is_regular_file(path, ignored) ? path : fs::path();
}

}  // namespace

File read_text(const std::string& name, std::string_view text, std::string_view specification) {
  const eaf::Xml xml(name, text, kWanted);
  refuse_control_characters(xml);
  Specification parsed;
  if (!specification.empty()) parsed = parse_specification(name + "'s specification", specification);
  File file = Parser(xml, parsed).run();
  file.document.source = text;
  file.document.source_format = SourceFormat::anvil;
  file.document.specification = specification;
  return file;
}

std::filesystem::path specification_of(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  return specification_in(path.parent_path(), specification_name(eaf::Xml(path.string(), text, kWanted)));
}

File read(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  const std::string named = specification_name(eaf::Xml(path.string(), text, kWanted));
  const fs::path specification_path = specification_in(path.parent_path(), named);
  if (specification_path.empty()) {
    File file = read_text(path.string(), text);
    if (!named.empty()) {
      file.notices.push_back({path.string(), fmt::format("its specification '{}' is not in its folder; read without it",
                                                         printable(named))});
    }
    return file;
  }
  const std::string specification = read_file(specification_path, kLargestSpecification);
  parse_specification(specification_path.string(), specification);  // reports its errors under its own name
  return read_text(path.string(), text, specification);
}

}  // namespace signweave::anvil
