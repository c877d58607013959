#pragma once

#include <memory>
#include <set>
#include <span>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/choose/learned_strokes.h"
#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/notation/utterance.h"
#include "signweave/score/motion_clip.h"
#include "signweave/space/roles.h"

// Signs that are changed in space: which tokens are taken, and how their strokes change. Files and streams share these.
namespace signweave {

struct SpaceOptions {
  SpaceRoles roles;                         ///< that of another gloss is guessed from its token
  std::shared_ptr<LearnedStrokes> learned;  ///< shared by what signs the same database; null: learned for each call
};

/// True if a place asks for a change.
inline bool is_changed(const Place& place) noexcept {
  return !changes_nothing(place.space);
}

/// The places whose junction before them is generated even between neighbours of a recording: changed ones, and those
/// after them. Repetitions too.
std::set<std::size_t> generated_before(const Utterance& utterance);

/// How a place is repeated: the change of each repetition; one entry for a place that is not.
std::vector<SpaceChange> repetitions_of(const SpaceChange& change);

/// Takes out candidates whose annotated loci are farther from the requested ones than those of the nearest candidate,
/// and kLociApart: what is captured needs no change, and what is near needs less. Without annotated loci, all stay.
void prefer_loci(const Snapshot& snapshot, const SpaceChange& change, std::span<const LocusSetup> loci,
                 std::size_t place, std::vector<Candidate>& candidates);
inline constexpr float kCapturedLocus = 10;  ///< degrees: a token with this locus is taken as captured
inline constexpr float kLociApart = 15;      ///< degrees

/// A clip of one place, and what is asked for.
struct ClipToInflect {
  MotionClip* clip = nullptr;
  std::size_t place = 0;
  SpaceChange change;  ///< of this repetition
};

/// Throws what `inflect` throws for loci: for names that are not set up by then, and for loci behind the signer.
void check_loci(const SpaceChange& change, std::span<const LocusSetup> loci, std::size_t place);

/// Finds the change of each clip for the signer of the result, and reads its frames through it from now on. `rig` is
/// that of the result's skeleton, which the clips must have. Notices say what is not reached, and which role was
/// guessed. Throws Error{bad_input, not_found} for unknown loci, loci behind the signer, and signs without role.
void inflect(std::span<const ClipToInflect> clips, std::span<const LocusSetup> loci, const Snapshot& snapshot,
             const std::shared_ptr<const SignerRig>& rig, const SpaceOptions& options, std::vector<Notice>& notices);

/// Reads the frames of clips through the changes that a score gives them.
void read_changed(std::span<MotionClip> clips, const std::shared_ptr<const SignerRig>& rig);

}  // namespace signweave
