#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/choose/candidate.h"
#include "signweave/choose/captured_spans.h"
#include "signweave/choose/concatenate.h"
#include "signweave/choose/durations.h"
#include "signweave/choose/learned_strokes.h"
#include "signweave/database/database.h"
#include "signweave/live/made_cache.h"
#include "signweave/live/made_step.h"
#include "signweave/live/rest_pose.h"
#include "signweave/retarget/body_mapping.h"

namespace signweave {

/// The rest pose of a signer.
struct KnownRest {
  std::string signer;
  std::shared_ptr<const Skeleton> skeleton;
  std::vector<std::string> tracks;  ///< names of the pose's track values
  RestPose rest;
};

/// Data shared by the players of one database that does not depend on what they sign: durations of transitions, joint
/// roles, rest poses, tokens of glosses. Computed on first use, and again after the database changes. Threads may share
/// it. It must outlive its players, and the database must outlive it.
class SharedSigningCache {
 public:
  /// Caches transitions of up to `cached_bytes`, and steps of three times as much: streams hold those that they sign
  /// anyway.
  explicit SharedSigningCache(const Database& database, std::size_t cached_bytes = kCachedBytes);
  static constexpr std::size_t kCachedBytes = std::size_t{256} << 20;

  const Database& database() const noexcept { return database_; }
  /// Computes in advance what players would otherwise wait for.
  void warm_up();

  /// The following functions return data of the given contents, which are the database's current or earlier ones.

  /// As `durations_of`.
  std::shared_ptr<const DurationFit> durations(const std::shared_ptr<const Contents>& contents,
                                               const DurationModel& model);
  /// As `candidates_for`; throws the same errors.
  std::shared_ptr<const std::vector<Candidate>> candidates(const std::shared_ptr<const Contents>& contents,
                                                           const Place& place);
  /// Throws what `candidates_for` throws for one of the places. In a long utterance, glosses whose tokens all lack a
  /// stroke or a motion may be reported later.
  void check(const std::shared_ptr<const Contents>& contents, const std::vector<Place>& places);
  /// As `signer_rig_of` for a recording.
  std::shared_ptr<const SignerRig> rig(const Snapshot& snapshot, const std::string& recording);
  /// As `captured_spans`, for the skeleton of a recording.
  std::shared_ptr<const CapturedSpans> spans(const Snapshot& snapshot, const MotionClip& clip, const SignerRig& rig,
                                             Needs needs);
  /// The rest pose of a recording's signer, from one of the signer's recordings.
  std::shared_ptr<const KnownRest> rest(const Snapshot& snapshot, const MotionClip& clip, const SignerRig& rig);
  /// The mapping of a recording's motion to the skeleton of `onto`, which has other joints. Throws what `map_body`
  /// throws; Error{conflict} if `onto` was removed since, or no longer has that skeleton.
  std::shared_ptr<const BodyMapping> mapping(const Snapshot& snapshot, const std::string& recording,
                                             const std::string& onto, const Skeleton& skeleton);
  /// The names of all scalar tracks of the database, those of `recording` first.
  std::vector<std::string> tracks(const Contents& contents, const std::string& recording) const;
  /// The unique declarations of all recordings.
  std::shared_ptr<const Declarations> declarations(const std::shared_ptr<const Contents>& contents);

  /// A number for each state of the database that was used; data computed in one state is not valid in another.
  std::uint64_t state_number(const std::shared_ptr<const Contents>& contents);
  /// A new seed, so that two signers do not breathe and blink in sync.
  std::uint64_t new_seed() noexcept { return ++seeds_; }
  /// The cached transitions.
  TransitionCache& transitions() noexcept { return transitions_; }
  /// The cached steps of streams whose channels differ.
  StepCache& steps() noexcept { return steps_; }
  /// What is learned about strokes in space.
  const std::shared_ptr<LearnedStrokes>& learned_strokes() const noexcept { return learned_strokes_; }

 private:
  struct Known {
    std::shared_ptr<const Contents> contents;
    std::uint64_t number = 0;
    std::map<bool, std::shared_ptr<const DurationFit>> durations;  ///< by DurationModel::fitted
    std::unordered_map<std::string, std::shared_ptr<const std::vector<Candidate>>> candidates;  ///< by place
    std::map<std::string, std::shared_ptr<const SignerRig>> rigs;                               ///< by recording
    std::map<std::pair<std::string, Needs>, std::shared_ptr<const CapturedSpans>> spans;  ///< by recording and needs
    std::map<std::pair<std::string, std::string>, std::shared_ptr<const BodyMapping>>
        mappings;                                         ///< by recording, and the recording of the target skeleton
    std::vector<std::shared_ptr<const KnownRest>> rests;  ///< few: one for each signer and skeleton
    std::shared_ptr<const Declarations> declarations;
  };
  /// The cached data of these contents; only the data of the newest contents is kept. Requires the lock.
  Known& of(const std::shared_ptr<const Contents>& contents);
  template <typename Value, typename Find, typename Make>
  std::shared_ptr<const Value> look_up(const std::shared_ptr<const Contents>& contents, Find find, Make make);

  const Database& database_;
  std::mutex mutex_;
  Known known_;
  TransitionCache transitions_;
  StepCache steps_;
  const std::shared_ptr<LearnedStrokes> learned_strokes_ = std::make_shared<LearnedStrokes>();
  std::atomic<std::uint64_t> seeds_ = 0;
};

}  // namespace signweave
