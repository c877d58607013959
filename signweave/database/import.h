#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/database/database.h"
#include "signweave/formats/motion_file.h"

namespace signweave {

/// Files that make one recording.
struct ImportJob {
  std::string name;  ///< of the recording: the stem of its files, with the folder's name in front where stems collide
  bool name_told = false;  ///< a table of pairs tells the name
  std::optional<std::filesystem::path> motion;
  std::optional<std::filesystem::path> annotation;
  std::optional<std::filesystem::path> face;  ///< face capture
  bool no_face = false;                       ///< a table of pairs says so: what lies beside the motion is not its face
  std::string signer;
  std::optional<Seconds> offset;       ///< annotation time of frame 0, from a table of pairs
  std::optional<Seconds> face_offset;  ///< the motion's time of the face's first row, from such a table
};

struct Pairing {
  std::vector<ImportJob> jobs;  ///< by name
  std::vector<Notice> notices;  ///< files without a partner, files passed over
};

/// Finds out which files belong together. Folders are walked; files pair by the table of pairs, by stem in one folder,
/// by a stem that is unique, and by the files that an annotation links; one annotation may serve several motions. A
/// face capture STEM.face.csv goes with the motion STEM of its folder. Throws Error{not_found} for an input that is not
/// there, Error{unsupported} for a file of a kind that cannot be read, Error{bad_input} for a bad table.
///
/// The table is CSV with the columns motion, annotation, signer, offset (ms), face, face offset (ms), name of the
/// recording; all but the first two may be missing, either of the first two may be empty; a face "-" is none, also
/// where one lies beside the motion; paths are relative to the table's folder. A first row "motion,annotation,…" is a
/// heading. With `plain_files` the table may only name files beside it: Error{bad_input}, before anything is looked
/// for.
Pairing pair_files(const std::vector<std::filesystem::path>& inputs,
                   const std::optional<std::filesystem::path>& pairs_table = {}, bool plain_files = false);

/// "Frame 120 is at 4,010 ms of the annotation."
struct SyncPoint {
  double frame = 0;
  Seconds time{0};
};

struct ImportOptions {
  motion_file::ReadOptions motion;
  std::vector<TierNames::SignTier> sign_tiers;    ///< empty: guessed
  std::vector<std::string> phase_tiers;           ///< empty: guessed
  bool no_sign_tier = false;                      ///< there is none, so none is guessed, nor one of phases
  bool no_phase_tier = false;                     ///< there is none, so none is guessed
  std::map<std::string, PhaseKind> phase_labels;  ///< see TierNames
  std::optional<Seconds> offset;             ///< annotation time of frame 0; else from the EAF's TIME_ORIGIN; else 0
  std::vector<SyncPoint> sync;               ///< none, or two: sets origin and rate of the clock
  std::optional<Seconds> face_offset;        ///< the motion's time of a face's first row; else by the timecode; else 0
  std::optional<std::string> face_timecode;  ///< of the motion's frame 0, on the clock of the face capture
  std::optional<RigNames> rig;  ///< what a mapping file says of the skeletons; none: as they were told before
  bool strict = false;          ///< refuse an EAF file of which annotations would be left out (eaf::Unsound)
  bool replace_motion = false;  ///< take a motion or face file that changed since it was imported
  /// Which annotation the recording must have, as annotation_fingerprint tells it, for another to be stored.
  std::optional<std::string> if_annotation;
};

/// Tells the annotation that a recording has from any other: 16 hexadecimal digits, or "none".
std::string annotation_fingerprint(const RecordingInfo& info);

enum class ImportOutcome {
  added,
  unchanged,
  clock_changed,     ///< or the signer, or the rig's names
  measured,          ///< its phases, which were measured by an earlier version
  annotation_added,  ///< to a motion that was there
  annotation_replaced,
  motion_added,  ///< to an annotation that was there
  face_added,    ///< to a motion that had none
  motion_replaced,
};

struct ImportReport {
  std::string name;  ///< of the recording; the job's, or the one under which the same files are stored already
  ImportOutcome outcome = ImportOutcome::unchanged;
  std::int64_t frames = 0;   ///< of the motion as it now is; 0: none
  std::size_t tracks = 0;    ///< scalar tracks of the motion; 0 where the outcome is `unchanged`
  std::size_t signs = 0;     ///< in the annotation as it now is; 0 where the outcome is `unchanged`
  std::size_t defects = 0;   ///< of the motion; 0 where the outcome is `unchanged`
  std::string not_measured;  ///< why its phases were not measured; empty: they were, or there is only one half
  std::vector<Notice> notices;
};

/// Imports one recording: nothing where nothing changed; a changed annotation replaces the annotation alone; a changed
/// motion, or a changed face, which is a part of it, is Error{conflict} unless replace_motion (which also takes an
/// unchanged one again, over damage). An annotation other than the stored one is Error{conflict} where `if_annotation`
/// names a third, which somebody has replaced meanwhile. What an earlier import was told (clock, tiers, signer) holds
/// until it is told anew. A fault leaves the recording as it was.
ImportReport import_recording(Database& database, const ImportJob& job, const ImportOptions& options,
                              const Database::Progress& progress = {});

/// The name of a file that a URL or path of any system names: its last part, with %20 and the like decoded.
std::string linked_file_name(std::string_view url);

/// Reads a table of phase labels: lines "LABEL = KIND", KIND one of preparation, stroke, retraction, hold; # comments.
std::map<std::string, PhaseKind> read_phase_labels(const std::filesystem::path& path);

}  // namespace signweave
