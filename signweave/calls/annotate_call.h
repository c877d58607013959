#pragma once

#include <string>
#include <utility>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/calls/field.h"
#include "signweave/calls/import_call.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// Writes tiers into the annotation of a recording and returns the result; stores nothing.
struct AnnotateCall {
  std::string recording;
  std::string if_annotation;  ///< empty: whatever annotation the recording has
};

template <class Visit>
void fields(Visit& visit, AnnotateCall& call) {
  visit(Field{.name = "recording", .help = "name of the recording", .words = "RECORDING", .required = true},
        call.recording);
  visit(Field{.name = "if_annotation",
              .help = "write only into this annotation: annotation_fingerprint of info, or none",
              .check = check_fingerprint,
              .type_name = "FINGERPRINT"},
        call.if_annotation);
}

/// A tier without a parent that is added to a document, after all others.
struct NewTier {
  std::string name;
  std::string type;  ///< a tier type without constraints; if the document has it with some, "TYPE 2", … is taken
  std::string annotator;
  std::string participant;
  /// Distributes overlapping annotations over several tiers, "NAME 1", "NAME 2", …, skipping names that the document
  /// already has.
  bool spread = false;
  std::vector<Annotation> annotations;  ///< labels and spans, in any order
};

/// Everything except the annotations.
template <class Visit>
void fields(Visit& visit, NewTier& tier) {
  visit(Field{.name = "name", .help = "name of the tier", .required = true}, tier.name);
  visit(Field{.name = "type", .help = "its tier type", .required = true}, tier.type);
  visit(Field{.name = "annotator", .help = "who annotated it"}, tier.annotator);
  visit(Field{.name = "participant", .help = "whose signing it describes"}, tier.participant);
  visit(Field{.name = "spread", .help = "put annotations that overlap onto several tiers"}, tier.spread);
}

struct TierChanges {
  std::vector<std::string> remove;  ///< names of tiers; applied before tiers are added
  std::vector<NewTier> tiers;
  std::vector<std::pair<std::string, std::string>> properties;  ///< name, value: set, or added
};

/// Returns the document with the changes. An EAF document keeps its source text, so everything else is written byte for
/// byte. Throws Error{not_found} for a tier to be removed that does not exist, Error{bad_input} for one that has
/// children, a name that occurs twice, and overlapping annotations in one tier.
AnnotationDocument with_tiers(AnnotationDocument document, const TierChanges& changes);

/// Like with_tiers, for the recording's annotation, or for an empty document that links its motion file. Throws
/// Error{not_found} if the recording does not exist, Error{conflict} if its annotation is not `if_annotation`.
AnnotationDocument run(const Database& database, const AnnotateCall& call, const TierChanges& changes);

}  // namespace signweave::calls
