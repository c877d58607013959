#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/live/open_recordings.h"
#include "signweave/live/player.h"
#include "signweave/live/shared_signing_cache.h"

/// Inside this module only.
namespace signweave {

/// What a player is to sign, and which token fills each place of it. Places count from the first one that is kept.
/// Belongs to one thread.
class PlaceQueue {
 public:
  /// All of them must outlive it.
  PlaceQueue(SharedSigningCache& base, OpenRecordings& open, const PlayerOptions& options);

  /// What fills a place once it is decided.
  struct Decision {
    std::shared_ptr<const Contents> contents;
    Candidate candidate;
  };

  /// Throws what `candidates_for` throws for one of the places, Error{bad_input} where a pause is longer than
  /// kLongestPause, or where there would be more than kMostPlaces with those that wait already and are to stay.
  void check(const Utterance& utterance, bool after_those_waiting) const;
  /// These places, which are checked, instead of all others.
  void replace(const Utterance& utterance);
  /// These after the others.
  void add(const Utterance& utterance);
  void set_loop(bool loop) noexcept { loop_ = loop; }
  /// Leaves out places that are over, where there are many: how many. All others count from so much less then.
  std::size_t forget() noexcept;
  std::size_t forgotten() const noexcept { return forgotten_; }

  bool has_next() const noexcept { return next_ < places_.size() || begins_anew(); }
  /// True where a loop has come round.
  bool begins_anew() const noexcept { return loop_ && next_ >= places_.size() && !places_.empty(); }
  bool empty() const noexcept { return places_.empty(); }
  /// The place that is signed next, which is not given again, whatever happens.
  std::size_t take_next() noexcept;
  /// Goes on with that place.
  void go_on_at(std::size_t place) noexcept { next_ = place; }

  Milliseconds pause_before(std::size_t place) const noexcept { return places_[place].pause_before; }
  /// Which token fills a place: chosen with the one before it, and with as many after it as are known and looked at.
  /// Throws where none can.
  const Decision& decide(std::size_t place);
  const Candidate& chosen(std::size_t place) const noexcept { return decisions_[place]->candidate; }
  /// True where a decided place goes on from the signs of the one before it in their recording.
  bool follows(const Candidate& before, std::size_t place) const;
  /// The same of a place that need not be decided yet.
  bool will_follow(const Candidate& before, std::size_t place);

  static constexpr Milliseconds kLongestPause{60'000};
  /// As many places may wait; and as many that are over are kept, for `seek`.
  static constexpr std::size_t kMostPlaces = 10'000;
  static constexpr std::size_t kKeptPlaces = 1'000;
  /// Pieces of recordings in one utterance; each is looked up by itself.
  static constexpr std::size_t kMostPieces = 256;

 private:
  bool decided_well(std::size_t place) const noexcept;

  SharedSigningCache& base_;
  OpenRecordings& open_;
  const PlayerOptions& options_;
  bool loop_;
  std::vector<Place> places_;
  std::vector<std::unique_ptr<const Decision>> decisions_;  ///< [place]; null: not yet
  std::size_t next_ = 0;                                    ///< the place that is signed next
  std::size_t forgotten_ = 0;                               ///< places that came before those, since the last `replace`
};

}  // namespace signweave
