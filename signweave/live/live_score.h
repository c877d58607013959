#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "signweave/core/prefetch.h"
#include "signweave/live/clip_chain.h"
#include "signweave/live/frame_ring.h"
#include "signweave/live/open_recordings.h"
#include "signweave/live/place_queue.h"
#include "signweave/live/player.h"
#include "signweave/live/shared_signing_cache.h"
#include "signweave/live/stream_setup.h"
#include "signweave/live/timeline.h"

/// Inside this module only.
namespace signweave {

/// The score of an utterance while places are added to it, and its timeline: they grow as far as they are asked to, and
/// are taken back where frames that nobody took yet are to be others. Frames are counted from the first one that a
/// player shows. Belongs to one thread.
class LiveScore {
 public:
  LiveScore(SharedSigningCache& base, const PlayerOptions& options);

  // Each of these is told the first frame that was not taken (`next`), and the ring with those before it. What is
  // known of the timeline may end earlier afterwards, but not before `next`. Throws as PlaceQueue; then nothing has
  // changed.

  /// These places instead of those that are not begun; a sign that has begun is finished where it ends soon.
  void replace(const Utterance& utterance, std::int64_t next, const FrameRing& shown);
  /// These places after the others.
  void add(const Utterance& utterance, std::int64_t next, const FrameRing& shown);
  /// Rests as the signer of a recording, before anything is signed. Throws Error{not_found}.
  void rest_in(const std::string& recording);
  /// Goes on at a moment of the utterance, in output frames from its first; clamped to what is decided. False where
  /// nothing is: then nothing has changed. The timeline then ends at `next` or later, and all of it from there on is
  /// new.
  bool seek(std::int64_t at, std::int64_t next);
  void set_loop(bool loop, std::int64_t next, const FrameRing& shown);

  const StreamHeader* header() const noexcept { return setup_ ? &setup_->header : nullptr; }
  /// What the timeline shows, with the frame of it that is shown next; see ShownScore.
  std::optional<ShownScore> score(std::int64_t next, std::size_t most_clips) const;
  std::shared_ptr<const MotionSource> rest() const noexcept { return setup_ ? setup_->living : nullptr; }

  /// The timeline is known up to this frame.
  std::int64_t end() const noexcept { return timeline_.end(); }
  /// Makes the timeline longer; false where nothing more can be known. Throws Error where a place cannot be signed; it
  /// is left out then, and the next call goes on.
  /// `shown` has the frames that are made.
  bool extend(const FrameRing& shown);
  /// Puts frames from the ring's end on into the ring, up to `until`, which must be known. Throws Error{corrupt}.
  void read(std::int64_t until, FrameRing& ring);
  /// Lets go of the database until it is needed again, and of the timeline before a frame.
  void let_go(std::int64_t taken) noexcept;

  /// The next event that belongs to a frame up to `frame`.
  std::optional<PlayerEvent> take_event(std::int64_t frame) noexcept;
  /// Brings near what take_event() reads, in two steps.
  void prefetch_state() const noexcept {
    prefetch(&state_, sizeof state_);
    prefetch(&events_, sizeof events_);
  }
  void prefetch_event() const noexcept {
    if (!events_.empty()) prefetch(&events_.front().frame, sizeof(std::uint64_t));
  }
  /// True where from this frame on nothing is left to sign.
  bool idle(std::int64_t frame) const noexcept;
  /// True where the last retraction is the end of the timeline.
  bool ended() const noexcept { return state_ == State::ended && !queue_.has_next(); }

  /// As many shown frames must be kept.
  std::int64_t history() const noexcept;

  /// A sign that ends within this is finished where another utterance begins.
  static constexpr Seconds kFinished{1.0};

 private:
  using ClipPtr = std::shared_ptr<LiveClip>;
  enum class State {
    nothing,  ///< no frame is known
    at_core,  ///< the timeline ends with the tail's core: what comes next is joined there
    resting,  ///< the tail is the rest, which goes on
    ended,    ///< the last retraction is over (Idle::end)
  };
  /// A clip of this utterance as it came to lie, with the places that it is of.
  struct Entry {
    ClipPtr clip;
    std::size_t first = 0;
    std::size_t last = 0;    ///< inclusive
    bool joined = false;     ///< to the entry before
    std::int64_t begin = 0;  ///< of the utterance: where its transition or its preparation begins
    std::int64_t core = 0;   ///< of the utterance
  };
  /// What was signed last; the rest may follow it.
  struct LastSign {
    ClipPtr clip;                    ///< null: nothing
    std::optional<Candidate> signs;  ///< what may go on from there
  };
  /// Recordings of other skeletons.
  struct OtherBodies {
    std::map<std::uint64_t, std::weak_ptr<const MotionSource>> shown;  ///< by the generation of their motion
    std::set<std::string> reported;  ///< recordings of which it was reported how they are shown
  };

  /// What was placed last: what comes next is joined to it.
  LiveClip& tail() const noexcept { return *chain_.back(); }
  MotionClip clip_of(const PlaceQueue::Decision& decision, std::size_t place);
  std::shared_ptr<const MotionSource> on_skeleton(const RecordingInfo& info,
                                                  std::shared_ptr<const MotionSource> source);
  void report_manner(const Entry& entry);
  void sign_next();
  void go_to_rest();
  std::shared_ptr<const Motion> join(LiveClip& a, LiveClip& b);
  ClipPtr history_of(std::int64_t next, const FrameRing& shown) const;
  void leave(std::int64_t next, const FrameRing& shown);
  void leave_rest_at(std::int64_t next);
  void reopen(std::int64_t next, const FrameRing& shown);
  bool grow();
  bool can_read(const LiveClip& clip) const;
  void go_on_from(const FrameRing& made);
  Milliseconds end_of_last_sign() const noexcept;
  void cut(std::int64_t end);
  void end_with_last_sign();
  void forget_places();
  bool finish_sign(std::int64_t next);
  void go_on_as_captured(std::size_t place);
  void report_places(const Entry& entry, std::int64_t from);
  Milliseconds time_of(std::int64_t frames) const noexcept;

  SharedSigningCache& base_;
  PlayerOptions options_;
  OpenRecordings open_;
  PlaceQueue queue_;
  std::unique_ptr<StreamSetup> setup_;  ///< from the first clip on; it stays
  OtherBodies bodies_;

  State state_ = State::nothing;
  ClipChain chain_;  ///< ends with the tail; empty in State::nothing
  LastSign last_sign_;
  std::vector<Entry> entries_;     ///< of this utterance, or this round of a loop
  std::vector<Entry> last_round_;  ///< of the round before
  Timeline timeline_;
  std::deque<PlayerEvent> events_;  ///< `frame` counts the timeline's
};

}  // namespace signweave
