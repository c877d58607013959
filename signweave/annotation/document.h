#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/core/time.h"

namespace signweave {

/// The rule that ties a tier to its parent (EAF's CONSTRAINT stereotypes).
enum class Stereotype {
  none,                  ///< a tier of its own: no parent
  time_subdivision,      ///< fills its parent annotation without gaps; own times
  included_in,           ///< inside its parent annotation, gaps allowed; own times
  symbolic_subdivision,  ///< divides its parent annotation in order; no times of its own
  symbolic_association,  ///< one to one with its parent annotation; takes its time
};

/// What kind a tier is (EAF's LINGUISTIC_TYPE).
struct TierType {
  std::string id;
  Stereotype stereotype = Stereotype::none;
  std::string controlled_vocabulary;  ///< its id, empty where there is none
  friend bool operator==(const TierType&, const TierType&) = default;
};

/// A label over a time span on one tier.
struct Annotation {
  std::string id;      ///< unique in the document ("a17"); empty in a new one, a writer then gives one
  std::string label;   ///< verbatim, UTF-8, blanks and all; compare with match_form()
  TimeSpan span;       ///< document time. Without times of its own: as ELAN shows it, from its parent or its neighbours
  std::string parent;  ///< id of the annotation on the parent tier; empty on a tier without parent
  bool aligned = true;  ///< both ends have a time of their own in the file
  friend bool operator==(const Annotation&, const Annotation&) = default;
};

/// A named row of annotations, in time order; they never overlap.
struct Tier {
  std::string id;      ///< its name, verbatim
  std::string type;    ///< id of a TierType of the document
  std::string parent;  ///< id of the parent tier; empty where there is none
  std::string participant;
  std::string annotator;
  std::string language;  ///< EAF's LANG_REF
  std::vector<Annotation> annotations;
  friend bool operator==(const Tier&, const Tier&) = default;
};

/// A media file that a document names, or another linked file.
struct LinkedFile {
  std::string url;           ///< as written, often file:///…
  std::string relative_url;  ///< may be empty
  std::string mime_type;
  Milliseconds time_origin{0};  ///< media time = annotation time + origin, so frame 0 of the file is at −origin
  bool media = true;            ///< MEDIA_DESCRIPTOR; false for a LINKED_FILE_DESCRIPTOR
  friend bool operator==(const LinkedFile&, const LinkedFile&) = default;
};

/// The format of the bytes that a document was read from.
enum class SourceFormat { eaf, anvil };

/// Everything in one annotation file that we model. What we do not model stays in `source` and is carried through when
/// the document is written again (formats/eaf.h).
struct AnnotationDocument {
  std::string author;
  std::string date;            ///< ISO 8601, as written
  std::string format = "3.0";  ///< EAF's FORMAT
  std::vector<LinkedFile> linked_files;
  std::vector<std::pair<std::string, std::string>> properties;  ///< name, value; in order, names may repeat
  std::vector<TierType> types;
  std::vector<Tier> tiers;
  std::string source;  ///< the file's bytes as read; empty for a document made by us
  SourceFormat source_format = SourceFormat::eaf;
  std::string specification;  ///< of ANVIL: the bytes of the specification that it was read with; else empty

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
