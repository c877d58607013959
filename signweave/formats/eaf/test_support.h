#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/atomic_file.h"
#include "signweave/formats/eaf/eaf.h"

namespace signweave {

inline void PrintTo(const Tier& tier, std::ostream* out) {
  *out << fmt::format("\ntier '{}' type '{}' parent '{}' by '{}' of '{}' in '{}'", tier.id, tier.type, tier.parent,
                      tier.annotator, tier.participant, tier.language);
  for (const Annotation& one : tier.annotations) {
    *out << fmt::format("\n  {} {}-{} '{}' <{}{}", one.id, one.span.begin.count(), one.span.end.count(), one.label,
                        one.parent, one.aligned ? "" : " unaligned");
  }
}

inline void PrintTo(const AnnotationDocument& document, std::ostream* out) {
  *out << fmt::format("author '{}' date '{}' format '{}'", document.author, document.date, document.format);
  for (const LinkedFile& file : document.linked_files) {
    *out << fmt::format("\nfile {} {} {} {} {}", file.media ? "media" : "linked", file.url, file.relative_url,
                        file.mime_type, file.time_origin.count());
  }
  for (const auto& [name, value] : document.properties) *out << fmt::format("\nproperty {}={}", name, value);
  for (const TierType& type : document.types) {
    *out << fmt::format("\ntype '{}' {} '{}'", type.id, static_cast<int>(type.stereotype), type.controlled_vocabulary);
  }
  for (const Tier& tier : document.tiers) PrintTo(tier, out);
}

}  // namespace signweave

/// Small EAF texts for the tests of this folder.
namespace signweave::eaf::testing_support {

inline std::filesystem::path testdata(std::string_view folder) {
  return std::filesystem::path(SIGNWEAVE_SOURCE_DIR) / "testdata" / folder;
}

inline std::string testfile(std::string_view name) {
  return read_file(testdata("eaf") / name);
}

/// An annotation with slots "tsN".
inline std::string alignable(std::string_view id, int begin, int end, std::string_view label = "x") {
  return fmt::format(
      "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"{}\" TIME_SLOT_REF1=\"ts{}\" TIME_SLOT_REF2=\"ts{}\">"
      "<ANNOTATION_VALUE>{}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>\n",
      id, begin, end, label);
}

inline std::string reference(std::string_view id, std::string_view parent, std::string_view previous = {}) {
  const std::string before = previous.empty() ? "" : fmt::format(" PREVIOUS_ANNOTATION=\"{}\"", previous);
  return fmt::format(
      "<ANNOTATION><REF_ANNOTATION ANNOTATION_ID=\"{0}\" ANNOTATION_REF=\"{1}\"{2}>"
      "<ANNOTATION_VALUE>{0}</ANNOTATION_VALUE></REF_ANNOTATION></ANNOTATION>\n",
      id, parent, before);
}

/// A tier whose type is one of the lower-case names "root", "fill", "within", "divide", "tag".
inline std::string tier(std::string_view id, std::string_view type, std::string_view parent,
                        std::string_view annotations) {
  const std::string above = parent.empty() ? "" : fmt::format(" PARENT_REF=\"{}\"", parent);
  return fmt::format("<TIER LINGUISTIC_TYPE_REF=\"{}\"{} TIER_ID=\"{}\">\n{}</TIER>\n", type, above, id, annotations);
}

/// A document with slots ts1, ts2 … at these times (none: unaligned).
inline std::string document(const std::vector<std::optional<int>>& slots, std::string_view tiers) {
  std::string text = "<ANNOTATION_DOCUMENT FORMAT=\"3.0\">\n<TIME_ORDER>\n";
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::string value = slots[i] ? fmt::format(" TIME_VALUE=\"{}\"", *slots[i]) : std::string();
    text += fmt::format("<TIME_SLOT TIME_SLOT_ID=\"ts{}\"{}/>\n", i + 1, value);
  }
  text += "</TIME_ORDER>\n";
  text += tiers;
  return text +
         "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"root\"/>\n"
         "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"fill\" CONSTRAINTS=\"Time_Subdivision\"/>\n"
         "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"within\" CONSTRAINTS=\"Included_In\"/>\n"
         "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"divide\" CONSTRAINTS=\"Symbolic_Subdivision\"/>\n"
         "<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"tag\" CONSTRAINTS=\"Symbolic_Association\"/>\n"
         "</ANNOTATION_DOCUMENT>\n";
}

/// "a1 0-100, a2 100-200": a tier's annotations with their times.
inline std::string times(const AnnotationDocument& document, std::string_view tier_id) {
  std::string text;
  const Tier* tier = document.find_tier(tier_id);
  if (tier == nullptr) return "no tier";
  for (const Annotation& one : tier->annotations) {
    text += fmt::format("{}{} {}-{}", text.empty() ? "" : ", ", one.id, one.span.begin.count(), one.span.end.count());
  }
  return text;
}

/// "a1<p1, a2<p1": a tier's annotations with their parents.
inline std::string parents(const AnnotationDocument& document, std::string_view tier_id) {
  std::string text;
  for (const Annotation& one : document.find_tier(tier_id)->annotations) {
    text += fmt::format("{}{}<{}", text.empty() ? "" : ", ", one.id, one.parent);
  }
  return text;
}

/// The bytes of a tier in a file; the tier's name must need no escaping.
inline std::string tier_bytes(const std::string& text, std::string_view id) {
  const std::size_t name = text.find(fmt::format("TIER_ID=\"{}\"", id));
  if (name == std::string::npos) return "no tier";
  const std::size_t begin = text.rfind("<TIER", name);
  const std::size_t tag_end = text.find('>', name);
  if (text[tag_end - 1] == '/') return text.substr(begin, tag_end + 1 - begin);
  return text.substr(begin, text.find("</TIER>", name) - begin);
}

/// A document without the bytes it was read from.
inline AnnotationDocument without_source(AnnotationDocument document) {
  document.source.clear();
  return document;
}

inline AnnotationDocument reread(const AnnotationDocument& document) {
  return read_text("written.eaf", write_text(document)).document;
}

/// testdata/eaf/constraints.eaf, which uses every feature of EAF.
inline AnnotationDocument constraints() {
  return read_text("constraints.eaf", testfile("constraints.eaf")).document;
}

inline Tier& tier_of(AnnotationDocument& document, std::string_view id) {
  return *std::find_if(document.tiers.begin(), document.tiers.end(), [&](const Tier& tier) { return tier.id == id; });
}

inline Annotation& annotation_of(AnnotationDocument& document, std::string_view id) {
  for (Tier& tier : document.tiers) {
    for (Annotation& one : tier.annotations) {
      if (one.id == id) return one;
    }
  }
  throw std::out_of_range(std::string(id));
}

}  // namespace signweave::eaf::testing_support
