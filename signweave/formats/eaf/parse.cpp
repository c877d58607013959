#include "signweave/formats/eaf/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/formats/eaf/ids.h"
#include "signweave/formats/eaf/times.h"

namespace signweave::eaf {
namespace {

using Index = std::unordered_map<std::string_view, std::size_t>;

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

class Parser {
 public:
  Parser(const Xml& xml, Unsound unsound) : xml_(xml), unsound_(unsound) {}

  FileParts run() {
    const pugi::xml_node root = xml_.root();
    if (std::string_view(root.name()) != "ANNOTATION_DOCUMENT") {
      xml_.fail(root, fmt::format("this is not an EAF file: its root element is <{}>; give a file as ELAN saves it",
                                  printable(root.name())));
    }
    read_root(root);
    for (const pugi::xml_node child : root.children()) {
      const std::string_view name = child.name();
      if (name == "HEADER") read_header(child);
      if (name == "TIME_ORDER") read_slots(child);
      if (name == "LINGUISTIC_TYPE") read_type(child);
    }
    for (const pugi::xml_node child : root.children("TIER")) read_tier(child);
    for (FileTier& tier : parts_.tiers) link_tier(tier);
    const std::vector<std::size_t> order = tiers_parents_first();
    for (FileTier& tier : parts_.tiers) read_annotations(tier);
    for (FileTier& tier : parts_.tiers) check_references(tier);
    settle_times(xml_, unsound_, parts_, order);
    return std::move(parts_);
  }

 private:
  void note(pugi::xml_node node, std::string_view what) { parts_.notices.push_back(xml_.notice(node, what)); }

  std::string text(pugi::xml_node node, const char* attribute) const {
    return std::string(xml_.attribute(node, attribute));
  }

  void read_root(pugi::xml_node root) {
    AnnotationDocument& head = parts_.head;
    head.author = text(root, "AUTHOR");
    head.date = text(root, "DATE");
    head.format = text(root, "FORMAT");
    for (const pugi::xml_node node : xml_.document().children()) {
      if (node.type() == pugi::node_doctype) note(node, "has a DOCTYPE: entities that it defines are not expanded");
    }
    constexpr std::array kKnown = {"2.6", "2.7", "2.8", "3.0"};
    if (std::find(kKnown.begin(), kKnown.end(), head.format) == kKnown.end()) {
      note(root, fmt::format("EAF version '{}' is not one of 2.6 to 3.0: read as 3.0", printable(head.format)));
    }
  }

  void read_header(pugi::xml_node header) {
    const std::string_view units = xml_.attribute(header, "TIME_UNITS");
    if (!units.empty() && units != "milliseconds") {
      throw Error(ErrorCode::unsupported,
                  fmt::format("{}:{}: times in '{}' are not read; save the file with times in milliseconds",
                              xml_.name(), xml_.line_of(header), printable(units)));
    }
    for (const pugi::xml_node child : header.children()) {
      const std::string_view name = child.name();
      if (name == "PROPERTY") parts_.head.properties.emplace_back(text(child, "NAME"), xml_.content(child));
      const bool media = name == "MEDIA_DESCRIPTOR";
      if (!media && name != "LINKED_FILE_DESCRIPTOR") continue;
      LinkedFile file;
      file.media = media;
      file.url = text(child, media ? "MEDIA_URL" : "LINK_URL");
      file.relative_url = text(child, media ? "RELATIVE_MEDIA_URL" : "RELATIVE_LINK_URL");
      file.mime_type = text(child, "MIME_TYPE");
      const std::string_view origin = xml_.attribute(child, "TIME_ORIGIN");
      if (!origin.empty()) {
        const std::optional<std::int64_t> time = whole_number(origin);
        if (!time || *time < -kLatest || *time > kLatest) {
          xml_.fail(child, fmt::format("TIME_ORIGIN '{}' is not a number of milliseconds; write a whole number",
                                       printable(origin)));
        }
        file.time_origin = Milliseconds(*time);
      }
      parts_.head.linked_files.push_back(std::move(file));
    }
  }

