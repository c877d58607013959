#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "signweave/database/database.h"
#include "signweave/database/import_options.h"
#include "signweave/database/pairing.h"
#include "signweave/database/recording.h"

namespace signweave {

enum class ImportOutcome {
  added,
  unchanged,
  clock_changed,     ///< or the signer, or the rig's names
  measured,          ///< its phases, which were measured by an earlier version
  annotation_added,  ///< to a stored motion
  annotation_replaced,
  motion_added,  ///< to a stored annotation
  face_added,    ///< to a motion that had none
  motion_replaced,
};

/// The effect of an import on one part of a recording.
enum class PartChange {
  none,  ///< neither stored nor imported
  kept,
  added,
  replaced,
  removed,
};

struct ImportChanges {
  PartChange motion = PartChange::none;
  PartChange face = PartChange::none;
  PartChange annotation = PartChange::none;  ///< `replaced` also if other tiers of the same document hold the signs
  PartChange clock = PartChange::none;
  PartChange signer = PartChange::none;
  PartChange rig = PartChange::none;  ///< the names from a mapping file
};

/// What an import of one recording will do, decided and read: plain data that refers to neither files nor database.
struct ImportPlan {
  ImportOutcome outcome = ImportOutcome::unchanged;
  ImportChanges changes;
  /// The data to be stored: the name, the new halves, clock, signer, rig names, notices. If the outcome is `unchanged`
  /// or `measured`, only the name is set.
  Recording recording;
  KnownRecordings known;    ///< the entries of the database that the plan was made from
  std::int64_t frames = 0;  ///< of the motion after the import; 0: none
  std::size_t tracks = 0;   ///< scalar tracks of the motion; 0 if nothing is stored
  std::size_t signs = 0;    ///< in the annotation after the import; 0 if nothing is stored
};

/// Decides what an import of one recording does, given the stored recording, and reads the files that it needs. Changes
/// nothing; the database may be open read-only. If only the annotation changed, only the annotation is replaced.
///
/// Throws every error that can be found before something is stored: Error{conflict} for a changed motion, or a changed
/// face, which is a part of it, unless options.replace_motion (which also stores an unchanged one again, to repair
/// damage); Error{conflict} for another annotation than the stored one if options.if_annotation names a third;
/// Error{bad_input} or Error{not_found} for options, clocks and mapping files that do not fit; and what the readers of
/// the files throw. Settings of an earlier import (clock, tiers, signer, rig names) are kept until they are given
/// again.
ImportPlan plan_import(const Database& database, const ImportJob& job, const ImportOptions& options);

/// Identifies the annotation of a recording: 16 hexadecimal digits, or "none".
std::string annotation_fingerprint(const RecordingInfo& info);

}  // namespace signweave
