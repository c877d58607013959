#include "signweave/live/shared_signing_cache.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/choose/missing_glosses.h"
#include "signweave/choose/notices.h"
#include "signweave/choose/on_skeleton.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/live/open_recordings.h"

namespace signweave {
namespace {

/// Maximum number of glosses whose tokens are cached. A database may have more glosses than are ever requested.
constexpr std::size_t kMostKept = 8192;
constexpr std::size_t kMostRigs = 1024;
constexpr std::size_t kMostMappings = 256;
/// Number of new glosses of an utterance whose tokens are checked completely; for the others only their existence is
/// checked, so that the first frame does not wait for the last gloss.
constexpr std::size_t kLookedAtWhole = 8;
/// Maximum number of recordings whose signers' rest poses are computed in advance.
constexpr std::size_t kMostRests = 64;

}  // namespace

SharedSigningCache::SharedSigningCache(const Database& database, std::size_t cached_bytes)
    : database_(database), transitions_(cached_bytes), steps_(3 * cached_bytes) {}

SharedSigningCache::Known& SharedSigningCache::of(const std::shared_ptr<const Contents>& contents) {
  if (known_.contents != contents) {
    const std::uint64_t number = known_.number + 1;
    known_ = {};
    known_.contents = contents;
    known_.number = number;
    transitions_.clear();
    steps_.clear();
  }
  return known_;
}

std::uint64_t SharedSigningCache::state_number(const std::shared_ptr<const Contents>& contents) {
  const std::lock_guard lock(mutex_);
  return of(contents).number;
}

/// `find` returns the slot of a value in the cached data; if it is empty, `make` creates the value without holding the
/// lock.
template <typename Value, typename Find, typename Make>
std::shared_ptr<const Value> SharedSigningCache::look_up(const std::shared_ptr<const Contents>& contents, Find find,
                                                         Make make) {
  {
    const std::lock_guard lock(mutex_);
    if (std::shared_ptr<const Value>& known = find(of(contents))) return known;
  }
  auto made = std::make_shared<const Value>(make());
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Value>& known = find(of(contents));
  if (!known) known = std::move(made);
  return known;
}

void SharedSigningCache::warm_up() {
  const Snapshot snapshot = database_.snapshot();
  const std::shared_ptr<const Contents>& contents = snapshot.shared_contents();
  durations(contents, {});
  declarations(contents);
  for (std::size_t i = 0; i < contents->recordings.size(); ++i) {
    if (contents->recordings[i].motion) snapshot.joins(i);
  }
  snapshot.learned();
  OpenRecordings open(database_);
  std::size_t looked_at = 0;
  for (const RecordingInfo& info : contents->recordings) {
    if (!info.motion || ++looked_at > kMostRests) continue;
    const FrameRange all{0, info.motion->frames};
    try {
      const MotionClip clip{.recording = info.name,
                            .source = std::make_shared<RecordingSource>(open, info),
                            .whole = all,
                            .core = clamp({0, kBodyFrames}, info.motion->frames),
                            .clock = info.clock,
                            .signs = {}};
      rest(snapshot, clip, *rig(snapshot, info.name));
    } catch (const Error& error) {  // reported when it is signed
      if (error.code() != ErrorCode::corrupt) throw;
    }
  }
}

std::shared_ptr<const DurationFit> SharedSigningCache::durations(const std::shared_ptr<const Contents>& contents,
                                                                 const DurationModel& model) {
  if (model.fixed) return std::make_shared<const DurationFit>(DurationFit{.mean = *model.fixed});
  return look_up<DurationFit>(
      contents, [&](Known & known) -> auto& { return known.durations[model.fitted]; },
      [&] { return durations_of(*contents, *database_.snapshot().learned(), model); });
}

void SharedSigningCache::check(const std::shared_ptr<const Contents>& contents, const std::vector<Place>& places) {
  std::vector<const Place*> unknown;
  {
    const std::lock_guard lock(mutex_);
    const Known& known = of(contents);
    for (const Place& place : places) {
      const bool plain = place.kind == Place::Kind::gloss && place.gloss.token == 0;
      if (!plain || !known.candidates.contains(place.gloss.gloss)) unknown.push_back(&place);
    }
  }
  if (!unknown.empty()) require_glosses({.places = places, .holds = {}, .non_manuals = {}}, contents->segments);
  std::size_t looked_at = 0;
  for (const Place* place : unknown) {
    const bool plain = place->kind == Place::Kind::gloss && place->gloss.token == 0;
    if (plain && ++looked_at > kLookedAtWhole && !tokens_of(*contents, place->gloss.gloss).empty()) continue;
    candidates(contents, *place);
  }
}

std::shared_ptr<const std::vector<Candidate>> SharedSigningCache::candidates(
    const std::shared_ptr<const Contents>& contents, const Place& place) {
  if (place.kind != Place::Kind::gloss) {
    return std::make_shared<const std::vector<Candidate>>(candidates_for(*contents, place));
  }
  std::string key = place.gloss.gloss;
  if (place.gloss.token > 0) key += '\n' + std::to_string(place.gloss.token);
  {
    const std::lock_guard lock(mutex_);
    const Known& known = of(contents);
    const auto at = known.candidates.find(key);
    if (at != known.candidates.end()) return at->second;
  }
  auto made = std::make_shared<const std::vector<Candidate>>(candidates_for(*contents, place));
  const std::lock_guard lock(mutex_);
  Known& known = of(contents);
  if (known.candidates.size() > kMostKept) known.candidates.clear();
  return known.candidates.try_emplace(std::move(key), std::move(made)).first->second;
}

std::shared_ptr<const SignerRig> SharedSigningCache::rig(const Snapshot& snapshot, const std::string& recording) {
  return look_up<SignerRig>(
      snapshot.shared_contents(),
      [&](Known & known) -> auto& {
        if (known.rigs.size() > kMostRigs) known.rigs.clear();
        return known.rigs[recording];
      },
      [&] { return signer_rig_of(snapshot, snapshot.contents().at(recording)); });
}

std::shared_ptr<const CapturedSpans> SharedSigningCache::spans(const Snapshot& snapshot, const MotionClip& clip,
                                                               const SignerRig& rig, Needs needs) {
  return look_up<CapturedSpans>(
      snapshot.shared_contents(),
      [&](Known & known) -> auto& {
        return known.spans[{clip.recording, needs}];
      },
      [&] { return captured_spans(snapshot, *clip.source->skeleton(), rig.groups, needs); });
}

std::shared_ptr<const KnownRest> SharedSigningCache::rest(const Snapshot& snapshot, const MotionClip& clip,
                                                          const SignerRig& rig) {
  const RecordingInfo& info = snapshot.contents().at(clip.recording);
  const std::shared_ptr<const Skeleton>& skeleton = clip.source->skeleton();
  const auto look = [&]() -> std::shared_ptr<const KnownRest> {
    for (const auto& known : of(snapshot.shared_contents()).rests) {
      if (known->signer == info.signer && (known->skeleton == skeleton || *known->skeleton == *skeleton)) return known;
    }
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex_);
    if (auto known = look()) return known;
  }
  const std::unique_ptr<MotionSource> motion = snapshot.motion(info);
  const std::span<const std::string> tracks = motion->tracks();
  auto made = std::make_shared<const KnownRest>(
      KnownRest{info.signer, skeleton, {tracks.begin(), tracks.end()}, rest_pose_of(*motion, rig.signer)});
  const std::lock_guard lock(mutex_);
  if (auto known = look()) return known;
  of(snapshot.shared_contents()).rests.push_back(made);
  return made;
}