  void read_slots(pugi::xml_node order) {
    const std::size_t most = xml_.text().size() / 32;  // elements of either kind are longer than this
    slots_.reserve(most);
    annotations_.reserve(most);
    for (pugi::xml_node child = order.child("TIME_SLOT"); child; child = child.next_sibling("TIME_SLOT")) {
      Slot slot;
      slot.element = child;
      slot.id = xml_.required(child, "TIME_SLOT_ID");
      if (const pugi::xml_attribute value = child.attribute("TIME_VALUE")) {
        slot.time = whole_number(value.value());
        if (!slot.time || *slot.time < 0 || *slot.time > kLatest) {
          xml_.fail(child, fmt::format("TIME_VALUE '{}' is not a time; write whole milliseconds from 0 to {}",
                                       printable(value.value()), kLatest));
        }
      }
      if (!slots_.add(slot.id, parts_.slots.size())) {
        xml_.fail(child, fmt::format("a second time slot '{}'; give it an id of its own", printable(slot.id)));
      }
      parts_.slots.push_back(slot);
    }
  }

  void read_type(pugi::xml_node element) {
    TierType type;
    type.id = xml_.required(element, "LINGUISTIC_TYPE_ID");
    type.controlled_vocabulary = text(element, "CONTROLLED_VOCABULARY_REF");
    std::string constraint = text(element, "CONSTRAINTS");
    std::replace(constraint.begin(), constraint.end(), ' ', '_');  // as some tools write it
    if (!constraint.empty()) {
      constexpr std::array kConstraints = {Stereotype::time_subdivision, Stereotype::included_in,
                                           Stereotype::symbolic_subdivision, Stereotype::symbolic_association};
      for (const Stereotype stereotype : kConstraints) {
        if (constraint == name_of(stereotype)) type.stereotype = stereotype;
      }
      if (type.stereotype == Stereotype::none) {
        note(element, fmt::format("type '{}' has the unknown constraint '{}': taken as none", printable(type.id),
                                  printable(constraint)));
      }
    }
    if (!types_.emplace(xml_.attribute(element, "LINGUISTIC_TYPE_ID"), parts_.head.types.size()).second) {
      xml_.fail(element, fmt::format("a second type '{}'; give it an id of its own", printable(type.id)));
    }
    parts_.head.types.push_back(std::move(type));
  }

  void read_tier(pugi::xml_node element) {
    FileTier tier;
    tier.element = element;
    tier.tier.id = xml_.required(element, "TIER_ID");
    tier.tier.type = text(element, "LINGUISTIC_TYPE_REF");
    tier.tier.parent = text(element, "PARENT_REF");
    tier.tier.participant = text(element, "PARTICIPANT");
    tier.tier.annotator = text(element, "ANNOTATOR");
    tier.tier.language = text(element, "LANG_REF");
    if (!tiers_.emplace(xml_.attribute(element, "TIER_ID"), parts_.tiers.size()).second) {
      xml_.fail(element, fmt::format("a second tier '{}'; give it a name of its own", printable(tier.tier.id)));
    }
    parts_.tiers.push_back(std::move(tier));
  }

  void link_tier(FileTier& tier) {
    const std::string name = printable(tier.tier.id);
    if (!tier.tier.parent.empty()) {
      const auto parent = tiers_.find(tier.tier.parent);
      if (parent == tiers_.end()) {
        std::vector<std::string> known;
        for (const FileTier& other : parts_.tiers) known.push_back(other.tier.id);
        xml_.fail(tier.element,
                  fmt::format("tier '{}' has the parent '{}', which is not a tier of this file; name one that is{}",
                              name, printable(tier.tier.parent), did_you_mean(tier.tier.parent, known)));
      }
      tier.parent = parent->second;
    }
    const auto type = types_.find(tier.tier.type);
    if (type == types_.end()) {
      note(tier.element,
           fmt::format("tier '{}' is of type '{}', which is not in the file", name, printable(tier.tier.type)));
      if (tier.parent != kNone) tier.stereotype = Stereotype::included_in;
      return;
    }
    tier.stereotype = parts_.head.types[type->second].stereotype;
    if (tier.parent == kNone && tier.stereotype != Stereotype::none) {
      note(tier.element,
           fmt::format("tier '{}' has no parent, though its type '{}' needs one", name, printable(tier.tier.type)));
    }
    if (tier.parent != kNone && tier.stereotype == Stereotype::none) {
      note(tier.element, fmt::format("tier '{}' has a parent, but its type '{}' has no constraint: read as Included_In",
                                     name, printable(tier.tier.type)));
    }
  }

