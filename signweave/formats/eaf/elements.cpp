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

std::uint64_t last_number(const AnnotationDocument& document, const FileParts* old) {
  std::uint64_t last = 0;
  for (const Tier& tier : document.tiers) {
    for (const Annotation& one : tier.annotations) last = std::max(last, number_of(one.id));
  }
  for (const auto& [name, value] : document.properties) {
    if (name == kLastUsedAnnotationId) last = std::max(last, number_of("a" + value));
  }
  for (std::size_t t = 0; old != nullptr && t < old->tiers.size(); ++t) {
    for (const FileAnnotation& one : old->tiers[t].left_out) last = std::max(last, number_of(one.annotation.id));
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

/// What the file of a document already has and a new document may not: it is not refused again.
struct FileOddities {
  std::unordered_set<std::string_view> tiers;        ///< without parent or type
  std::unordered_set<std::string_view> annotations;  ///< with slots
  std::unordered_set<std::string_view> left_out;     ///< annotations in the file that are not in the document
};

FileOddities oddities_of(const FileParts* old) {
  FileOddities odd;
  for (std::size_t t = 0; old != nullptr && t < old->tiers.size(); ++t) {
    const FileTier& tier = old->tiers[t];
    if (tier.parent == kNone || tier.tier.type.empty()) odd.tiers.insert(tier.tier.id);
    for (const FileAnnotation& one : tier.annotations) {
      if (one.has_slots()) odd.annotations.insert(one.annotation.id);
    }
    for (const FileAnnotation& one : tier.left_out) odd.left_out.insert(one.annotation.id);
  }
  return odd;
}

struct DocumentNames {
  std::unordered_map<std::string, std::size_t> tiers;  ///< index of a tier
  std::unordered_map<std::string, Stereotype> types;
};

/// Throws for two tiers or types of one name, or one without a name.
DocumentNames names_of(const AnnotationDocument& document) {
  DocumentNames names;
  for (const TierType& type : document.types) {
    if (type.id.empty() || !names.types.emplace(type.id, type.stereotype).second) {
      throw Error(ErrorCode::bad_input, fmt::format("tier type '{}': {}; give it an id of its own", printable(type.id),
                                                    type.id.empty() ? "has no id" : "occurs twice"));
    }
  }
  for (std::size_t i = 0; i < document.tiers.size(); ++i) {
    const Tier& tier = document.tiers[i];
    if (tier.id.empty()) refuse(tier, "has no name; give it one");
    if (!names.tiers.emplace(tier.id, i).second) refuse(tier, "occurs twice; give one of them another name");
  }
  return names;
}

/// Adds the parent and the stereotype of the next tier.
void check_tier(const Tier& tier, const DocumentNames& names, const FileOddities& odd, CheckedDocument& checked) {
  const auto parent = names.tiers.find(tier.parent);
  if (!tier.parent.empty() && parent == names.tiers.end()) {
    refuse(tier, fmt::format("has the parent '{}', which is not a tier; name one that is", printable(tier.parent)));
  }
  checked.parents.push_back(tier.parent.empty() ? kNone : parent->second);
  const auto type = names.types.find(tier.type);
  const Stereotype stereotype = type == names.types.end() ? Stereotype::none : type->second;
  const bool is_odd = odd.tiers.contains(tier.id);
  if (tier.type.empty() && !is_odd) refuse(tier, "has no type; give it one");
  if (tier.parent.empty() && is_symbolic(stereotype) && !is_odd) {
    refuse(tier, fmt::format("has no parent, though its type '{}' needs one; give it one", printable(tier.type)));
  }
  const bool unknown = type == names.types.end() && !tier.parent.empty();
  checked.stereotypes.push_back(unknown ? Stereotype::included_in : stereotype);
}

/// Declares the types of tiers that the document does not declare, unless the file uses them undeclared.
void declare_types(const DocumentNames& names, const FileParts* old, CheckedDocument& checked) {
  std::unordered_set<std::string> undeclared;
  for (const Tier& tier : checked.document.tiers) {
    if (!tier.type.empty() && !names.types.contains(tier.type)) undeclared.insert(tier.type);
  }
  for (std::size_t t = 0; old != nullptr && t < old->tiers.size(); ++t) undeclared.erase(old->tiers[t].tier.type);
  for (std::size_t t = 0; t < checked.document.tiers.size(); ++t) {
    const std::string& type = checked.document.tiers[t].type;
    if (undeclared.erase(type) > 0) checked.document.types.push_back({type, checked.stereotypes[t], {}});
  }
}

/// Where an annotation is in its document.
struct AnnotationPlace {
  std::size_t tier = 0;
  std::size_t index = 0;  ///< on its tier
};
using AnnotationPlaces = std::unordered_map<std::string, AnnotationPlace>;  ///< by the annotation's id

/// Gives ids to the annotations that have none, and checks all.
AnnotationPlaces number_annotations(const FileOddities& odd, CheckedDocument& checked) {
  AnnotationPlaces places;
  for (std::size_t t = 0; t < checked.document.tiers.size(); ++t) {
    Tier& tier = checked.document.tiers[t];
    for (std::size_t i = 0; i < tier.annotations.size(); ++i) {
      Annotation& one = tier.annotations[i];
      if (one.id.empty()) one.id = fmt::format("a{}", ++checked.last_id);
      const bool had_slots = odd.annotations.contains(one.id);
      check_annotation(tier, one, had_slots ? Stereotype::none : checked.stereotypes[t]);
      if (odd.left_out.contains(one.id)) {
        refuse(tier, fmt::format("the file has an annotation '{}' that was left out; give this one another id",
                                 printable(one.id)));
      }
      if (!places.emplace(one.id, AnnotationPlace{t, i}).second) {
        refuse(tier, fmt::format("annotation '{}' occurs twice; give one of them another id", printable(one.id)));
      }
    }
  }
  return places;
}

/// Finds the parent of each annotation on the parent tier.
void find_parents(const AnnotationPlaces& places, CheckedDocument& checked) {
  checked.parent_annotations.resize(checked.document.tiers.size());
  for (std::size_t t = 0; t < checked.document.tiers.size(); ++t) {
    const Tier& tier = checked.document.tiers[t];
    for (const Annotation& one : tier.annotations) {
      std::size_t index = kNone;
      if (!one.parent.empty()) {
        const auto found = places.find(one.parent);
        if (found == places.end() || found->second.tier != checked.parents[t]) {
          refuse(tier,
                 fmt::format("annotation '{}' has the parent '{}', which is not on the parent tier; name one that "
                             "is, or remove it too",
                             printable(one.id), printable(one.parent)));
        }
        index = found->second.index;
      }
      checked.parent_annotations[t].push_back(index);
    }
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
  checked.document = std::move(document);
  checked.last_id = last_number(checked.document, old);
  const std::uint64_t before = checked.last_id;
  const FileOddities odd = oddities_of(old);
  const DocumentNames names = names_of(checked.document);
  for (const Tier& tier : checked.document.tiers) check_tier(tier, names, odd, checked);
  declare_types(names, old, checked);
  const AnnotationPlaces places = number_annotations(odd, checked);
  find_parents(places, checked);
  if (checked.last_id != before) {
    for (auto& [name, value] : checked.document.properties) {
      if (name == kLastUsedAnnotationId) value = fmt::format("{}", checked.last_id);
    }
  }
  checked.tier_order = parents_first(checked);
  return checked;
}

}  // namespace signweave::eaf
