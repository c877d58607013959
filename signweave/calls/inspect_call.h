#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/calls/import_call.h"
#include "signweave/calls/info_call.h"
#include "signweave/calls/listener.h"
#include "signweave/database/import.h"

namespace signweave::bvh {

template <class Visit>
void fields(Visit& visit, const Layout& layout) {
  visit.type("MotionLayout");
  visit(AnswerField{.name = "up", .one_of = {"y", "z"}}, std::string_view(layout.up == UpAxis::z ? "z" : "y"));
  visit(AnswerField{.name = "unit", .help = "metres"}, layout.unit);
  visit(AnswerField{.name = "root_unit", .help = "metres"}, layout.root_unit);
  visit(AnswerField{.name = "mirrored"}, layout.mirrored);
  visit(AnswerField{.name = "root_order", .one_of = {"declared", "rotation_first"}},
        std::string_view(layout.root_columns == RootColumns::declared ? "declared" : "rotation_first"));
}

}  // namespace signweave::bvh

namespace signweave::calls {

/// A tier of an annotation, and its role.
struct TierAnswer {
  std::string tier;
  OrNull<std::string> parent;
  std::size_t annotations = 0;
  std::size_t labels = 0;
  std::string_view role;
  std::string_view hand;
};
template <class Visit>
void fields(Visit& visit, const TierAnswer& tier) {
  visit.type("TierRow");
  visit(AnswerField{.name = "tier"}, tier.tier);
  visit(AnswerField{.name = "parent"}, tier.parent);
  visit(AnswerField{.name = "annotations"}, tier.annotations);
  visit(AnswerField{.name = "labels", .help = "how many different ones"}, tier.labels);
  visit(AnswerField{.name = "role", .one_of = {"signs", "phases", ""}}, tier.role);
  visit(AnswerField{.name = "hand", .help = "of a tier of signs", .one_of = {"both", "left", "right"}}, tier.hand);
}

/// The names of a recording's files; null if it has none.
struct JobFiles {
  OrNull<std::string> motion;
  OrNull<std::string> annotation;
  OrNull<std::string> face;
};
template <class Visit>
void fields(Visit& visit, const JobFiles& files) {
  visit(AnswerField{.name = "motion"}, files.motion);
  visit(AnswerField{.name = "annotation"}, files.annotation);
  visit(AnswerField{.name = "face"}, files.face);
}

/// What an import would store of a recording.
struct InspectedContent {
  RecordingDetails details;
  std::size_t signs = 0;
  std::string not_measured;
  std::vector<Notice> notices;
  std::vector<std::string> joints;
  std::vector<TierAnswer> tiers;
};

/// A part of a recording that an import would change, and how.
using PartChanges = std::vector<std::pair<std::string, std::string_view>>;

/// What an import would change in the database.
struct ImportPlanAnswer {
  std::string recording;  ///< its name in the database
  std::string_view outcome;
  PartChanges changes;
  std::optional<Error> error;  ///< why the import would be refused
};
template <class Visit>
void fields(Visit& visit, const ImportPlanAnswer& plan) {
  visit.type("ImportPlan");
  visit(AnswerField{.name = "recording", .help = "its name in the database"}, plan.recording);
  visit(AnswerField{.name = "outcome", .help = "that of the import, or refused"}, plan.outcome);
  visit(AnswerField{.name = "changes",
                    .help = "the parts that change (motion, face, annotation, clock, signer, rig): added, replaced or "
                            "removed"},
        plan.changes);
  error_fields(visit, plan.error);
}

/// A recording as an import would store it, or why it could not.
struct Inspected {
  std::string name;
  JobFiles files;
  bool known = false;  ///< the database has a recording of this name, or of the same files
  ImportPlanAnswer plan;
  std::optional<InspectedContent> content;
  std::optional<Error> error;  ///< if there is no content
};
template <class Visit>
void fields(Visit& visit, const Inspected& inspected) {
  const bool good = inspected.content.has_value();
  static const InspectedContent nothing;
  const InspectedContent& content = good ? *inspected.content : nothing;
  const RecordingDetails& details = content.details;
  const RecordingInfo& info = details.info;
  const bool moving = details.model.has_value();
  visit.type("InspectedRecording");
  visit(AnswerField{.name = "name"}, inspected.name);
  visit(AnswerField{.name = "files"}, inspected.files);
  visit(AnswerField{.name = "known", .help = "the database has a recording of this name, or of the same files"},
        inspected.known);
  visit(AnswerField{.name = "plan", .help = "what the import would change"}, inspected.plan);
  error_fields(visit, inspected.error);
  visit(AnswerField{.name = "signer"}, given_if(good, info.signer));
  visit(AnswerField{.name = "frames"}, given_if(moving, details.frames));
  visit(AnswerField{.name = "frames_per_second"}, given_if(moving, details.frames_per_second));
  visit(AnswerField{.name = "seconds"}, given_if(moving, details.seconds));
  visit(AnswerField{.name = "clock_origin_ms", .help = "the annotation time of frame 0"},
        given_if(moving, rounded_to_thousandths(1e3 * info.clock.origin.count())));
  visit(AnswerField{.name = "tracks"}, given_if(good, info.motion ? info.motion->tracks : std::vector<std::string>()));
  visit(AnswerField{.name = "signs"}, given_if(good, content.signs));
  visit(AnswerField{.name = "phases"}, given_if(good, details.phases));
  visit(AnswerField{.name = "not_measured"}, given_if(good, content.not_measured));
  visit(AnswerField{.name = "notices"}, given_if(good, content.notices));
  visit(AnswerField{.name = "layout"}, given_if(good, OrNull{info.motion_facts.layout}));
  visit(AnswerField{.name = "rig"},
        given_if(good, null_unless(moving, moving ? rig_answer(*details.skeleton, details.model->rig) : RigAnswer())));
  visit(AnswerField{.name = "joints"}, given_if(good, content.joints));
  visit(AnswerField{.name = "defects"},
        given_if(good, moving ? defect_rows(info.defects, *details.skeleton) : std::vector<DefectRow>()));
  visit(AnswerField{.name = "tiers"}, given_if(good, content.tiers));
  visit(AnswerField{.name = "declarations"}, given_if(good, info.declarations));
}

/// Reports what an import of some files would store, recording by recording, and what it guesses, for a person to check
/// before the import: the plan of the import into `database`, or why it would be refused; and how the files are read,
/// as those of a new recording, without the settings of an earlier import. The latter is determined by importing into a
/// temporary database in `scratch`, a folder that must not exist and is removed afterwards. `done` receives each
/// recording; Error{cancelled}, which progress may throw, ends the inspection.
void inspect(const Database& database, const Pairing& pairing, const ImportOptions& options,
             const std::filesystem::path& scratch, const Listener& listener,
             const std::function<void(const Inspected&)>& done);

}  // namespace signweave::calls
