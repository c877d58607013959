#include "signweave/live/place_queue.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "signweave/choose/inflect.h"
#include "signweave/choose/non_manuals.h"
#include "signweave/choose/part_choice.h"
#include "signweave/choose/select.h"
#include "signweave/choose/space_gaze.h"
#include "signweave/core/error.h"
#include "signweave/database/signer_dominance.h"

namespace signweave {
namespace {

bool has_parts(const Utterance& utterance) {
  return std::ranges::any_of(utterance.places, [](const Place& place) { return !place.parts.empty(); });
}

/// The last of the places that overlapping parts tie to one of them and those after it.
std::size_t last_tied_to(std::span<const Place> places, std::size_t place) noexcept {
  std::size_t last = place;
  for (std::size_t i = place; i <= last; ++i) {
    for (const PlacePart& part : places[i].parts) {
      last = std::max(last, std::min(i + std::max<std::size_t>(part.places, 1), places.size()) - 1);
    }
  }
  return last;
}

/// Parts, holds and non-manuals must accompany places of their utterance, and not too many.
void check_ranges(const Utterance& utterance, bool follows) {
  const auto require = [&](std::size_t first, std::size_t last, bool at_once) {
    if (first > last || last >= utterance.places.size()) {
      throw Error(ErrorCode::bad_input, fmt::format("places {} to {} are not in an utterance of {}", first + 1,
                                                    last + 1, utterance.places.size()));
    }
    if (at_once && last - first >= PlaceQueue::kMostTied) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("in a stream, a part or an expression lasts for at most {} signs; it lasts for {} here",
                              PlaceQueue::kMostTied, last - first + 1));
    }
  };
  for (std::size_t first = 0; first < utterance.places.size();) {
    const std::size_t last = last_tied_to(utterance.places, first);
    require(first, last, true);
    first = last + 1;
  }
  for (const HandHold& held : utterance.holds) {
    require(held.from == kPlaceBefore ? 0 : held.from + 1, held.until, false);
    if (held.from != kPlaceBefore || follows) continue;
    throw Error(ErrorCode::bad_input, "nothing to hold: no place is before it; begin with the sign to be held");
  }
  for (const NonManual& one : utterance.non_manuals) require(one.first, one.last, true);
}

}  // namespace

PlaceQueue::PlaceQueue(SharedSigningCache& cache, OpenRecordings& open, const PlayerOptions& options)
    : cache_(cache), open_(open), options_(options), loop_(options.loop) {}

void PlaceQueue::check(const Utterance& utterance, bool after_those_waiting) const {
  if (utterance.places.empty()) return;
  const std::size_t waiting = after_those_waiting ? places_.size() - next_ : 0;
  if (waiting + utterance.places.size() > kMostPlaces) {
    throw Error(ErrorCode::bad_input, fmt::format("{} signs would wait, more than {}; send the others later",
                                                  waiting + utterance.places.size(), kMostPlaces));
  }
  if (std::ranges::count(utterance.places, Place::Kind::piece, &Place::kind) >
      static_cast<std::ptrdiff_t>(kMostPieces)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("more than {} pieces of recordings at once; send the others later", kMostPieces));
  }
  for (const Place& place : utterance.places) {
    if (place.pause_before <= kLongestPause) continue;
    throw Error(ErrorCode::bad_input, fmt::format("a pause of {} ms is longer than {} ms; leave out some of its signs",
                                                  place.pause_before.count(), kLongestPause.count()));
  }
  const std::shared_ptr<const Contents> contents = cache_.database().contents();
  cache_.check(contents, utterance.places);
  if (has_parts(utterance)) part_choices(*contents, utterance, Side::right);
  const Utterance known = after_those_waiting ? with_known_loci(utterance) : with_gazes_at_loci(utterance);
  for (std::size_t i = 0; i < known.places.size(); ++i) check_loci(known.places[i].space, known.loci, i);
  check_non_manuals(known, options_.synthesis.non_manuals);
  check_ranges(utterance, after_those_waiting && !places_.empty());
}

/// With the loci that were set up before it, and gazes at them.
Utterance PlaceQueue::with_known_loci(const Utterance& utterance) const {
  Utterance known = utterance;
  if (!known.places.empty()) known.loci.insert(known.loci.begin(), loci_.begin(), loci_.end());
  for (std::size_t i = 0; i < loci_.size() && i < known.loci.size(); ++i) known.loci[i].from = 0;
  return with_gazes_at_loci(std::move(known));
}

void PlaceQueue::replace(const Utterance& utterance) {
  places_.clear();
  decisions_.clear();
  usual_.clear();
  tied_.clear();
  borders_.clear();
  holds_.clear();
  non_manuals_.clear();
  loci_.clear();
  next_ = 0;
  forgotten_ = 0;
  forgotten_non_manuals_ = 0;
  add(utterance);
}