  /// Without recursion, because a chain of tiers may be as long as the file.
  std::vector<std::size_t> tiers_parents_first() {
    enum class State : char { open, on_path, done };
    std::vector<State> states(parts_.tiers.size(), State::open);
    std::vector<std::size_t> order;
    std::vector<std::size_t> path;
    for (std::size_t start = 0; start < parts_.tiers.size(); ++start) {
      std::size_t at = start;
      while (at != kNone && states[at] == State::open) {
        states[at] = State::on_path;
        path.push_back(at);
        at = parts_.tiers[at].parent;
      }
      if (at != kNone && states[at] == State::on_path) {
        const FileTier& tier = parts_.tiers[at];
        xml_.fail(tier.element, fmt::format("tier '{}' is its own ancestor; give one of its parents another PARENT_REF",
                                            printable(tier.tier.id)));
      }
      for (; !path.empty(); path.pop_back()) {
        states[path.back()] = State::done;
        order.push_back(path.back());
      }
    }
    return order;
  }

  void read_annotations(FileTier& tier) {
    // pugixml's iterators make several library calls per step, and these loops visit the whole file.
    std::size_t most = 0;
    for (pugi::xml_node child = tier.element.first_child(); child; child = child.next_sibling()) ++most;
    tier.annotations.reserve(most);
    for (pugi::xml_node holder = tier.element.child("ANNOTATION"); holder; holder = holder.next_sibling("ANNOTATION")) {
      pugi::xml_node element;
      for (pugi::xml_node child = holder.first_child(); child; child = child.next_sibling()) {
        const std::string_view name = child.name();
        if (name != "ALIGNABLE_ANNOTATION" && name != "REF_ANNOTATION") continue;
        if (element) xml_.fail(child, "a second annotation in one <ANNOTATION>; give it an <ANNOTATION> of its own");
        element = child;
      }
      if (element) read_annotation(tier, element);
    }
    if (std::any_of(tier.annotations.begin(), tier.annotations.end(),
                    [&](const FileAnnotation& one) { return one.has_slots() == is_symbolic(tier.stereotype); }) &&
        types_.contains(tier.tier.type)) {
      note(tier.element, fmt::format("tier '{}' has annotations {} times, which its type does not allow",
                                     printable(tier.tier.id), is_symbolic(tier.stereotype) ? "with" : "without"));
    }
  }

  void read_annotation(FileTier& tier, pugi::xml_node element) {
    const bool has_slots = std::string_view(element.name()) == "ALIGNABLE_ANNOTATION";
    FileAnnotation one;
    one.element = element;
    const std::string_view id = xml_.required(element, "ANNOTATION_ID");
    one.annotation.id = id;
    one.annotation.label = xml_.content(element.child("ANNOTATION_VALUE"));
    if (!annotations_.add(id, static_cast<std::size_t>(&tier - parts_.tiers.data()))) {
      xml_.fail(element, fmt::format("a second annotation '{}'; give it an id of its own", printable(id)));
    }
    if (has_slots) {
      for (const auto& [attribute, slot] :
           {std::pair("TIME_SLOT_REF1", &one.begin), std::pair("TIME_SLOT_REF2", &one.end)}) {
        const std::string_view name = xml_.attribute(element, attribute);
        *slot = name.empty() ? Ids::kMissing : slots_.find(name);
        if (*slot != Ids::kMissing) continue;
        const std::string what =
            name.empty() ? fmt::format("annotation '{}' has no {}", printable(id), attribute)
                         : fmt::format("annotation '{}' uses the time slot '{}', which TIME_ORDER does not have",
                                       printable(id), printable(name));
        return leave_out(tier, std::move(one), what, "add it");
      }
      one.annotation.aligned = parts_.slots[one.begin].time && parts_.slots[one.end].time;
    } else {
      one.annotation.parent = xml_.attribute(element, "ANNOTATION_REF");
      if (one.annotation.parent.empty()) {
        const std::string what = fmt::format("annotation '{}' has no ANNOTATION_REF", printable(id));
        return leave_out(tier, std::move(one), what, "add it");
      }
      one.previous = xml_.attribute(element, "PREVIOUS_ANNOTATION");
      one.annotation.aligned = false;
    }
    tier.annotations.push_back(std::move(one));
  }

