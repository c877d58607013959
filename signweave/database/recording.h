#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// The motion half of a recording, to be stored.
struct MotionPart {
  Motion motion;
  std::optional<bvh::Layout> layout;  ///< how its file looked, for writing it back; none where it was no BVH file
  std::string file;                   ///< the file's name without its folder, for reports; may be empty
  std::uint64_t fingerprint = 0;      ///< checksum of the file's bytes; 0: not known
  std::string face_file;              ///< the same of the face capture whose tracks the motion has; empty: none
  std::uint64_t face_fingerprint = 0;
  Seconds face_offset{0};  ///< the motion's time of the face's first row
  std::string reading;     ///< what the file was told to be read with (motion_file::told)
  std::vector<std::pair<std::string, std::string>> declarations;  ///< what the file says of itself; see RecordingInfo
  std::size_t own_tracks = 0;  ///< with a face: so many of the tracks, the first, are the motion file's
  /// Metres: its numbers were rounded within so much when it was stored before. It is then stored as it is, and compact
  /// again. 0: as captured.
  float rounded_within = 0;
};

/// The annotation half.
struct AnnotationPart {
  AnnotationDocument document;  ///< `source` is what is stored, verbatim; written as EAF where it is empty
  TierNames tiers;              ///< which of its tiers hold signs and phases
  std::string file;
  std::uint64_t fingerprint = 0;
};

/// One capture: motion, annotation document, and the clock that ties them. Either half may be missing.
struct Recording {
  std::string name;    ///< unique in a database, UTF-8, not empty
  std::string signer;  ///< may be empty
  std::optional<MotionPart> motion;
  std::optional<AnnotationPart> annotation;
  FrameClock clock;             ///< meaningful where there is a motion
  bool clock_given = false;     ///< somebody set the clock; else it follows from the files
  bool tiers_given = false;     ///< the same of the tiers
  bool signer_given = false;    ///< and of the signer
  std::vector<Notice> notices;  ///< what reading it reported; kept with the recording
  std::optional<RigNames> rig;  ///< what a mapping file says of the skeleton; none: as it was
};

/// What a database knows of a recording without reading its motion or document.
/// More than fifteen members: a fact of the catalogue entry each.
struct RecordingInfo {
  std::string name;
  std::string signer;
  FrameClock clock;
  bool clock_given = false;  ///< see Recording
  bool tiers_given = false;
  bool signer_given = false;
  std::optional<motion_db::StoredMotion> motion;
  std::optional<bvh::Layout> layout;
  std::uint64_t document = 0;  ///< generation of the stored document; 0: none
  TierNames tiers;
  std::string motion_file;
  std::string annotation_file;
  std::string face_file;
  std::uint64_t motion_fingerprint = 0;
  std::uint64_t annotation_fingerprint = 0;
  std::uint64_t face_fingerprint = 0;
  Seconds face_offset{0};        ///< see MotionPart
  std::string reading;           ///< see MotionPart
  std::uint32_t own_tracks = 0;  ///< see MotionPart
  std::vector<Notice> notices;
  RigNames rig;                 ///< what a mapping file said of the skeleton; usually nothing
  std::vector<Defect> defects;  ///< found in the motion when it was put
  /// What its motion file says of itself, which stays when its document is replaced.
  std::vector<std::pair<std::string, std::string>> motion_declarations;
  /// What its files say of themselves and must not be lost in what is made of it: properties "signweave:…", such as
  /// that a demo's shapes are placeholders. Name and value.
  std::vector<std::pair<std::string, std::string>> declarations;
};

}  // namespace signweave
