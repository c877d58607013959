#include "signweave/calls/inspect_call.h"

#include <optional>
#include <set>

#include "signweave/calls/import_call.h"
#include "signweave/calls/info_call.h"
#include "signweave/database/import_plan.h"

namespace signweave::calls {

namespace {

/// A folder that is removed in every case.
struct Scratch {
  std::filesystem::path folder;
  explicit Scratch(std::filesystem::path path) : folder(std::move(path)) {}
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

OrNull<std::string> file_name_of(const std::optional<std::filesystem::path>& path) {
  return {path ? std::optional(path->filename().string()) : std::nullopt};
}

/// The tiers, and which were taken as signs and phases.
std::vector<TierAnswer> tiers_of(const AnnotationDocument& document, const TierNames& names) {
  std::vector<TierAnswer> tiers;
  for (const Tier& tier : document.tiers) {
    std::set<std::string_view> labels;
    for (const Annotation& annotation : tier.annotations) labels.insert(annotation.label);
    const auto sign = std::ranges::find(names.sign_tiers, tier.id, &TierNames::SignTier::id);
    const bool signs = sign != names.sign_tiers.end();
    const bool phases = std::ranges::find(names.phase_tiers, tier.id) != names.phase_tiers.end();
    tiers.push_back({.tier = tier.id,
                     .parent = null_unless(!tier.parent.empty(), tier.parent),
                     .annotations = tier.annotations.size(),
                     .labels = labels.size(),
                     .role = signs    ? "signs"
                             : phases ? "phases"
                                      : "",
                     .hand = name_of(signs ? sign->hand : Hand::both)});
  }
  return tiers;
}

/// The content of a recording that was imported into the scratch database.
InspectedContent content_of(const Database& scratch, const ImportReport& imported) {
  InspectedContent content{.details = run(scratch, RecordingCall{imported.name}),
                           .signs = imported.signs,
                           .not_measured = imported.not_measured,
                           .notices = imported.notices,
                           .joints = {},
                           .tiers = {}};
  const RecordingInfo& info = content.details.info;
  if (content.details.skeleton) {
    for (const Joint& joint : content.details.skeleton->joints()) content.joints.push_back(joint.name);
  }
  if (info.document != 0) content.tiers = tiers_of(scratch.document(info.name), info.tiers);
  return content;
}

PartChanges changes_of(const ImportChanges& changes) {
  PartChanges parts;
  const auto add = [&](const char* part, PartChange change) {
    if (change == PartChange::added) parts.emplace_back(part, "added");
    if (change == PartChange::replaced) parts.emplace_back(part, "replaced");
    if (change == PartChange::removed) parts.emplace_back(part, "removed");
  };
  add("motion", changes.motion);
  add("face", changes.face);
  add("annotation", changes.annotation);
  add("clock", changes.clock);
  add("signer", changes.signer);
  add("rig", changes.rig);
  return parts;
}

/// The plan of an import into `database`, which is described in `inspected`; none if it would be refused.
std::optional<ImportPlan> plan_for(const Database& database, const ImportJob& job, const ImportOptions& options,
                                   Inspected& inspected) {
  try {
    ImportPlan plan = plan_import(database, job, options);
    if (plan.outcome != ImportOutcome::added) inspected.known = true;
    inspected.plan = {plan.recording.name, name_of(plan.outcome), changes_of(plan.changes), {}};
    return plan;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) throw;
    inspected.plan = {job.name, "refused", {}, error};
    return std::nullopt;
  }
}

Inspected inspect_one(const Database& database, const ImportJob& job, const ImportOptions& options, Database& scratch,
                      const Database::Progress& progress) {
  Inspected inspected{.name = job.name,
                      .files = {file_name_of(job.motion), file_name_of(job.annotation), file_name_of(job.face)},
                      .known = database.info(job.name).has_value(),
                      .plan = {},
                      .content = {},
                      .error = {}};
  std::optional<ImportPlan> plan = plan_for(database, job, options, inspected);
  try {
    if (!plan || plan->outcome != ImportOutcome::added) {  // read the files as those of a new recording
      ImportOptions fresh = options;
      fresh.if_annotation.reset();
      plan = plan_import(scratch, job, fresh);
    }
    plan->known.clear();
    inspected.content = content_of(scratch, apply(scratch, *plan, progress));
    scratch.remove(plan->recording.name);  // its space is reused
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) throw;
    inspected.error = error;
  }
  return inspected;
}

}  // namespace

void inspect(const Database& database, const Pairing& pairing, const ImportOptions& options,
             const std::filesystem::path& scratch, const Listener& listener,
             const std::function<void(const Inspected&)>& done) {
  const Scratch folder(scratch);
  Database::create(folder.folder, {});
  Database store(folder.folder, kv::Access::read_write);
  const auto jobs = static_cast<double>(pairing.jobs.size());
  for (std::size_t i = 0; i < pairing.jobs.size(); ++i) {
    const auto at = static_cast<double>(i);
    ImportOptions reading = options;
    reading.motion.progress = [&](double fraction) { listener.advance((at + fraction / 2) / jobs); };
    listener.advance(at / jobs);
    done(inspect_one(database, pairing.jobs[i], reading, store,
                     [&](double fraction) { listener.advance((at + 0.5 + fraction / 2) / jobs); }));
  }
}

}  // namespace signweave::calls
