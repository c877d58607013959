#pragma once

#include <span>
#include <string>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// The annotation of a recording with the answers of a query beside it: tiers "query 1", "query 2", … (names that the
/// document has are passed over), no two answers of one tier overlapping, labels their names. Everything else of an EAF
/// is written byte for byte.
struct QueryDocument {
  std::string recording;
  AnnotationDocument document;
};

/// One for each recording that has an answer, in the order of their first ones. Throws Error{corrupt}.
std::vector<QueryDocument> documents_of(const Database& database, std::span<const Segment> answers);

}  // namespace signweave::calls
