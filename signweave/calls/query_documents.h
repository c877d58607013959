#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// The annotation of a recording with the answers of a query added to it as tiers "query 1", "query 2", … (names that
/// the document already has are skipped). No two answers in a tier overlap; the labels are the answers' names.
/// Everything else of an EAF is written byte for byte.
struct QueryDocument {
  std::string recording;
  AnnotationDocument document;
};

/// One document for each recording with an answer, in the order of their first answers. Throws Error{corrupt}.
std::vector<QueryDocument> documents_of(const Database& database, std::span<const Segment> answers);

}  // namespace signweave::calls
