#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/notation/utterance_space.h"

namespace signweave::utterances {
namespace {

using enum UtteranceFault::Kind;

constexpr std::size_t kMostSuggested = 100;  // loci that are compared with an unknown one

/// Reports a locus that is not known at a place. `from` is the first place at which it is set up, if any.
void report_unknown(Cursor& cursor, WordSpan at, const std::string& name, std::size_t place, const std::size_t* from,
                    std::span<const LocusSetup> setups) {
  std::string why;
  if (cursor.fault_count() < kMostUtteranceFaults) {  // others are only counted
    const LocusSetup later{name, {}, from == nullptr ? 0 : *from};
    const auto near = from == nullptr ? setups.first(std::min(setups.size(), kMostSuggested)) : std::span(&later, 1);
    try {
      resolve({.kind = LocusRef::Kind::name, .name = name, .numbers = {}}, near, place, {});
    } catch (const Error& error) {
      why = error.what();
    }
  }
  cursor.report(unknown_locus, at, std::move(why));
}

/// What a place has of a value that cannot be kept.
void leave_out(SpaceValue value, SpaceChange& change) {
  copy_value(value, {}, change);
  if (value == SpaceValue::along || value == SpaceValue::past) change.keeps_turn = false;
}

}  // namespace

void copy_value(SpaceValue value, const SpaceChange& from, SpaceChange& to) {
  switch (value) {
    case SpaceValue::from:
      to.from = from.from;
      break;
    case SpaceValue::to:
      to.to = from.to;
      break;
    case SpaceValue::at:
      to.at = from.at;
      break;
    case SpaceValue::along:
      to.along = from.along;
      break;
    case SpaceValue::past:
      to.past = from.past;
      break;
    case SpaceValue::unturned:
      to.keeps_turn = from.keeps_turn;
      break;
    case SpaceValue::move:
      to.move = from.move;
      break;
    case SpaceValue::turn:
      to.turn = from.turn;
      break;
    case SpaceValue::scale:
      to.scale = from.scale;
      break;
    case SpaceValue::size:
      to.size = from.size;
      break;
    case SpaceValue::speed:
      to.speed = from.speed;
      break;
    case SpaceValue::repeat:
      to.repetitions = from.repetitions;
      to.outward = from.outward;
      break;
    case SpaceValue::mirrored:
      to.mirrored = from.mirrored;
      break;
  }
}

void SpaceOfPlaces::set_up(LocusOption option, std::size_t place, Cursor& cursor) {
  if (!taken_.emplace(place, option.setup.name).second) {
    cursor.report(repeated_option, option.at,
                  fmt::format("'@{}' is set up twice at the same place; keep one", printable(option.setup.name)));
    return;
  }
  option.setup.from = place;
  setups_.push_back(std::move(option));
}

/// Gives a place what it does not have.
void SpaceOfPlaces::change(SpaceOptions options, std::size_t place, Utterance& utterance, Cursor& cursor) {
  SpaceChange& own = utterance.places[place].space;
  SpaceChange changed = own;
  for (const SpaceValue value : kSpaceValues) {
    if ((options.given & bit_of(value)) == 0) continue;
    const bool known = (given_[place] & bit_of(value)) != 0;
    if (known && is_spread(value)) continue;
    if (known) {
      cursor.report(repeated_option, options.one_place_at,
                    fmt::format("'{}' is given twice; keep one", name_of(value)));
      return;
    }
    copy_value(value, options.change, changed);
  }
  try {
    check(changed);
  } catch (const Error& error) {
    cursor.report(bad_option, options.one_place_at, error.what());
    return;
  }
  if (changed.keeps_turn && changed.along.empty() && !changed.past) {
    cursor.report(bad_option, options.one_place_at,
                  "'unturned' is about a path; add one: along @left @right, or past @left");
    return;
  }
  given_[place] |= options.given;
  own = std::move(changed);
  for (LocusUse& use : options.uses) uses_.push_back({std::move(use), place});
}

void SpaceOfPlaces::spread(const SpaceOptions& options, PlaceRange range, Utterance& utterance) {
  for (std::size_t place = range.first; place <= range.last; ++place) {
    for (const SpaceValue value : kSpaceValues) {
      if ((options.given & ~given_[place] & bit_of(value)) == 0) continue;
      copy_value(value, options.change, utterance.places[place].space);
    }
    given_[place] |= options.given;
  }
}

void SpaceOfPlaces::take(SpaceOptions options, PlaceRange range, Utterance& utterance, Cursor& cursor) {
  for (LocusOption& one : options.loci) set_up(std::move(one), range.first, cursor);
  if (options.given == 0) return;
  given_.resize(std::max(given_.size(), range.last + 1));
  if (range.first == range.last) return change(std::move(options), range.first, utterance, cursor);
  if (options.one_place_at != WordSpan{}) {
    cursor.report(bad_option, options.one_place_at,
                  "this changes a single sign, and the bracket has several; put it directly behind the sign");
    return;
  }
  spread(options, range, utterance);
}

void SpaceOfPlaces::finish(Utterance& utterance, Cursor& cursor, bool sound) {
  // An outer setup is read after those inside it, but comes first.
  std::ranges::sort(setups_, [](const LocusOption& a, const LocusOption& b) {
    return a.setup.from != b.setup.from ? a.setup.from < b.setup.from : a.at.begin < b.at.begin;
  });
  const bool report = sound && !cursor.words().follows;
  std::map<std::string_view, std::size_t> first;  // place of each name
  const auto is_known = [&](const LocusRef& locus) {
    return locus.kind != LocusRef::Kind::name || is_built_in_locus(locus.name) || first.contains(locus.name);
  };
  for (const LocusOption& one : setups_) {
    if (!report || is_known(one.setup.is)) {
      first.try_emplace(one.setup.name, one.setup.from);
      utterance.loci.push_back(one.setup);
    } else {
      report_unknown(cursor, one.at, one.setup.is.name, one.setup.from, nullptr, utterance.loci);
    }
  }
  if (!report) return;
  for (const Use& one : uses_) {
    const auto from = first.find(one.use.name);
    if (from != first.end() && from->second <= one.place) continue;
    report_unknown(cursor, one.use.at, one.use.name, one.place, from == first.end() ? nullptr : &from->second,
                   utterance.loci);
    leave_out(one.use.value, utterance.places[one.place].space);
  }
}

}  // namespace signweave::utterances
