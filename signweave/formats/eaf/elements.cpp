#include "signweave/formats/eaf/elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <unordered_set>

#include "signweave/core/text.h"
#include "signweave/formats/eaf/xml.h"

namespace signweave::eaf {
namespace {

std::optional<std::string> unless_empty(std::string_view text) {
  if (text.empty()) return std::nullopt;
  return std::string(text);
}

std::string closed(std::string tag) {
  return tag += "/>";
}

std::string_view description_of(Stereotype stereotype) {
  switch (stereotype) {
    case Stereotype::time_subdivision:
      return "Time subdivision of parent annotation's time interval, no time gaps allowed within this interval";
    case Stereotype::symbolic_subdivision:
      return "Symbolic subdivision of a parent annotation. Annotations refering to the same parent are ordered";
    case Stereotype::symbolic_association:
      return "1-1 association with a parent annotation";
    default:
      return "Time alignable annotations within the parent annotation's time interval, gaps are allowed";
  }
}

/// The number n of an id "an"; 0 for any other id.
std::uint64_t number_of(std::string_view id) {
  std::uint64_t number = 0;
  if (id.size() < 2 || id.size() > 16 || id.front() != 'a') return 0;
  const auto [end, error] = std::from_chars(id.data() + 1, id.data() + id.size(), number);
  return error == std::errc() && end == id.data() + id.size() ? number : 0;
}

std::uint64_t last_number(const AnnotationDocument& document) {
  std::uint64_t last = 0;
  for (const Tier& tier : document.tiers) {
    for (const Annotation& one : tier.annotations) last = std::max(last, number_of(one.id));
  }
  for (const auto& [name, value] : document.properties) {
    if (name == kLastUsedAnnotationId) last = std::max(last, number_of("a" + value));
  }
  return last;
}

[[noreturn]] void refuse(const Tier& tier, std::string_view what) {
  throw Error(ErrorCode::bad_input, fmt::format("tier '{}': {}", printable(tier.id), what));
}

/// Without recursion, because a chain of tiers may be long.
std::vector<std::size_t> parents_first(const CheckedDocument& checked) {
  const std::size_t count = checked.parents.size();
  std::vector<std::size_t> order;
  std::vector<char> state(count, 'o');  // open, on the path, done
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < count; ++start) {
    std::size_t at = start;
    for (; at != kNone && state[at] == 'o'; at = checked.parents[at]) {
      state[at] = 'p';
      path.push_back(at);
    }
    if (at != kNone && state[at] == 'p') {
      refuse(checked.document.tiers[at], "is its own ancestor; give one of its parents another parent");
    }
    for (; !path.empty(); path.pop_back()) {
      state[path.back()] = 'd';
      order.push_back(path.back());
    }
  }
  return order;
}

void check_annotation(const Tier& tier, const Annotation& one, Stereotype stereotype) {
  const TimeSpan span = one.span;
  const Milliseconds latest(kLatest);
  if (span.begin > span.end) {
    refuse(tier, fmt::format("annotation '{}' ends before it begins; swap its times", printable(one.id)));
  }
  if (span.begin < Milliseconds(0) || span.end > latest) {
    refuse(tier, fmt::format("annotation '{}' lies outside 0 to {} ms; move it", printable(one.id), kLatest));
  }
  if (is_symbolic(stereotype) && one.parent.empty()) {
    refuse(tier, fmt::format("annotation '{}' has no parent, from which it would take its time; give it one",
                             printable(one.id)));
  }
}

}  // namespace

std::vector<Attribute> attributes_of(const Tier& tier) {
  return {{"ANNOTATOR", unless_empty(tier.annotator)},
          {"LANG_REF", unless_empty(tier.language)},
          {"LINGUISTIC_TYPE_REF", tier.type},
          {"PARENT_REF", unless_empty(tier.parent)},
          {"PARTICIPANT", unless_empty(tier.participant)},
          {"TIER_ID", tier.id}};
}

std::vector<Attribute> attributes_of(const TierType& type) {
  return {{"CONSTRAINTS", unless_empty(name_of(type.stereotype))},
          {"CONTROLLED_VOCABULARY_REF", unless_empty(type.controlled_vocabulary)},
          {"LINGUISTIC_TYPE_ID", type.id},
          {"TIME_ALIGNABLE", is_symbolic(type.stereotype) ? "false" : "true"}};
}

