#include "signweave/live/place_queue.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/choose/select.h"
#include "signweave/core/error.h"

namespace signweave {

PlaceQueue::PlaceQueue(SharedSigningCache& cache, OpenRecordings& open, const PlayerOptions& options)
    : cache_(cache), open_(open), options_(options), loop_(options.loop) {}

void PlaceQueue::check(const Utterance& utterance, bool after_those_waiting) const {
  if (utterance.places.empty()) return;
  const bool has_parts = std::ranges::any_of(utterance.places, [](const Place& place) { return !place.parts.empty(); });
  if (has_parts || !utterance.holds.empty() || !utterance.non_manuals.empty()) {
    throw Error(
        ErrorCode::unsupported,
        "a stream signs with the whole body; leave out what single hands, the head or the face do, or use sign");
  }
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
  cache_.check(cache_.database().contents(), utterance.places);
}

void PlaceQueue::replace(const Utterance& utterance) {
  places_ = utterance.places;
  decisions_.clear();
  decisions_.resize(places_.size());
  next_ = 0;
  forgotten_ = 0;
}

void PlaceQueue::add(const Utterance& utterance) {
  places_.insert(places_.end(), utterance.places.begin(), utterance.places.end());
  decisions_.resize(places_.size());
}

/// Bounds the memory of an utterance that lasts for hours.
std::size_t PlaceQueue::forget() noexcept {
  if (loop_ || next_ < 2 * kKeptPlaces) return 0;
  const std::size_t count = next_ - kKeptPlaces;
  const auto over = static_cast<std::ptrdiff_t>(count);
  places_.erase(places_.begin(), places_.begin() + over);
  decisions_.erase(decisions_.begin(), decisions_.begin() + over);
  next_ -= count;
  forgotten_ += count;
  return count;
}

std::size_t PlaceQueue::take_next() noexcept {
  if (next_ >= places_.size()) next_ = 0;
  return next_++;
}

const PlaceQueue::Decision& PlaceQueue::decide(std::size_t place) {
  std::unique_ptr<const Decision>& decision = decisions_[place];
  if (decision) return *decision;
  const Snapshot& snapshot = open_.snapshot();
  const std::shared_ptr<const Contents>& contents = snapshot.shared_contents();
  const std::shared_ptr<const std::vector<Candidate>> own = cache_.candidates(contents, places_[place]);
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
      choices.push_back({*cache_.candidates(contents, places_[i]), places_[i].pause_before});
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

/// True if no further context can improve the decision of a place.
bool PlaceQueue::decided_well(std::size_t place) const noexcept {
  return place + options_.look_ahead < places_.size();
}

bool PlaceQueue::follows(const Candidate& before, std::size_t place) const {
  if (place == 0 || !decisions_[place - 1] || places_[place].pause_before > Milliseconds(0)) return false;
  const Decision& now = *decisions_[place];
  return decisions_[place - 1]->contents == now.contents && are_neighbours(*now.contents, before, now.candidate);
}

bool PlaceQueue::will_follow(const Candidate& before, std::size_t place) {
  if (place >= places_.size() || places_[place].pause_before > Milliseconds(0)) return false;
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
