#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "signweave/choose/candidate.h"
#include "signweave/choose/channel_clips.h"
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

  /// Throws what `candidates_for` throws for one of the places and what `author_non_manuals` and check_loci do;
  /// Error{bad_input} if a pause is longer than kLongestPause, more than kMostTied places belong together, or there
  /// would be more than kMostPlaces, including the waiting ones if `after_those_waiting`.
  void check(const Utterance& utterance, bool after_those_waiting) const;
  /// Replaces all places by these, which must be checked.
  void replace(const Utterance& utterance);
  /// Appends these places, which must be checked. An expression or a gaze that ends with the last place goes on in the
  /// same one of the first new place if `can_go_on`.
  void add(const Utterance& requested, bool can_go_on = true);
  /// The number of the non-manual that would go on.
  std::optional<std::size_t> continued(const Utterance& utterance);
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
  std::size_t next() const noexcept { return next_; }

  /// True if single channels do something else in this place than the body, or begin or end it there.
  bool is_tied(std::size_t place) const noexcept { return place < tied_.size() && tied_[place]; }
  /// The last place that a part accompanies of which one accompanies this place.
  std::size_t last_tied_to(std::size_t place) const noexcept;
  /// True if a clip must begin at a place that is tied to the one before it.
  bool is_border(std::size_t place) const noexcept { return borders_.contains(place); }
  /// True if the place to sign next is in the scope of a non-manual that began before it.
  bool goes_on() const noexcept;
  /// Places of the queue as an utterance of its own, without what accompanies others.
  Utterance part(std::size_t first, std::size_t last) const;
  /// The hand that is the dominant one in a place, and whether that was asked for.
  Side dominant(std::size_t place) const noexcept { return places_[place].dominant.value_or(usual_[place]); }
  std::optional<Side> wanted_hand(std::size_t place) const noexcept;
  /// Between places.
  const std::vector<ChannelHold>& holds() const noexcept { return holds_; }
  /// In the order of their begins.
  const std::vector<NonManual>& non_manuals() const noexcept { return non_manuals_; }
  /// The index of the first of them that may be over a place.
  std::size_t first_over(std::size_t place) const noexcept;
  /// How many of them were dropped with their places since the last `replace`.
  std::size_t forgotten_non_manuals() const noexcept { return forgotten_non_manuals_; }

  const SpaceChange& space(std::size_t place) const noexcept { return places_[place].space; }
  const std::vector<LocusSetup>& loci() const noexcept { return loci_; }

  Milliseconds pause_before(std::size_t place) const noexcept { return places_[place].pause_before; }
  /// Chooses the token of a place, given the one before it and up to `look_ahead` known places after it. Throws if
  /// there is none.
  const Decision& decide(std::size_t place);
  /// The same from the database as it is now.
  const Decision& decide_now(std::size_t place);
  bool is_decided(std::size_t place) const noexcept { return decisions_[place] != nullptr; }
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
  /// Maximum number of places that a part or a non-manual may accompany: they are signed at once.
  static constexpr std::size_t kMostTied = 64;

 private:
  bool decided_well(std::size_t place) const noexcept;
  std::shared_ptr<const std::vector<Candidate>> candidates(const std::shared_ptr<const Contents>& contents,
                                                           std::size_t place) const;
  Utterance with_known_loci(const Utterance& utterance) const;
  NonManual* continued_by(const NonManual& one) noexcept;

  SharedSigningCache& cache_;
  OpenRecordings& open_;
  const PlayerOptions& options_;
  bool loop_;
  std::vector<Place> places_;
  std::vector<std::unique_ptr<const Decision>> decisions_;  ///< [place]; null: undecided
  std::vector<Side> usual_;                                 ///< [place] the dominant hand if the place names none
  std::vector<bool> tied_;                                  ///< [place]
  std::set<std::size_t> borders_;                           ///< places at which parts or holds begin or end
  std::vector<ChannelHold> holds_;                          ///< between places
  std::vector<NonManual> non_manuals_;
  std::vector<LocusSetup> loci_;  ///< in the order of their places
  std::size_t forgotten_non_manuals_ = 0;
  std::size_t next_ = 0;       ///< the place to sign next
  std::size_t forgotten_ = 0;  ///< places dropped since the last `replace`
};

}  // namespace signweave
