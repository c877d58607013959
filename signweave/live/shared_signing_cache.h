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

#include "signweave/choose/candidate.h"
#include "signweave/choose/captured_spans.h"
#include "signweave/choose/concatenate.h"
#include "signweave/choose/durations.h"
#include "signweave/database/database.h"
#include "signweave/live/rest_pose.h"
#include "signweave/live/transition_cache.h"
#include "signweave/retarget/body_mapping.h"

namespace signweave {

/// Where a signer rests.
struct KnownRest {
  std::string signer;
  std::shared_ptr<const Skeleton> skeleton;
  std::vector<std::string> tracks;  ///< names of the pose's track values
  RestPose rest;
};

/// What many players of one database share and what does not depend on what they sign: how long transitions last, which
/// joint is what, where a signer rests, the tokens of a gloss. Made when it is first asked for, and again after a
/// change of the database. Threads may share it; it must outlive its players, and the database it.
class SharedSigningCache {
 public:
  explicit SharedSigningCache(const Database& database, std::size_t cached_bytes = kCachedBytes);
  static constexpr std::size_t kCachedBytes = std::size_t{256} << 20;

  const Database& database() const noexcept { return database_; }
  /// Makes now what players would wait for.
  void warm_up();

  /// What follows is of the contents given, which are the database's now or were.

  /// As `durations_of`.
  std::shared_ptr<const DurationFit> durations(const std::shared_ptr<const Contents>& contents,
                                               const DurationModel& model);
  /// As `candidates_for`; throws what it throws.
  std::shared_ptr<const std::vector<Candidate>> candidates(const std::shared_ptr<const Contents>& contents,
                                                           const Place& place);
  /// Throws what `candidates_for` throws for one of the places. Of a long utterance, glosses whose tokens all lack a
  /// stroke or a motion may be told later.
  void check(const std::shared_ptr<const Contents>& contents, const std::vector<Place>& places);
  /// As `signer_rig_of` for a recording.
  std::shared_ptr<const SignerRig> rig(const Snapshot& snapshot, const std::string& recording);
  /// As `captured_spans`, for the skeleton of a recording.
  std::shared_ptr<const CapturedSpans> spans(const Snapshot& snapshot, const MotionClip& clip, const SignerRig& rig,
                                             Needs needs);
  /// Where the signer of a recording rests, in one of the signer's recordings.
  std::shared_ptr<const KnownRest> rest(const Snapshot& snapshot, const MotionClip& clip, const SignerRig& rig);
  /// How a recording's motion is put onto the skeleton of `onto`, which has other joints. Throws what `map_body`
  /// throws; Error{conflict} where `onto` was removed since, or has no longer that skeleton.
  std::shared_ptr<const BodyMapping> mapping(const Snapshot& snapshot, const std::string& recording,
                                             const std::string& onto, const Skeleton& skeleton);
  /// The names of all scalar tracks of the database, those of `recording` first.
  std::vector<std::string> tracks(const Contents& contents, const std::string& recording) const;
  /// What all recordings declare of themselves, each once.
  std::shared_ptr<const std::vector<std::pair<std::string, std::string>>> declarations(
      const std::shared_ptr<const Contents>& contents);

  /// Tells the states of the database apart that were asked for: what is made in one does not serve in another.
  std::uint64_t state_number(const std::shared_ptr<const Contents>& contents);
  /// So that two signers do not breathe and blink as one.
  std::uint64_t new_seed() noexcept { return ++seeds_; }
  /// What was made before.
  TransitionCache& transitions() noexcept { return transitions_; }

 private:
  struct Known {
    std::shared_ptr<const Contents> contents;
    std::uint64_t number = 0;
    std::map<bool, std::shared_ptr<const DurationFit>> durations;  ///< by whether they may be fitted
    std::unordered_map<std::string, std::shared_ptr<const std::vector<Candidate>>> candidates;  ///< by the place
    std::map<std::string, std::shared_ptr<const SignerRig>> rigs;                               ///< by recording
    std::map<std::pair<std::string, Needs>, std::shared_ptr<const CapturedSpans>> spans;  ///< by recording and needs
    std::map<std::pair<std::string, std::string>, std::shared_ptr<const BodyMapping>>
        mappings;                                         ///< by recording, and that whose skeleton it is put onto
    std::vector<std::shared_ptr<const KnownRest>> rests;  ///< few: of each signer one for each skeleton
    std::shared_ptr<const std::vector<std::pair<std::string, std::string>>> declarations;
  };
  /// What is known of these contents; of others than the newest nothing is kept. Call it with the lock held.
  Known& of(const std::shared_ptr<const Contents>& contents);
  template <typename Value, typename Find, typename Make>
  std::shared_ptr<const Value> look_up(const std::shared_ptr<const Contents>& contents, Find find, Make make);

  const Database& database_;
  std::mutex mutex_;
  Known known_;
  TransitionCache transitions_;
  std::atomic<std::uint64_t> seeds_ = 0;
};

}  // namespace signweave
