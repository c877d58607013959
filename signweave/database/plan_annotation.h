#pragma once

#include <optional>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/database/plan_input.h"

/// Internal to `database`: the part of an import plan about the annotation.
namespace signweave {

/// The annotation of the recording after the import.
struct PlannedAnnotation {
  std::optional<AnnotationDocument> document;  ///< none: no annotation
  TierNames tiers;
  bool tiers_given = false;     ///< now or at an earlier import
  bool stores = false;          ///< the document or the choice of its tiers is new
  std::vector<Sign> signs;      ///< in the document
  std::vector<Notice> notices;  ///< about the file, if it was read; else the stored ones about it
};

/// Plans the annotation. Throws Error{conflict} if the recording has another annotation than the one to be replaced,
/// Error{bad_input} or Error{not_found} for tiers that do not fit the document, and as the readers of annotation and
/// Database::document do.
PlannedAnnotation plan_annotation(const PlanInput& input);

}  // namespace signweave
