#include "signweave/database/plan_annotation.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/database/import_plan.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/semantic_db/segment_chunk.h"

namespace signweave {
namespace {

/// Throws if the recording has another annotation than the one that is to be replaced.
void check_replaced_annotation(const PlanInput& input) {
  const std::string& expected = *input.options.if_annotation;
  const std::string found = input.known != nullptr ? annotation_fingerprint(*input.known) : "none";
  if (found == expected) return;
  throw Error(ErrorCode::conflict,
              fmt::format("{}: the annotation of recording '{}' is no longer {} but {}; look at what is stored now, "
                          "and import again",
                          input.job.annotation->string(), input.name(), expected, found),
              {{"if_annotation", found}});
}

bool options_name_tiers(const ImportOptions& options) {
  return !options.sign_tiers.empty() || !options.phase_tiers.empty() || !options.phase_labels.empty() ||
         options.no_sign_tier || options.no_phase_tier;
}

/// True if the tiers were given at an earlier import and the document still has them.
bool has_earlier_tiers(const AnnotationDocument& document, const PlanInput& input) {
  if (!input.document_known() || !input.known->tiers_given) return false;
  const TierNames& earlier = input.known->tiers;
  return std::ranges::all_of(earlier.sign_tiers,
                             [&](const auto& tier) { return document.find_tier(tier.id) != nullptr; }) &&
         std::ranges::all_of(earlier.phase_tiers,
                             [&](const auto& tier) { return document.find_tier(tier) != nullptr; });
}

std::string list_of(const std::vector<TierNames::SignTier>& tiers) {
  std::string list;
  for (const TierNames::SignTier& tier : tiers) {
    list += fmt::format("{}'{}'", list.empty() ? "" : ", ", tier.id);
    if (tier.hand != Hand::both) list += fmt::format(" ({} hand)", name_of(tier.hand));
  }
  return list;
}

/// Throws Error{bad_input} if one tier is to hold signs and phases.
void require_apart(const TierNames& names, const std::string& where) {
  for (const TierNames::SignTier& tier : names.sign_tiers) {
    if (std::ranges::find(names.phase_tiers, tier.id) == names.phase_tiers.end()) continue;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{}: tier '{}' is taken for signs and for phases; name another for one of them", where, tier.id),
        {{"sign_tier", ""}, {"phase_tier", ""}});
  }
}

/// Returns the tiers that hold signs and phases: as given; else as given at an earlier import, if the document still
/// has them; else guessed, with a notice.
TierNames tier_names(const AnnotationDocument& document, const PlanInput& input, std::vector<Notice>& notices) {
  const ImportOptions& options = input.options;
  const std::string where = input.job.annotation->string();
  TierNames names{options.sign_tiers, options.phase_tiers, options.phase_labels};
  const bool as_before = has_earlier_tiers(document, input);
  const TierNames other = as_before ? input.known->tiers : guess_tier_names(document);
  if (names.phase_labels.empty() && as_before) names.phase_labels = input.known->tiers.phase_labels;
  const bool no_signs = options.no_sign_tier && names.sign_tiers.empty();
  if (names.sign_tiers.empty() && !no_signs) {
    names.sign_tiers = other.sign_tiers;
    const std::string list = list_of(names.sign_tiers);
    if (list.empty() && as_before) {
      notices.push_back({where, "no tier is taken for signs, as before", {{"sign_tier", ""}}});
    } else if (!as_before) {
      notices.push_back({where, fmt::format("sign tier {} guessed", list)});
    }
  }
  if (names.phase_tiers.empty() && !options.no_phase_tier && !no_signs) {
    names.phase_tiers = other.phase_tiers;
    std::string list;
    for (const std::string& tier : names.phase_tiers) list += fmt::format("{}'{}'", list.empty() ? "" : ", ", tier);
    if (!list.empty() && !as_before) notices.push_back({where, fmt::format("phase tier {} guessed", list)});
  }
  require_apart(names, where);
  return names;
}

void read_document(const PlanInput& input, PlannedAnnotation& planned) {
  using annotation_file::Unsound;
  const Unsound unsound = input.options.strict ? Unsound::refused : Unsound::left_out;
  annotation_file::File file = annotation_file::read(*input.job.annotation, unsound);
  planned.notices = std::move(file.notices);
  planned.tiers = tier_names(file.document, input, planned.notices);
  planned.document = std::move(file.document);
}

/// Plans with the stored document; if it is damaged, with that of the same file, which is then stored again.
void take_stored_document(const PlanInput& input, PlannedAnnotation& planned) {
  planned.tiers = input.known->tiers;
  try {
    planned.document = input.database.document(input.name());
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt || !input.job.annotation) throw;
    planned.document = annotation_file::read(*input.job.annotation).document;
    planned.stores = true;
  }
}

/// Finds the signs. Adds the file to errors and notices about tiers.
void find_signs(const PlanInput& input, PlannedAnnotation& planned) {
  const std::string where = input.job.annotation ? input.job.annotation->string() : input.name();
  try {
    SignsFound found = signs_in(*planned.document, planned.tiers);
    planned.signs = std::move(found.signs);
    for (Notice& notice : found.notices) {
      notice.where = notice.where.empty() ? where : where + ": " + notice.where;
      planned.notices.push_back(std::move(notice));
    }
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", where, error.what()), error.remedies());
  }
}

}  // namespace

PlannedAnnotation plan_annotation(const PlanInput& input) {
  const bool same = input.document_known() && input.known->annotation_fingerprint == input.fingerprints.annotation;
  if (input.options.if_annotation && input.job.annotation && !same) check_replaced_annotation(input);
  PlannedAnnotation planned;
  const bool names_tiers = options_name_tiers(input.options);
  planned.tiers_given = names_tiers || (input.known != nullptr && input.known->tiers_given);
  if (input.job.annotation && (!same || names_tiers)) {
    read_document(input, planned);
    planned.stores = !same || planned.tiers != input.known->tiers;
  } else if (input.document_known()) {
    take_stored_document(input, planned);
  }
  if (planned.document) find_signs(input, planned);
  if (planned.stores) {
    segments_of(*planned.document, planned.signs);  // throws what storing it would throw
  } else {
    planned.notices.clear();
    if (input.known != nullptr) keep_notices(*input.known, input.known->annotation_file, planned.notices);
  }
  return planned;
}

}  // namespace signweave
