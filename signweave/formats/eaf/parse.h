#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/core/error.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/formats/eaf/xml.h"

namespace signweave::eaf {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The latest time allowed in a file, in milliseconds (some 31 years).
constexpr std::int64_t kLatest = 1'000'000'000'000;

/// A boundary that annotations share.
struct Slot {
  std::string_view id;
  std::optional<std::int64_t> time;  ///< milliseconds; none: unaligned
  std::size_t rank = 0;              ///< its position in ELAN's order of slots, see times.h
  pugi::xml_node element;
};

/// An annotation with its links to the file.
struct FileAnnotation {
  Annotation annotation;
  pugi::xml_node element;     ///< the ALIGNABLE_ANNOTATION or REF_ANNOTATION inside its ANNOTATION
  std::size_t begin = kNone;  ///< its slots; kNone for a REF_ANNOTATION
  std::size_t end = kNone;
  std::string_view previous;  ///< PREVIOUS_ANNOTATION

  bool has_slots() const noexcept { return begin != kNone; }
};

struct FileTier {
  Tier tier;  ///< without its annotations
  pugi::xml_node element;
  std::size_t parent = kNone;  ///< index of the parent tier
  Stereotype stereotype = Stereotype::none;
  std::vector<FileAnnotation> annotations;  ///< in time order
  std::vector<FileAnnotation> left_out;     ///< unsound ones, of which only id and element are used
};

/// A parsed EAF file. Borrows from its Xml, which must outlive it.
struct FileParts {
  AnnotationDocument head;  ///< everything but tiers and source
  std::vector<Slot> slots;  ///< in file order
  std::vector<FileTier> tiers;
  std::vector<Notice> notices;
};

/// Parses a file and gives every annotation its span and parent. Throws Error{bad_input, "FILE:LINE: …"}.
FileParts parse(const Xml& xml, Unsound unsound);

/// Leaves an annotation of a tier out with a notice, or refuses the file: "WHAT; REPAIR".
void leave_out(const Xml& xml, Unsound unsound, FileParts& parts, FileTier& tier, FileAnnotation annotation,
               std::string_view what, std::string_view repair);

/// EAF's names of the stereotypes: "Time_Subdivision", …; empty for none.
std::string_view name_of(Stereotype stereotype) noexcept;

inline bool is_symbolic(Stereotype stereotype) noexcept {
  return stereotype == Stereotype::symbolic_subdivision || stereotype == Stereotype::symbolic_association;
}

}  // namespace signweave::eaf