/// The same expression or gaze until the place before, or null. Together they are over at most kMostTied places.
NonManual* PlaceQueue::continued_by(const NonManual& one) noexcept {
  if (one.kind == NonManual::Kind::mouthing || one.begin != Milliseconds(0)) return nullptr;
  for (std::size_t i = first_over(one.last); i < non_manuals_.size(); ++i) {
    NonManual& before = non_manuals_[i];
    const bool is_same = before.kind == one.kind && before.what == one.what && before.end == Milliseconds(0);
    if (is_same && before.last + 1 == one.first) return &before;
  }
  return nullptr;
}

std::optional<std::size_t> PlaceQueue::continued(const Utterance& utterance) {
  if (utterance.places.empty() || places_.empty()) return std::nullopt;
  for (NonManual one : utterance.non_manuals) {
    if (one.first > 0) break;
    one.first += places_.size();
    one.last += places_.size();
    if (const NonManual* const before = continued_by(one)) {
      return forgotten_non_manuals_ + static_cast<std::size_t>(before - non_manuals_.data());
    }
  }
  return std::nullopt;
}

void PlaceQueue::add(const Utterance& requested, bool can_go_on) {
  if (requested.places.empty()) return;
  const Utterance utterance = with_known_loci(requested);
  const std::size_t first = places_.size();
  Side usual = options_.synthesis.handedness.value_or(Side::right);
  if (!options_.synthesis.handedness && (has_parts(utterance) || !utterance.holds.empty())) {
    const Snapshot& snapshot = open_.snapshot();
    const auto tokens = cache_.candidates(snapshot.shared_contents(), utterance.places.front());
    usual = dominance_of(snapshot, tokens->front().recording).hand.value_or(Side::right);
  }
  places_.insert(places_.end(), utterance.places.begin(), utterance.places.end());
  decisions_.resize(places_.size());
  usual_.resize(places_.size(), usual);
  tied_.resize(places_.size(), false);
  for (std::size_t i = first; i < places_.size(); ++i) {
    for (const PlacePart& part : places_[i].parts) {
      const std::size_t end = std::min(i + part.places, places_.size());
      std::fill(tied_.begin() + static_cast<std::ptrdiff_t>(i), tied_.begin() + static_cast<std::ptrdiff_t>(end), true);
    }
  }
  for (std::size_t i = first; i < places_.size(); ++i) {
    if (places_[i].space.repetitions > 1) tied_[i] = true;  // its repetitions are placed together
  }
  for (LocusSetup setup : requested.loci) {
    setup.from += first;
    loci_.push_back(std::move(setup));
  }
  for (const std::size_t border : clip_borders(utterance)) borders_.insert(first + border);
  for (ChannelHold held : channel_holds(utterance, usual)) {
    held.from = held.from == kPlaceBefore ? first - 1 : held.from + first;
    held.until += first;
    std::fill(tied_.begin() + static_cast<std::ptrdiff_t>(held.from) + 1,
              tied_.begin() + static_cast<std::ptrdiff_t>(held.until) + 1, true);
    holds_.push_back(held);
  }
  for (NonManual one : utterance.non_manuals) {
    one.first += first;
    one.last += first;
    NonManual* const before = one.first == first && can_go_on ? continued_by(one) : nullptr;
    if (before == nullptr) {
      non_manuals_.push_back(std::move(one));
    } else {
      before->last = one.last;
      before->end = one.end;
    }
  }
}

std::size_t PlaceQueue::last_tied_to(std::size_t place) const noexcept {
  return signweave::last_tied_to(places_, place);
}

bool PlaceQueue::goes_on() const noexcept {
  if (next_ >= places_.size()) return false;
  for (std::size_t i = first_over(next_); i < non_manuals_.size() && non_manuals_[i].first < next_; ++i) {
    if (next_ <= non_manuals_[i].last) return true;
  }
  return false;
}

std::size_t PlaceQueue::first_over(std::size_t place) const noexcept {
  const std::size_t earliest = place + 1 - std::min(place + 1, kMostTied);
  const auto at = std::ranges::lower_bound(non_manuals_, earliest, {}, &NonManual::first);
  return static_cast<std::size_t>(at - non_manuals_.begin());
}

Utterance PlaceQueue::part(std::size_t first, std::size_t last) const {
  Utterance part{.places = {places_.begin() + static_cast<std::ptrdiff_t>(first),
                            places_.begin() + static_cast<std::ptrdiff_t>(last) + 1},
                 .holds = {},
                 .non_manuals = {}};
  return part;
}

std::optional<Side> PlaceQueue::wanted_hand(std::size_t place) const noexcept {
  return places_[place].dominant ? places_[place].dominant : options_.synthesis.handedness;
}

