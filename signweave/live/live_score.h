#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "signweave/choose/part_choice.h"
#include "signweave/core/prefetch.h"
#include "signweave/live/clip_chain.h"
#include "signweave/live/frame_ring.h"
#include "signweave/live/lane_step.h"
#include "signweave/live/live_curves.h"
#include "signweave/live/open_recordings.h"
#include "signweave/live/place_queue.h"
#include "signweave/live/player.h"
#include "signweave/live/shared_signing_cache.h"
#include "signweave/live/stream_setup.h"
#include "signweave/live/timeline.h"

/// Internal to this module.
namespace signweave {

/// The score of an utterance while places are added to it, and its timeline. Both grow on demand, and are truncated if
/// frames that were not yet taken must change. Frame numbers start at the first frame that a player shows. Used by one
/// thread.
class LiveScore {
 public:
  LiveScore(SharedSigningCache& cache, const PlayerOptions& options);

  // Each of these gets the first frame that was not taken (`next`) and the ring with the frames before it. The timeline
  // may end earlier afterwards, but not before `next`. Throws as PlaceQueue; then nothing has changed.

  /// Replaces the places that have not begun; a sign that has begun is finished if it ends soon.
  void replace(const Utterance& utterance, std::int64_t next, const FrameRing& shown);
  /// Appends these places.
  void add(const Utterance& utterance, std::int64_t next, const FrameRing& shown);
  /// Shows the signer of a recording at rest, before anything is signed. Throws Error{not_found}.
  void rest_in(const std::string& recording);
  /// Continues at a position of the utterance, in output frames from its first, clamped to the decided part. Returns
  /// false, with no changes, if nothing is decided. Otherwise the timeline ends at `next` or later, and everything from
  /// there on is new.
  bool seek(std::int64_t at, std::int64_t next);
  void set_loop(bool loop, std::int64_t next, const FrameRing& shown);

  const StreamHeader* header() const noexcept { return setup_ ? &setup_->header : nullptr; }
  /// The score of the timeline, with the frame that is shown next; see ShownScore.
  std::optional<ShownScore> score(std::int64_t next, std::size_t most_clips) const;
  std::shared_ptr<const MotionSource> rest() const noexcept { return setup_ ? setup_->living : nullptr; }

  /// The first frame that shows something else since this was called last; the last possible one if none does.
  std::int64_t take_changed_from() noexcept { return curves_.take_changed_from(); }

  /// The end of the known timeline.
  std::int64_t end() const noexcept { return timeline_.end(); }
  /// Extends the timeline; returns false if that is not possible now. Throws Error if a place cannot be signed; it is
  /// skipped, and the next call continues. `shown` has the frames made so far.
  bool extend(const FrameRing& shown);
  /// Appends frames to the ring, up to `until`, which must be known. Throws Error{corrupt}.
  void read(std::int64_t until, FrameRing& ring);
  /// Releases the database until it is needed again, and the timeline before `taken`.
  void let_go(std::int64_t taken) noexcept;

  /// The next event of a frame up to `frame`.
  std::optional<PlayerEvent> take_event(std::int64_t frame) noexcept;
  /// Prefetches the memory of take_event(), in two steps.
  void prefetch_state() const noexcept {
    prefetch(&state_, sizeof state_);
    prefetch(&reports_.events, sizeof reports_.events);
  }
  void prefetch_event() const noexcept {
    if (!reports_.events.empty()) prefetch(&reports_.events.front().event.frame, sizeof(std::uint64_t));
  }
  /// True if nothing is left to sign from this frame on.
  bool idle(std::int64_t frame) const noexcept;
  /// True if the timeline ends with the last retraction.
  bool ended() const noexcept { return state_ == State::ended && !queue_.has_next(); }

  /// Number of shown frames that must be kept.
  std::int64_t history() const noexcept;

  /// A sign that ends within this time is finished before another utterance begins.
  static constexpr Seconds kFinished{1.0};

 private:
  /// Number of frames by which the timeline grows at rest.
  static constexpr std::int64_t kRestFramesAtOnce = 32;