std::vector<Attribute> attributes_of(const LinkedFile& file) {
  std::optional<std::string> origin;
  if (file.time_origin != Milliseconds(0)) origin = fmt::format("{}", file.time_origin.count());
  return {{file.media ? "MEDIA_URL" : "LINK_URL", file.url},
          {"MIME_TYPE", file.mime_type},
          {file.media ? "RELATIVE_MEDIA_URL" : "RELATIVE_LINK_URL", unless_empty(file.relative_url)},
          {"TIME_ORIGIN", origin}};
}

std::vector<Attribute> attributes_of(const Annotation& annotation, const References& references) {
  if (references.begin_slot.empty()) {
    return {{"ANNOTATION_ID", annotation.id},
            {"ANNOTATION_REF", annotation.parent},
            {"PREVIOUS_ANNOTATION", unless_empty(references.previous)}};
  }
  return {{"ANNOTATION_ID", annotation.id},
          {"TIME_SLOT_REF1", references.begin_slot},
          {"TIME_SLOT_REF2", references.end_slot}};
}

std::string open_tag(std::string_view name, const std::vector<Attribute>& attributes) {
  std::string tag = fmt::format("<{}", name);
  for (const Attribute& one : attributes) {
    if (one.value) tag += fmt::format(" {}=\"{}\"", one.name, escaped(*one.value, one.name));
  }
  return tag;
}

std::string annotation_element(const Annotation& annotation, const References& references, std::string_view line) {
  const std::string_view kind = references.begin_slot.empty() ? "REF_ANNOTATION" : "ALIGNABLE_ANNOTATION";
  const std::string tag = open_tag(kind, attributes_of(annotation, references));
  return fmt::format(
      "<ANNOTATION>{0}            {1}>{0}                <ANNOTATION_VALUE>{2}</ANNOTATION_VALUE>{0}            "
      "</{3}>{0}        </ANNOTATION>",
      line, tag, escaped(annotation.label, "the label"), kind);
}

std::string slot_element(std::string_view id, std::optional<std::int64_t> time) {
  std::optional<std::string> value;
  if (time) value = fmt::format("{}", *time);
  return closed(open_tag("TIME_SLOT", {{"TIME_SLOT_ID", std::string(id)}, {"TIME_VALUE", value}}));
}

std::string type_element(const TierType& type) {
  std::vector<Attribute> attributes = attributes_of(type);
  attributes.insert(attributes.begin() + 2, {"GRAPHIC_REFERENCES", "false"});
  return closed(open_tag("LINGUISTIC_TYPE", attributes));
}

std::string linked_file_element(const LinkedFile& file) {
  return closed(open_tag(file.media ? "MEDIA_DESCRIPTOR" : "LINKED_FILE_DESCRIPTOR", attributes_of(file)));
}

std::string property_element(std::string_view name, std::string_view value) {
  return fmt::format("{}>{}</PROPERTY>", open_tag("PROPERTY", {{"NAME", std::string(name)}}),
                     escaped(value, "the property"));
}

std::string constraint_element(Stereotype stereotype) {
  return closed(open_tag("CONSTRAINT", {{"DESCRIPTION", std::string(description_of(stereotype))},
                                        {"STEREOTYPE", std::string(name_of(stereotype))}}));
}

std::string language_element(std::string_view id) {
  return closed(open_tag("LANGUAGE", {{"LANG_ID", std::string(id)}, {"LANG_LABEL", std::string(id)}}));
}

std::string vocabulary_element(std::string_view id) {
  return closed(open_tag("CONTROLLED_VOCABULARY", {{"CV_ID", std::string(id)}}));
}

