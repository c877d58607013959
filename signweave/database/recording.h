#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/annotation/document.h"
#include "signweave/annotation/sign.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/features/defects.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/access_mode.h"
#include "signweave/motion_db/motion_db.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// Facts about the files that a motion was read from, stored with the recording. The names of files are without their
/// folders.
struct MotionFacts {
  std::optional<bvh::Layout> layout;   ///< how to write the file back; nullopt unless it was a BVH file
  std::string file;                    ///< for reports; may be empty
  std::uint64_t fingerprint = 0;       ///< checksum of everything that the motion was read from; 0: not known
  std::string face_file;               ///< the face capture whose tracks the motion has; empty: none
  std::uint64_t face_fingerprint = 0;  ///< checksum of its bytes; 0: none
  Seconds face_offset{0};              ///< the motion's time of the face's first row
  std::string reading;                 ///< the options that the file was read with (motion_file::given_options)
  Declarations declarations;           ///< of the motion file; they stay when the recording's document is replaced
  std::uint32_t own_tracks = 0;        ///< number of the motion file's own tracks, which come before those of the face
  friend bool operator==(const MotionFacts&, const MotionFacts&) = default;
};

/// The motion half of a recording, to be stored.
struct MotionPart {
  Motion motion;
  MotionFacts facts = {};
  /// Metres: the tolerance it was rounded with when it was stored before; it is stored again unchanged, in compact
  /// packets. 0: as captured.
  float rounded_within = 0;
};

/// The annotation half.
struct AnnotationPart {
  AnnotationDocument document;  ///< `source` is stored verbatim; if empty, EAF is written
  TierNames tiers;              ///< which of its tiers hold signs and phases
  std::string file;
  std::uint64_t fingerprint = 0;
};

/// One capture: motion, annotation document, and the clock that relates them. Either half may be missing.
struct Recording {
  std::string name;    ///< unique in a database, UTF-8, not empty
  std::string signer;  ///< may be empty
  std::optional<MotionPart> motion;
  std::optional<AnnotationPart> annotation;
  FrameClock clock;             ///< meaningful if there is a motion
  bool clock_given = false;     ///< the user set the clock; else it follows from the files
  bool tiers_given = false;     ///< likewise for the tiers
  bool signer_given = false;    ///< and for the signer
  std::vector<Notice> notices;  ///< from reading the files; stored with the recording
  std::optional<RigNames> rig;  ///< from a mapping file of the skeleton; none: unchanged
};

/// The catalogue entry of a recording: its properties without motion and document.
/// More than fifteen members: each is a field of the catalogue entry.
struct RecordingInfo {
  std::string name;
  std::string signer;
  FrameClock clock;
  bool clock_given = false;  ///< see Recording
  bool tiers_given = false;
  bool signer_given = false;
  std::optional<motion_db::StoredMotion> motion;
  MotionFacts motion_facts;
  std::uint64_t document = 0;  ///< generation of the stored document; 0: none
  TierNames tiers;
  std::string annotation_file;
  std::uint64_t annotation_fingerprint = 0;
  std::vector<Notice> notices;
  RigNames rig;                 ///< from a mapping file of the skeleton; usually empty
  std::vector<Defect> defects;  ///< found in the motion when it was put
  Declarations declarations;    ///< of all its files
  friend bool operator==(const RecordingInfo&, const RecordingInfo&) = default;
};

/// The catalogue entries of some names at one moment; none: no recording of this name.
using KnownRecordings = std::map<std::string, std::optional<RecordingInfo>>;

/// Throws Error{bad_input} unless a recording may have this name: 1 to 1000 bytes of UTF-8, not only spaces.
void require_recording_name(std::string_view name);

}  // namespace signweave