/// Bounds the memory of an utterance that lasts for hours.
std::size_t PlaceQueue::forget() noexcept {
  if (loop_ || next_ < 2 * kKeptPlaces) return 0;
  const std::size_t count = next_ - kKeptPlaces;
  const auto over = static_cast<std::ptrdiff_t>(count);
  places_.erase(places_.begin(), places_.begin() + over);
  decisions_.erase(decisions_.begin(), decisions_.begin() + over);
  usual_.erase(usual_.begin(), usual_.begin() + over);
  tied_.erase(tied_.begin(), tied_.begin() + over);
  std::set<std::size_t> borders;
  for (const std::size_t border : borders_) {
    if (border >= count) borders.insert(border - count);
  }
  borders_ = std::move(borders);
  std::erase_if(holds_, [&](const ChannelHold& held) { return held.from < count; });
  for (ChannelHold& held : holds_) {
    held.from -= count;
    held.until -= count;
  }
  forgotten_non_manuals_ += std::erase_if(non_manuals_, [&](const NonManual& one) { return one.first < count; });
  for (NonManual& one : non_manuals_) {
    one.first -= count;
    one.last -= count;
  }
  std::set<std::string> later;
  for (std::size_t i = loci_.size(); i-- > 0;) {
    loci_[i].from -= std::min(loci_[i].from, count);
    const bool is_replaced = loci_[i].from == 0 && !later.insert(loci_[i].name).second;
    if (is_replaced) loci_.erase(loci_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  next_ -= count;
  forgotten_ += count;
  return count;
}

std::size_t PlaceQueue::take_next() noexcept {
  if (next_ >= places_.size()) next_ = 0;
  return next_++;
}

/// Those that come near the loci of the place.
std::shared_ptr<const std::vector<Candidate>> PlaceQueue::candidates(const std::shared_ptr<const Contents>& contents,
                                                                     std::size_t place) const {
  const SpaceChange& change = places_[place].space;
  std::shared_ptr<const std::vector<Candidate>> all = cache_.candidates(contents, places_[place]);
  if (!change.from && !change.to && !change.at) return all;
  auto near = std::make_shared<std::vector<Candidate>>(*all);
  prefer_loci(open_.snapshot(), change, loci_, place, *near);
  return near;
}

const PlaceQueue::Decision& PlaceQueue::decide(std::size_t place) {
  std::unique_ptr<const Decision>& decision = decisions_[place];
  if (decision) return *decision;
  const Snapshot& snapshot = open_.snapshot();
  const std::shared_ptr<const Contents>& contents = snapshot.shared_contents();
  const std::shared_ptr<const std::vector<Candidate>> own = candidates(contents, place);
  if (own->size() == 1) {
    decision = std::make_unique<const Decision>(Decision{contents, own->front()});
    return *decision;
  }
  std::vector<Choice> choices;
  const bool after_another = place > 0 && decisions_[place - 1] && decisions_[place - 1]->contents == contents;
  if (after_another) choices.push_back({{decisions_[place - 1]->candidate}, Milliseconds(0)});
  const std::size_t last = std::min(place + options_.look_ahead, places_.size() - 1);
  choices.push_back({*own, places_[place].pause_before});
  for (std::size_t i = place + 1; i <= last; ++i) {
    try {
      choices.push_back({*candidates(contents, i), places_[i].pause_before});
    } catch (const Error&) {  // reported when the place is due
      break;
    }
  }
  const Seconds transition = cache_.durations(contents, options_.synthesis.duration)->mean;
  const Selection selection = select(snapshot, choices, {.transition = transition});
  const std::size_t at = after_another ? 1 : 0;
  decision =
      std::make_unique<const Decision>(Decision{contents, std::move(choices[at].candidates[selection.chosen[at]])});
  return *decision;
}

const PlaceQueue::Decision& PlaceQueue::decide_now(std::size_t place) {
  std::unique_ptr<const Decision>& decision = decisions_[place];
  if (decision && decision->contents != open_.snapshot().shared_contents()) decision.reset();
  return decide(place);
}

/// True if no further context can improve the decision of a place.
bool PlaceQueue::decided_well(std::size_t place) const noexcept {
  return place + options_.look_ahead < places_.size();
}

bool PlaceQueue::follows(const Candidate& before, std::size_t place) const {
  if (place == 0 || !decisions_[place - 1] || places_[place].pause_before > Milliseconds(0)) return false;
  if (wanted_hand(place) != wanted_hand(place - 1)) return false;
  if (is_changed(places_[place]) || is_changed(places_[place - 1])) return false;
  const Decision& now = *decisions_[place];
  return decisions_[place - 1]->contents == now.contents && are_neighbours(*now.contents, before, now.candidate);
}

bool PlaceQueue::will_follow(const Candidate& before, std::size_t place) {
  if (place >= places_.size() || places_[place].pause_before > Milliseconds(0)) return false;
  if (is_tied(place) || wanted_hand(place) != wanted_hand(place - 1)) return false;
  const bool was_decided = decisions_[place] != nullptr;
  try {
    decide(place);
    if (follows(before, place)) return true;
  } catch (const Error&) {  // reported when the place is due
    return false;
  }
  if (!was_decided && !decided_well(place)) decisions_[place].reset();
  return false;
}

}  // namespace signweave