  void check_references(FileTier& tier) {
    if (std::ranges::all_of(tier.annotations, &FileAnnotation::has_slots)) return;
    std::vector<FileAnnotation> sound;
    sound.reserve(tier.annotations.size());
    for (FileAnnotation& one : tier.annotations) {
      if (one.has_slots() || refers_soundly(tier, one)) sound.push_back(std::move(one));
    }
    tier.annotations = std::move(sound);
  }

  /// Returns false if the annotation was left out.
  bool refers_soundly(FileTier& tier, FileAnnotation& one) {
    const auto refuse = [&](std::string_view id, std::string_view fault, std::string_view repair) {
      const std::string what = fmt::format("annotation '{}' refers to annotation '{}', {}",
                                           printable(one.annotation.id), printable(id), fault);
      leave_out(tier, std::move(one), what, repair);
      return false;
    };
    const std::string parent = one.annotation.parent;
    const std::size_t parent_tier = annotations_.find(parent);
    if (parent_tier == Ids::kMissing) {
      return refuse(parent, "which is not in the file", "add it or remove this one");
    }
    if (tier.parent == kNone) {
      return refuse(parent, "though its tier has no parent", "give the tier a PARENT_REF");
    }
    if (parent_tier != tier.parent) {
      return refuse(parent,
                    fmt::format("which is on tier '{}' and not on the parent tier '{}'",
                                printable(parts_.tiers[parent_tier].tier.id), printable(tier.tier.parent)),
                    "refer to one that is");
    }
    if (unsound_ == Unsound::refused && !one.previous.empty() && annotations_.find(one.previous) == Ids::kMissing) {
      return refuse(one.previous, "which is not in the file", "correct its PREVIOUS_ANNOTATION");
    }
    return true;
  }

  void leave_out(FileTier& tier, FileAnnotation one, std::string_view what, std::string_view repair) {
    eaf::leave_out(xml_, unsound_, parts_, tier, std::move(one), what, repair);
  }

  const Xml& xml_;
  Unsound unsound_;
  FileParts parts_;
  Ids slots_;
  Index types_;
  Index tiers_;
  Ids annotations_;  ///< id -> tier
};

}  // namespace

FileParts parse(const Xml& xml, Unsound unsound) {
  return Parser(xml, unsound).run();
}

void leave_out(const Xml& xml, Unsound unsound, FileParts& parts, FileTier& tier, FileAnnotation annotation,
               std::string_view what, std::string_view repair) {
  if (unsound == Unsound::refused) xml.fail(annotation.element, fmt::format("{}; {}", what, repair));
  parts.notices.push_back(xml.notice(annotation.element, fmt::format("{}: left out; {}", what, repair)));
  tier.left_out.push_back(std::move(annotation));
}

std::string_view name_of(Stereotype stereotype) noexcept {
  switch (stereotype) {
    case Stereotype::none:
      return "";
    case Stereotype::time_subdivision:
      return "Time_Subdivision";
    case Stereotype::included_in:
      return "Included_In";
    case Stereotype::symbolic_subdivision:
      return "Symbolic_Subdivision";
    case Stereotype::symbolic_association:
      return "Symbolic_Association";
  }
  return "";
}

}  // namespace signweave::eaf
