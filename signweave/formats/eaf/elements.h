#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/formats/eaf/parse.h"

/// EAF elements as text, for the two writers: generate.h and edit.h.
namespace signweave::eaf {

/// An attribute of an element to be written; without a value it is left out.
struct Attribute {
  std::string name;
  std::optional<std::string> value;  ///< not escaped
};

/// The references of an annotation.
struct References {
  std::string begin_slot;  ///< ids; empty for an annotation without slots
  std::string end_slot;
  std::string previous;  ///< the preceding annotation under the same parent, if its tier is a symbolic subdivision
};

/// The attributes of an element in the order in which ELAN writes them (by name).
std::vector<Attribute> attributes_of(const Tier& tier);
std::vector<Attribute> attributes_of(const TierType& type);
std::vector<Attribute> attributes_of(const LinkedFile& file);
std::vector<Attribute> attributes_of(const Annotation& annotation, const References& references);

/// "<NAME A="x" B="y"" without the closing bracket.
std::string open_tag(std::string_view name, const std::vector<Attribute>& attributes);

/// Complete elements, with their inner lines indented for their position; `line` is the line end.
std::string annotation_element(const Annotation& annotation, const References& references, std::string_view line);
std::string slot_element(std::string_view id, std::optional<std::int64_t> time);
std::string type_element(const TierType& type);
std::string linked_file_element(const LinkedFile& file);
std::string property_element(std::string_view name, std::string_view value);
std::string constraint_element(Stereotype stereotype);
std::string language_element(std::string_view id);
std::string vocabulary_element(std::string_view id);

inline constexpr Stereotype kConstraints[] = {Stereotype::time_subdivision, Stereotype::symbolic_subdivision,
                                              Stereotype::symbolic_association, Stereotype::included_in};
inline constexpr std::string_view kLastUsedAnnotationId = "lastUsedAnnotationId";

/// The tiers of a document that can be written, with values that are needed repeatedly.
struct CheckedDocument {
  AnnotationDocument document;          ///< every annotation has an id, and every tier's type is declared
  std::vector<std::size_t> tier_order;  ///< parents before children, otherwise as given
  std::vector<std::size_t> parents;     ///< [tier], index of the parent tier or kNone
  std::vector<Stereotype> stereotypes;  ///< [tier]
  /// [tier][annotation] index on the parent tier, or kNone
  std::vector<std::vector<std::size_t>> parent_annotations;
  std::uint64_t last_id = 0;  ///< the greatest number in an annotation id
};

/// Gives ids to annotations that have none, and checks that EAF can hold the document. Throws Error{bad_input, "tier
/// 'X': …"} for two tiers, types or annotations with one name, a missing parent, a cycle, a span that is reversed,
/// negative or too late. Oddities that `old`, the file that the document was read from, already has are allowed.
CheckedDocument check(AnnotationDocument document, const FileParts* old = nullptr);

}  // namespace signweave::eaf
