#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// How a tier relates to its parent (the CONSTRAINT stereotypes of EAF).
enum class Stereotype {
  none,                  ///< no parent
  time_subdivision,      ///< fills the parent annotation without gaps; has its own times
  included_in,           ///< inside the parent annotation, gaps allowed; has its own times
  symbolic_subdivision,  ///< divides the parent annotation in order; has no times
  symbolic_association,  ///< one per parent annotation, whose times it takes
};

/// The type of a tier (EAF's LINGUISTIC_TYPE).
struct TierType {
  std::string id;
  Stereotype stereotype = Stereotype::none;
  std::string controlled_vocabulary;  ///< its id; empty if there is none
  friend bool operator==(const TierType&, const TierType&) = default;
};

/// A label over a time span on one tier.
struct Annotation {
  std::string id;       ///< unique in the document ("a17"); empty in a new annotation: the writer assigns one
  std::string label;    ///< verbatim UTF-8, white space included; compare with match_form()
  TimeSpan span;        ///< document time; if it has none, from its parent or neighbours, as ELAN shows it
  std::string parent;   ///< id of the annotation on the parent tier; empty if the tier has no parent
  bool aligned = true;  ///< both ends have their own time in the file
  friend bool operator==(const Annotation&, const Annotation&) = default;
};

/// A named row of annotations in time order, which never overlap.
struct Tier {
  std::string id;      ///< its name, verbatim
  std::string type;    ///< id of a TierType of the document
  std::string parent;  ///< id of the parent tier; empty if there is none
  std::string participant;
  std::string annotator;
  std::string language;  ///< EAF's LANG_REF
  std::vector<Annotation> annotations;
  friend bool operator==(const Tier&, const Tier&) = default;
};

/// A media file, or another linked file, that a document refers to.
struct LinkedFile {
  std::string url;           ///< as written, often file:///…
  std::string relative_url;  ///< may be empty
  std::string mime_type;
  Milliseconds time_origin{0};  ///< media time = annotation time + origin, so the file's frame 0 is at −origin
  bool media = true;            ///< MEDIA_DESCRIPTOR; false for a LINKED_FILE_DESCRIPTOR
  friend bool operator==(const LinkedFile&, const LinkedFile&) = default;
};

/// The format that a document was read from.
enum class SourceFormat { eaf, anvil };

/// The modelled content of one annotation file. Content that is not modelled stays in `source` and is preserved when
/// the document is written again (formats/eaf.h).
struct AnnotationDocument {
  std::string author;
  std::string date;            ///< ISO 8601, as written
  std::string format = "3.0";  ///< EAF's FORMAT
  std::vector<LinkedFile> linked_files;
  std::vector<std::pair<std::string, std::string>> properties;  ///< name, value; in order, names may repeat
  std::vector<TierType> types;
  std::vector<Tier> tiers;
  std::string source;  ///< the file's bytes as read; empty for a new document
  SourceFormat source_format = SourceFormat::eaf;
  std::string specification;  ///< ANVIL: the bytes of the specification it was read with; else empty

  const Tier* find_tier(std::string_view id) const noexcept {
    for (const Tier& tier : tiers) {
      if (tier.id == id) return &tier;
    }
    return nullptr;
  }
  const TierType* find_type(std::string_view id) const noexcept {
    for (const TierType& type : types) {
      if (type.id == id) return &type;
    }
    return nullptr;
  }
  friend bool operator==(const AnnotationDocument&, const AnnotationDocument&) = default;
};

}  // namespace signweave