CheckedDocument check(AnnotationDocument document, const FileParts* old) {
  CheckedDocument checked;
  checked.last_id = last_number(document);
  for (std::size_t t = 0; old != nullptr && t < old->tiers.size(); ++t) {
    for (const FileAnnotation& one : old->tiers[t].left_out) {
      checked.last_id = std::max(checked.last_id, number_of(one.annotation.id));
    }
  }
  std::unordered_map<std::string_view, std::size_t> tiers;
  std::unordered_map<std::string_view, Stereotype> types;
  for (const TierType& type : document.types) {
    if (type.id.empty() || !types.emplace(type.id, type.stereotype).second) {
      throw Error(ErrorCode::bad_input, fmt::format("tier type '{}': {}; give it an id of its own", printable(type.id),
                                                    type.id.empty() ? "has no id" : "occurs twice"));
    }
  }
  for (std::size_t i = 0; i < document.tiers.size(); ++i) {
    const Tier& tier = document.tiers[i];
    if (tier.id.empty()) refuse(tier, "has no name; give it one");
    if (!tiers.emplace(tier.id, i).second) refuse(tier, "occurs twice; give one of them another name");
  }
  // Tiers without parent or type, and annotations with slots, that are already in the file.
  std::unordered_set<std::string_view> odd;
  std::unordered_set<std::string_view> odd_annotations;
  std::unordered_set<std::string_view> left_out;  // in the file, not in the document
  for (std::size_t t = 0; old != nullptr && t < old->tiers.size(); ++t) {
    const FileTier& tier = old->tiers[t];
    if (tier.parent == kNone || tier.tier.type.empty()) odd.insert(tier.tier.id);
    for (const FileAnnotation& one : tier.annotations) {
      if (one.has_slots()) odd_annotations.insert(one.annotation.id);
    }
    for (const FileAnnotation& one : tier.left_out) left_out.insert(one.annotation.id);
  }
  std::unordered_set<std::string_view> undeclared;
  for (const Tier& tier : document.tiers) {
    const auto parent = tiers.find(tier.parent);
    if (!tier.parent.empty() && parent == tiers.end()) {
      refuse(tier, fmt::format("has the parent '{}', which is not a tier; name one that is", printable(tier.parent)));
    }
    checked.parents.push_back(tier.parent.empty() ? kNone : parent->second);
    const auto type = types.find(tier.type);
    const Stereotype stereotype = type == types.end() ? Stereotype::none : type->second;
    if (tier.type.empty() && !odd.contains(tier.id)) refuse(tier, "has no type; give it one");
    if (tier.parent.empty() && is_symbolic(stereotype) && !odd.contains(tier.id)) {
      refuse(tier, fmt::format("has no parent, though its type '{}' needs one; give it one", printable(tier.type)));
    }
    const bool unknown = type == types.end() && !tier.parent.empty();
    checked.stereotypes.push_back(unknown ? Stereotype::included_in : stereotype);
    if (type == types.end() && !tier.type.empty()) undeclared.insert(tier.type);
  }
  for (std::size_t t = 0; old != nullptr && t < old->tiers.size(); ++t) undeclared.erase(old->tiers[t].tier.type);
  for (std::size_t t = 0; t < document.tiers.size(); ++t) {
    const std::string& type = document.tiers[t].type;
    if (undeclared.erase(type) > 0) document.types.push_back({type, checked.stereotypes[t], {}});
  }

  std::unordered_map<std::string, std::size_t> places;  // annotation -> index on its tier
  std::unordered_map<std::string, std::size_t> tier_of;
  const std::uint64_t before = checked.last_id;
  for (std::size_t t = 0; t < document.tiers.size(); ++t) {
    Tier& tier = document.tiers[t];
    for (std::size_t i = 0; i < tier.annotations.size(); ++i) {
      Annotation& one = tier.annotations[i];
      if (one.id.empty()) one.id = fmt::format("a{}", ++checked.last_id);
      const bool had_slots = odd_annotations.contains(one.id);
      check_annotation(tier, one, had_slots ? Stereotype::none : checked.stereotypes[t]);
      if (left_out.contains(one.id)) {
        refuse(tier, fmt::format("the file has an annotation '{}' that was left out; give this one another id",
                                 printable(one.id)));
      }
      if (!places.emplace(one.id, i).second) {
        refuse(tier, fmt::format("annotation '{}' occurs twice; give one of them another id", printable(one.id)));
      }
      tier_of.emplace(one.id, t);
    }
  }
  checked.parent_annotations.resize(document.tiers.size());
  for (std::size_t t = 0; t < document.tiers.size(); ++t) {
    for (const Annotation& one : document.tiers[t].annotations) {
      std::size_t place = kNone;
      if (!one.parent.empty()) {
        const auto found = places.find(one.parent);
        if (found == places.end() || tier_of.at(one.parent) != checked.parents[t]) {
          refuse(document.tiers[t],
                 fmt::format("annotation '{}' has the parent '{}', which is not on the parent tier; name one that is, "
                             "or remove it too",
                             printable(one.id), printable(one.parent)));
        }
        place = found->second;
      }
      checked.parent_annotations[t].push_back(place);
    }
  }
  if (checked.last_id != before) {
    for (auto& [name, value] : document.properties) {
      if (name == kLastUsedAnnotationId) value = fmt::format("{}", checked.last_id);
    }
  }
  checked.document = std::move(document);
  checked.tier_order = parents_first(checked);
  return checked;
}

}  // namespace signweave::eaf
