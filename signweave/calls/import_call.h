#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/calls/listener.h"
#include "signweave/calls/motion_reading.h"
#include "signweave/core/answer.h"
#include "signweave/database/import.h"

namespace signweave::calls {

/// Stores recordings: motion files and their annotation.
struct ImportCall {
  std::string pairs;
  std::vector<std::string> sign_tiers;
  std::vector<std::string> phase_tiers;
  bool no_sign_tier = false;
  bool no_phase_tier = false;
  std::string phase_labels;
  MotionReading reading;
  std::optional<double> offset_ms;
  std::vector<std::string> syncs;
  FacePlacing face;
  std::string rig;
  bool strict = false;
  bool replace_motion = false;
  std::string if_annotation;            ///< empty: whatever annotation the recording has
  std::vector<std::string> recordings;  ///< empty: all
};

/// Returns why `text` is not FRAME@MS; empty if it is.
std::string check_sync(const std::string& text);

/// Returns why `text` identifies no annotation; empty if it does.
std::string check_fingerprint(const std::string& text);

template <class Visit>
void fields(Visit& visit, ImportCall& call) {
  visit(Field{.name = "pairs",
              .help = "CSV: motion, annotation, signer, offset in ms, face ('-': none), face offset in ms, name",
              .is_file = true},
        call.pairs);
  visit(Field{.name = "sign_tier", .help = "tier of glosses, TIER[:right|left|both[:SIGNER]]; guessed if not given"},
        call.sign_tiers);
  visit(Field{.name = "phase_tier", .help = "tier of phases; guessed if not given"}, call.phase_tiers);
  visit(Field{.name = "no_sign_tier", .help = "no tier holds signs: none is guessed, nor one of phases"},
        call.no_sign_tier);
  visit(Field{.name = "no_phase_tier", .help = "no tier holds phases: none is guessed"}, call.no_phase_tier);
  visit(Field{.name = "phase_labels", .help = "lines LABEL = preparation|stroke|retraction|hold", .is_file = true},
        call.phase_labels);
  fields(visit, call.reading);
  visit(Field{.name = "offset_ms", .help = "annotation time of frame 0"}, call.offset_ms);
  visit(Field{.name = "sync", .help = "FRAME@MS, given twice: sets offset and drift", .check = check_sync}, call.syncs);
  fields(visit, call.face);
  visit(Field{.name = "rig",
              .help = "mapping file: lines 'part = joint' for what joint names do not show; remembered, an empty "
                      "file forgets",
              .is_file = true,
              .type_name = "FILE"},
        call.rig);
  visit(Field{.name = "strict",
              .help = "refuse an EAF file with annotations that end before they begin or refer to what is not there; "
                      "else those are left out"},
        call.strict);
  visit(Field{.name = "replace_motion",
              .help = "take motion and face files again, changed or not: instead of what was imported, or over damage"},
        call.replace_motion);
  visit(Field{.name = "if_annotation",
              .help = "another annotation is stored only over this one: annotation_fingerprint of info, or none",
              .check = check_fingerprint,
              .type_name = "FINGERPRINT"},
        call.if_annotation);
  visit(Field{.name = "recordings",
              .help = "only these of what was found, by the names that the recordings would get",
              .several_words = true},
        call.recordings);
}

/// Requires checked fields. Reads the files that the call names. Throws what their readers throw, and Error{bad_input}
/// if tiers are both named and declared absent.
ImportOptions options_of(const ImportCall& call);

/// Pairs files and folders into recordings, and selects the wanted ones. With `plain_files`, a table of pairs may only
/// name files in its own folder. Throws what pair_files throws, and Error{not_found} with near matches for a recording
/// that is not among them.
Pairing pairing_of(const ImportCall& call, const std::vector<std::filesystem::path>& inputs, bool plain_files = false);

/// The result for one recording.
struct Imported {
  std::string name;
  std::optional<ImportReport> report;  ///< none if it failed
  std::optional<Error> error;          ///< if it failed
};

/// Imports the recordings in order; calls `done` with each result. A recording that fails leaves its stored data
/// unchanged, and the others continue; Error{cancelled}, which progress may throw, ends the import. Call `learn`
/// afterwards.
void run(Database& database, const Pairing& pairing, const ImportOptions& options, const Listener& listener,
         const std::function<void(const Imported&)>& done);

std::string_view name_of(ImportOutcome outcome);

/// Visits why something was refused.
template <class Visit>
void error_fields(Visit& visit, const std::optional<Error>& error) {
  const Remedies remedies = error ? error->remedies() : Remedies();
  visit(AnswerField{.name = "error", .help = "why it was refused"},
        error ? std::optional<std::string>(error->what()) : std::nullopt);
  visit(AnswerField{.name = "remedies"}, given_if(!remedies.empty(), remedies));
}

/// `error` and `remedies` if the recording failed, else all other fields.
template <class Visit>
void fields(Visit& visit, const Imported& imported) {
  const bool good = imported.report.has_value();
  const ImportReport report = imported.report.value_or(ImportReport());
  visit.type("ImportedRecording");
  visit(AnswerField{.name = "name"}, good ? report.name : imported.name);
  visit(AnswerField{.name = "outcome", .help = "failed, or what was done: added, unchanged, …"},
        good ? name_of(report.outcome) : std::string_view("failed"));
  visit(AnswerField{.name = "frames"}, given_if(good, report.frames));
  visit(AnswerField{.name = "tracks"}, given_if(good, report.tracks));
  visit(AnswerField{.name = "signs"}, given_if(good, report.signs));
  visit(AnswerField{.name = "defects"}, given_if(good, report.defects));
  visit(AnswerField{.name = "not_measured"}, given_if(good, report.not_measured));
  visit(AnswerField{.name = "notices"}, given_if(good, report.notices));
  error_fields(visit, imported.error);
}

}  // namespace signweave::calls
