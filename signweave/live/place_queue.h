#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/live/open_recordings.h"
#include "signweave/live/player.h"
#include "signweave/live/shared_signing_cache.h"

/// Internal to this module.
namespace signweave {

/// The places that a player is to sign, and the token chosen for each. Places are numbered from the first stored one.
/// Used by one thread.
class PlaceQueue {
 public:
  /// All arguments must outlive it.
  PlaceQueue(SharedSigningCache& cache, OpenRecordings& open, const PlayerOptions& options);

  /// The choice for a place.
  struct Decision {
    std::shared_ptr<const Contents> contents;
    Candidate candidate;
  };

  /// Throws what `candidates_for` throws for one of the places; Error{bad_input} if a pause is longer than
  /// kLongestPause, or if there would be more than kMostPlaces, including the waiting ones if `after_those_waiting`.
  void check(const Utterance& utterance, bool after_those_waiting) const;
  /// Replaces all places by these, which must be checked.
  void replace(const Utterance& utterance);
  /// Appends these places, which must be checked.
  void add(const Utterance& utterance);
  void set_loop(bool loop) noexcept { loop_ = loop; }
  /// Drops finished places if there are many. Returns how many; the numbers of all others decrease by it.
  std::size_t forget() noexcept;
  std::size_t forgotten() const noexcept { return forgotten_; }

  bool has_next() const noexcept { return next_ < places_.size() || restarts(); }
  /// True if a loop starts its next round.
  bool restarts() const noexcept { return loop_ && next_ >= places_.size() && !places_.empty(); }
  bool empty() const noexcept { return places_.empty(); }
  /// Takes the place to sign next. It is not returned again, even after an error.
  std::size_t take_next() noexcept;
  /// Continues with this place.
  void continue_at(std::size_t place) noexcept { next_ = place; }

  Milliseconds pause_before(std::size_t place) const noexcept { return places_[place].pause_before; }
  /// Chooses the token of a place, given the one before it and up to `look_ahead` known places after it. Throws if
  /// there is none.
  const Decision& decide(std::size_t place);
  const Candidate& chosen(std::size_t place) const noexcept { return decisions_[place]->candidate; }
  /// True if the token of a decided place directly follows the signs of `before` in their recording.
  bool follows(const Candidate& before, std::size_t place) const;
  /// The same for a place that need not be decided yet.
  bool will_follow(const Candidate& before, std::size_t place);

  static constexpr Milliseconds kLongestPause{60'000};
  /// Maximum number of waiting places, and number of finished places kept for `seek`.
  static constexpr std::size_t kMostPlaces = 10'000;
  static constexpr std::size_t kKeptPlaces = 1'000;
  /// Maximum number of pieces of recordings in one utterance; each is looked up separately.
  static constexpr std::size_t kMostPieces = 256;

 private:
  bool decided_well(std::size_t place) const noexcept;

  SharedSigningCache& cache_;
  OpenRecordings& open_;
  const PlayerOptions& options_;
  bool loop_;
  std::vector<Place> places_;
  std::vector<std::unique_ptr<const Decision>> decisions_;  ///< [place]; null: undecided
  std::size_t next_ = 0;                                    ///< the place to sign next
  std::size_t forgotten_ = 0;                               ///< places dropped since the last `replace`
};

}  // namespace signweave