std::shared_ptr<const BodyMapping> SharedSigningCache::mapping(const Snapshot& snapshot, const std::string& recording,
                                                               const std::string& onto, const Skeleton& skeleton) {
  return look_up<BodyMapping>(
      snapshot.shared_contents(),
      [&](Known & known) -> auto& {
        if (known.mappings.size() > kMostMappings) known.mappings.clear();
        return known.mappings[{recording, onto}];
      },
      [&] {
        const Contents& contents = snapshot.contents();
        const RecordingInfo* const info = contents.find(onto);
        const std::unique_ptr<MotionSource> home = info != nullptr && info->motion ? snapshot.motion(*info) : nullptr;
        if (home == nullptr || *home->skeleton() != skeleton) {
          throw Error(
              ErrorCode::conflict,
              fmt::format("recording '{}', whose skeleton is shown, was replaced or removed while it was signed",
                          onto));
        }
        const std::unique_ptr<MotionSource> motion = snapshot.motion(contents.at(recording));
        return map_body(body_of(contents, recording, *motion), body_of(contents, onto, *home));
      });
}

std::vector<std::string> SharedSigningCache::tracks(const Contents& contents, const std::string& recording) const {
  std::vector<std::string> names;
  const auto add = [&](const RecordingInfo& info) {
    if (!info.motion) return;
    for (const std::string& name : info.motion->tracks) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  };
  add(contents.at(recording));
  for (const RecordingInfo& info : contents.recordings) add(info);
  return names;
}

std::shared_ptr<const Declarations> SharedSigningCache::declarations(const std::shared_ptr<const Contents>& contents) {
  return look_up<Declarations>(
      contents, [&](Known & known) -> auto& { return known.declarations; },
      [&] {
        Declarations all;
        for (const RecordingInfo& info : contents->recordings) add_declarations(info, all);
        return all;
      });
}

}  // namespace signweave
