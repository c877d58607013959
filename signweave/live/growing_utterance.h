#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/prefetch.h"
#include "signweave/live/frame_ring.h"
#include "signweave/live/living_rest.h"
#include "signweave/live/open_recordings.h"
#include "signweave/live/player.h"
#include "signweave/live/signing_base.h"
#include "signweave/live/weaver.h"

/// Inside this module only.
namespace signweave {

/// The frames of an utterance while places are added to it: a timeline that grows as far as it is asked to, and is
/// taken back where frames that nobody took yet are to be others. Its frames are counted from the first one that a
/// player shows. Belongs to one thread.
class GrowingUtterance {
 public:
  GrowingUtterance(SigningBase& base, const PlayerOptions& options);

  /// Throws what `candidates_for` throws for one of the places, Error{bad_input} for a pause longer than kLongestPause,
  /// or where with `waiting` places there would be more than kMostPlaces.
  void check(const Utterance& utterance, std::size_t waiting);

  // Each of these is told the first frame that was not taken (`next`), and the ring with those before it. What is
  // known of the timeline may end earlier afterwards, but not before `next`.

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

  const StreamHeader* header() const noexcept { return header_ ? &*header_ : nullptr; }

  /// The timeline is known up to this frame.
  std::int64_t end() const noexcept { return end_; }
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
  bool ended() const noexcept { return state_ == State::ended && !has_next(); }

  /// As many shown frames must be kept.
  std::int64_t history() const noexcept;

  static constexpr Milliseconds kLongestPause{60'000};
  /// As many places may wait; and as many that are over are kept, for `seek`.
  static constexpr std::size_t kMostPlaces = 10'000;
  static constexpr std::size_t kKeptPlaces = 1'000;
  /// Pieces of recordings in one utterance; each is looked up by itself.
  static constexpr std::size_t kMostPieces = 256;
  /// A sign that ends within this is finished where another utterance begins.
  static constexpr Seconds kFinished{1.0};

 private:
  using WovenPtr = std::shared_ptr<Woven>;
  enum class State {
    nothing,  ///< no frame is known
    at_core,  ///< the timeline ends with the tail's core: what comes next is joined there
    resting,  ///< the tail is the rest, which goes on
    ended,    ///< the last retraction is over (Idle::end)
  };
  /// Frames of the timeline, all from one thing.
  struct Segment {
    FrameRange frames;
    WovenPtr woven;                      ///< captured frames of it, or
    std::shared_ptr<const Motion> made;  ///< a transition that begins at `made_begin`
    std::int64_t made_begin = 0;
  };
  /// What fills a place once it is decided.
  struct Decision {
    std::shared_ptr<const Contents> contents;
    Candidate candidate;
  };
  /// A stretch of this utterance as it came to lie, with the places that it is of.
  struct Entry {
    WovenPtr woven;
    std::size_t first = 0;
    std::size_t last = 0;    ///< inclusive
    bool joined = false;     ///< to the entry before
    std::int64_t begin = 0;  ///< of the utterance: where its transition or its preparation begins
    std::int64_t core = 0;   ///< of the utterance
  };

  bool has_next() const noexcept { return next_ < places_.size() || (loop_ && !places_.empty()); }
  const Decision& decide(std::size_t place);
  bool decided_well(std::size_t place) const noexcept;
  bool goes_on(const Candidate& candidate, std::size_t place);
  Stretch stretch_of(const Decision& decision, Milliseconds pause);
  std::shared_ptr<const MotionSource> on_skeleton(const RecordingInfo& info,
                                                  std::shared_ptr<const MotionSource> source);
  void tell_mapping(const Entry& entry);
  void begin_header(const Stretch& stretch, const std::shared_ptr<const Contents>& contents);
  void sign_next();
  void go_to_rest();
  std::shared_ptr<const Motion> join(Woven& a, Woven& b);
  WovenPtr living_rest() const;
  WovenPtr history_of(std::int64_t next, const FrameRing& shown) const;
  void leave(std::int64_t next, const FrameRing& shown);
  void reopen(std::int64_t next, const FrameRing& shown);
  bool grow();
  bool can_read(const Woven& woven) const;
  void go_on_from(const FrameRing& made);
  Milliseconds end_of_last_sign() const noexcept;
  void cut(std::int64_t end);
  void forget_places();
  bool finish_sign(std::int64_t next);
  void append(FrameRange frames, WovenPtr woven);
  void append(FrameRange frames, std::shared_ptr<const Motion> made);
  void go_on_as_captured(std::size_t place);
  void tell_places(const Entry& entry, std::int64_t from);
  Milliseconds time_of(std::int64_t frames) const noexcept;
  void read_segment(const Segment& segment, FrameRange frames, FrameRing& ring);

  SigningBase& base_;
  PlayerOptions options_;
  bool loop_;
  OpenRecordings open_;

  std::vector<Place> places_;
  std::vector<std::unique_ptr<const Decision>> decisions_;  ///< [place]; null: not yet
  std::size_t next_ = 0;                                    ///< the place that is signed next
  std::size_t forgotten_ = 0;                               ///< places of this utterance that came before those

  // Of the first decision; they stay.
  std::optional<StreamHeader> header_;
  std::shared_ptr<const DurationFit> fit_;
  std::shared_ptr<const SignerRig> rig_;
  std::shared_ptr<const CapturedSpans> spans_;
  std::optional<Weaver> weaver_;
  std::shared_ptr<const LivingRest> living_;
  std::string settings_key_;  ///< what all its transitions depend on

  /// Recordings of other skeletons as they are shown, by the generation of their motion.
  std::map<std::uint64_t, std::weak_ptr<const MotionSource>> retargeted_;
  std::set<std::string> told_;  ///< recordings of which was told how they are shown

  State state_ = State::nothing;
  WovenPtr tail_;                        ///< what was laid last
  WovenPtr last_sign_;                   ///< what was signed last; the rest may follow
  std::optional<Candidate> last_signs_;  ///< of it: what may go on from there
  std::vector<Entry> entries_;           ///< of this utterance, or this round of a loop
  std::vector<Entry> last_round_;        ///< of the round before
  std::deque<Segment> segments_;
  std::int64_t end_ = 0;
  std::deque<PlayerEvent> events_;  ///< `frame` counts the timeline's
  std::vector<float> track_values_;
  std::vector<std::span<float>> track_spans_;
};

}  // namespace signweave
