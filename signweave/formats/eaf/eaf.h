#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/core/error.h"

/// EAF (ELAN annotation format) 2.6 to 3.0; a newer version is read as 3.0, with a notice. Time slots are known here
/// only.
///
/// Encodings: UTF-8 with or without a byte order mark, UTF-16, UTF-32, ISO-8859-1. Entities that a DOCTYPE defines are
/// not expanded: a label "&lol;" is these five letters.
namespace signweave::eaf {

struct File {
  AnnotationDocument document;
  std::vector<Notice> notices;  ///< oddities that stopped nothing: coincident slots, a tier type that is missing, …
};

/// What becomes of a file in which single annotations are unsound: one that ends before it begins, uses a slot that is
/// missing, or refers to an annotation that is missing or not on the parent tier.
enum class Unsound {
  left_out,  ///< the annotation is left out, with a notice; so is what refers to it. `source` keeps its bytes
  refused,   ///< the file is refused
};

/// Reads a document. Times of unaligned slots are as ELAN shows them: inside one parent and on one tier, each run of
/// slots without times is spread evenly between its neighbours, in whole milliseconds rounded down; symbolic
/// subdivisions share their parent's span evenly, in the order of their chain; symbolic associations take it
/// (eaf_times.h has the whole reading, also of which annotation is whose parent). Throws Error{bad_input,
/// "FILE:LINE: …"} for anything that is no EAF document: two elements of one id, a cycle of tiers, a time that is no
/// number of milliseconds from 0 to 10^12, what is Unsound::refused; Error{unsupported} for TIME_UNITS other than
/// milliseconds.
File read(const std::filesystem::path& path, Unsound unsound = Unsound::left_out);
/// The same from text; `name` stands for the file in errors.
File read_text(std::string name, std::string_view text, Unsound unsound = Unsound::left_out);

/// The document as an EAF file. Where it is as it was read, the very bytes of `document.source`; where it was changed,
/// the bytes of everything that was not, with new elements only for what was. A document without source is written as
/// EAF 3.0 that ELAN opens.
///
/// In a changed document tiers and annotations are known again by their ids. A changed element keeps the attributes
/// that we do not model, such as EXT_REF, LANG_REF and CVE_REF (so a new label may stand beside the CVE_REF of the old
/// one). Annotations that were left out stay where they are. TIME_ORDER stays sorted, slots that nobody uses any more
/// go. Losses: a text in another encoding than UTF-8
/// becomes UTF-8; a new annotation with `aligned` false on a tier with times gets the times of its span; the span of an
/// annotation without times of its own, and `parent` of one with times, are not written, as EAF derives both.
///
/// Annotations without id get one ("a1" …), and the property lastUsedAnnotationId follows. Without source: tiers are
/// written parents first, linked files media first; an empty date becomes 1970-01-01, since the schema wants one and
/// the same document shall give the same bytes; unaligned annotations get unaligned slots where ELAN would show them at
/// their times, else times; vocabularies and languages that are referred to are declared, empty.
///
/// Throws Error{bad_input, "tier 'X': …"} for what EAF cannot hold: two tiers or annotations of one id, a parent that
/// is not there, a span that is reversed or outside 0 to 10^12 ms, control characters, text that is not UTF-8.
std::string write_text(const AnnotationDocument& document);
/// The same to a file, whole or not at all.
void write(const std::filesystem::path& path, const AnnotationDocument& document);

}  // namespace signweave::eaf
