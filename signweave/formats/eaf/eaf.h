#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/core/error.h"

/// EAF (ELAN annotation format) 2.6 to 3.0; a newer version is read as 3.0, with a notice. Time slots are confined to
/// this module.
///
/// Encodings: UTF-8 with or without a byte order mark, UTF-16, UTF-32, ISO-8859-1. Entities defined by a DOCTYPE are
/// not expanded: a label "&lol;" is these five characters.
namespace signweave::eaf {

struct File {
  AnnotationDocument document;
  std::vector<Notice> notices;  ///< oddities that did not prevent reading: coincident slots, a missing tier type, …
};

/// The treatment of single unsound annotations: those that end before they begin, use a missing slot, or refer to an
/// annotation that is missing or not on the parent tier.
enum class Unsound {
  left_out,  ///< the annotation is left out, with a notice, and so is what refers to it; `source` preserves its bytes
  refused,   ///< the file is refused
};

/// Reads a document. Times of unaligned slots are as ELAN shows them: inside one parent and on one tier, each run of
/// slots without times is spread evenly between its neighbours, in whole milliseconds rounded down; symbolic
/// subdivisions divide their parent's span evenly, in the order of their chain; symbolic associations take it
/// (eaf/times.h has the full rules, also for which annotation is the parent of which). Throws Error{bad_input,
/// "FILE:LINE: …"} if the file is not an EAF document: two elements with one id, a cycle of tiers, a time that is not a
/// number of milliseconds from 0 to 10^12, or anything covered by Unsound::refused; Error{unsupported} for TIME_UNITS
/// other than milliseconds.
File read(const std::filesystem::path& path, Unsound unsound = Unsound::left_out);
/// Reads from text; `name` is the file name in errors.
File read_text(std::string name, std::string_view text, Unsound unsound = Unsound::left_out);

/// Returns the document as an EAF file. If it is unchanged since it was read, the exact bytes of `document.source`; if
/// it was changed, new elements only for what changed, and the original bytes for the rest. A document without source
/// is written as EAF 3.0 that ELAN opens.
///
/// In a changed document, tiers and annotations are matched by their ids. A changed element keeps the attributes that
/// we do not model, such as EXT_REF, LANG_REF and CVE_REF (so a new label may occur together with the CVE_REF of the
/// old one). Annotations that were left out stay where they are. TIME_ORDER stays sorted; slots that are no longer used
/// are removed. Losses: text in an encoding other than UTF-8 becomes UTF-8; a new annotation with `aligned` false on a
/// tier with times gets the times of its span; the span of an annotation without times of its own, and the `parent` of
/// one with times, are not written, as EAF derives both.
///
/// Annotations without an id get one ("a1" …), and the property lastUsedAnnotationId is updated. Without source: tiers
/// are written parents first, linked files media first; an empty date becomes 1970-01-01, because the schema requires
/// one and the same document must give the same bytes; unaligned annotations get unaligned slots if ELAN would show
/// those at their times, otherwise times; vocabularies and languages that are referred to are declared, empty.
///
/// Throws Error{bad_input, "tier 'X': …"} for what EAF cannot hold: two tiers or annotations with one id, a missing
/// parent, a span that is reversed or outside 0 to 10^12 ms, control characters, text that is not UTF-8.
std::string write_text(const AnnotationDocument& document);
/// Writes the same to a file, atomically.
void write(const std::filesystem::path& path, const AnnotationDocument& document);

}  // namespace signweave::eaf