  using ClipPtr = std::shared_ptr<LiveClip>;
  using StepPtr = std::shared_ptr<const LaneStep>;
  enum class State {
    nothing,  ///< no frames yet
    at_core,  ///< the timeline ends with the tail's core; the next clip is joined there
    resting,  ///< the tail is the rest, which continues
    ended,    ///< the last retraction is over (Idle::end)
  };
  /// A placed clip of this utterance, with the places that it fills.
  struct Entry {
    ClipPtr clip;
    std::size_t first = 0;
    std::size_t last = 0;    ///< inclusive
    bool joined = false;     ///< to the previous entry
    std::int64_t begin = 0;  ///< frame of the utterance at which its transition or preparation begins
    std::int64_t core = 0;   ///< frame of the utterance at which its core begins
    StepPtr step = {};       ///< what it was signed with, if channels differ; null: by itself
  };
  /// An authored movement of this utterance, over frames of the utterance.
  struct Authored {
    AuthoredCurve curve;
    bool goes_on = false;  ///< its end is not known yet
  };
  /// What was placed of an utterance.
  struct Round {
    std::vector<Entry> entries;
    std::map<std::size_t, Authored> authored;  ///< by the number of the non-manual in the queue
  };
  /// The tokens that parts of some places sign.
  struct PartsOfPlaces {
    std::shared_ptr<const Contents> contents;
    bool after_sign = false;  ///< chosen with regard to the place before
    std::vector<PartChoice> choices;
    std::vector<ChosenPart> chosen;  ///< points to `choices`
  };
  /// The last signed clip; the rest may follow it.
  struct LastSign {
    ClipPtr clip;                    ///< null: none
    std::optional<Candidate> signs;  ///< the signs that neighbours may continue
    StepPtr step = {};               ///< what it was signed with; null: by itself
  };
  /// An event that is not taken yet.
  struct Pending {
    PlayerEvent event;
    std::optional<std::string> once = {};  ///< its entry in Reports::of_stream
  };
  /// A notice of lint_channels, with the first place of its step.
  struct ReportedNotice {
    std::size_t place = 0;
    std::string code;
    std::string text;
    auto operator<=>(const ReportedNotice&) const = default;
  };
  /// Events, and what is not reported again.
  struct Reports {
    std::deque<Pending> events;  ///< `frame` counts the timeline's frames
    /// Recordings whose retargeting was reported; "" for how the stream is signed.
    std::set<std::string> of_stream;
    std::set<ReportedNotice> of_places;  ///< of this utterance
  };
  /// Recordings with other skeletons.
  struct OtherBodies {
    /// By the generation of their motion, and whether they are mirrored.
    std::map<std::pair<std::uint64_t, bool>, std::weak_ptr<const MotionSource>> shown;
  };

  /// The last placed clip; the next one is joined to it.
  LiveClip& tail() const noexcept { return *chain_.back(); }
  MotionClip clip_of(const Contents& contents, const Candidate& candidate, std::size_t place,
                     std::optional<bool> mirrored = {}, bool exchanged = false);
  void change_in_space(MotionClip& clip, std::size_t place, std::size_t repetition);
  std::shared_ptr<const MotionSource> on_skeleton(const RecordingInfo& info,
                                                  std::shared_ptr<const MotionSource> source);
  void set_up_for(const MotionClip& first, const std::shared_ptr<const Contents>& contents);
  void leave_idle();
  void extended(LiveClip& clip) const;
  void notify(std::int64_t frame, std::size_t place, std::string text);
  void add_event(PlayerEvent event, std::optional<std::string> once = {});
  void report_setup(const Entry& entry);
  void report_channels(const Entry& first, std::int64_t from);
  void sign_next();
  void go_to_rest();
  void go_to_rest_in_channels();
  StepPtr lower_hands();
  void end_at_last_sign();

  // live_score_channels.cpp
  void sign_in_channels(std::size_t first);
  std::vector<Entry> clips_of_places(std::size_t first, std::size_t last, StepClips& clips, Candidate& signs);
  const std::vector<ChosenPart>& chosen_parts(std::size_t first, std::size_t last, bool after_sign);
  void add_parts(std::size_t first, std::size_t last, const std::vector<Entry>& placed, StepClips& clips);
  void add_holds(std::size_t first, std::size_t last, const std::vector<Entry>& placed, StepClips& clips);
  void extend_tail(std::int64_t end);
  bool tail_is_last_sign() const noexcept;
  StepPtr take_step(const StepClips& clips);
  bool finish_in_channels(std::int64_t next, const FrameRing& shown);
  void seek_in_step(std::size_t index, std::int64_t at, std::int64_t next);

  // live_score_face.cpp
  void author(std::size_t first, std::int64_t from);
  Score times_from(std::size_t place) const;
  bool let_go_on(const Utterance& utterance, std::int64_t next);
  void show_authored(std::int64_t next);
  std::shared_ptr<const Motion> join(LiveClip& a, LiveClip& b);
  ClipPtr history_of(std::int64_t next, const FrameRing& shown) const;
  Motion shown_frames(std::int64_t first, std::int64_t end, const FrameRing& shown) const;
  ClipPtr shown_clip(Motion frames, std::int64_t first) const;
  void leave(std::int64_t next, const FrameRing& shown);
  void leave_rest_at(std::int64_t next);
  void reopen(std::int64_t next, const FrameRing& shown);
  bool grow();
  bool can_read(const LiveClip& clip) const;
  void continue_from(const FrameRing& made);
  Milliseconds end_of_last_sign() const noexcept;
  void cut(std::int64_t end);
  void end_with_last_sign();
  void forget_places();
  bool finish_sign(std::int64_t next, const FrameRing& shown);
  void continue_as_captured(std::size_t place);
  void report_places(const Entry& entry, std::int64_t from);
  Milliseconds time_of(std::int64_t frames) const noexcept;

  SharedSigningCache& cache_;
  PlayerOptions options_;
  OpenRecordings open_;
  PlaceQueue queue_;
  std::unique_ptr<StreamSetup> setup_;  ///< set by the first clip, then constant
  OtherBodies bodies_;

  State state_ = State::nothing;
  ClipChain chain_;  ///< ends with the tail; empty in State::nothing
  LastSign last_sign_;

  std::map<std::size_t, PartsOfPlaces> parts_;  ///< by the first of their places
  Round round_;                                 ///< of this utterance, or of this round of a loop
  Round last_round_;                            ///< the previous one of a loop

  LiveCurves curves_;  ///< over the timeline's frames
  Timeline timeline_;
  Reports reports_;
};

}  // namespace signweave
