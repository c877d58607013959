#include "signweave/notation/utterance_ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "signweave/core/text.h"

namespace signweave::utterances {
namespace {

/// The places of each gloss, in order; with token 0 all of them.
using PlacesByName = std::map<std::pair<std::string_view, std::size_t>, std::vector<std::size_t>>;

PlacesByName places_by_name(const std::vector<Place>& places) {
  PlacesByName named;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].kind != Place::Kind::gloss) continue;
    const GlossRef& gloss = places[i].gloss;
    named[{gloss.gloss, 0}].push_back(i);
    if (gloss.token > 0) named[{gloss.gloss, gloss.token}].push_back(i);
  }
  return named;
}

/// kNoPlace if there is none.
std::size_t last_place_of(const OpenEnd& end, std::size_t places, const PlacesByName& named) {
  std::size_t last = places - 1;
  if (end.extent.kind == Extent::Kind::count) {
    if (end.extent.count == 0 || end.extent.count >= places) return kNoPlace;
    last = end.after + end.extent.count;
  } else if (end.extent.kind == Extent::Kind::named) {
    const auto found = named.find({end.extent.name.gloss, end.extent.name.token});
    if (found == named.end()) return kNoPlace;
    const auto next = std::ranges::upper_bound(found->second, end.after);
    if (next == found->second.end()) return kNoPlace;
    last = *next;
  }
  if (last >= places || (last == end.after && end.of == OpenEnd::Of::hold)) return kNoPlace;
  return last;
}

void set_end(Utterance& utterance, const OpenEnd& end, std::size_t last) {
  if (end.of == OpenEnd::Of::hold) {
    utterance.holds[end.index].until = last;
  } else if (end.of == OpenEnd::Of::non_manual) {
    utterance.non_manuals[end.index].last = last;
  } else {
    utterance.places[end.place].parts[end.index].places = last == kNoPlace ? 0 : last - end.place + 1;
  }
}

}  // namespace

void finish_ends(Utterance& utterance, std::span<const OpenEnd> ends, Cursor& cursor) {
  const bool names =
      std::ranges::any_of(ends, [](const OpenEnd& end) { return end.extent.kind == Extent::Kind::named; });
  const PlacesByName named = names ? places_by_name(utterance.places) : PlacesByName();
  const bool sound = cursor.fault_count() == 0;  // otherwise the place may be among what was left out
  for (const OpenEnd& end : ends) {
    const std::size_t last = last_place_of(end, utterance.places.size(), named);
    set_end(utterance, end, last);
    if (last != kNoPlace || !sound) continue;
    const WordSpan at = end.extent.at;
    cursor.report(UtteranceFault::Kind::no_such_place, at,
                  fmt::format("'{}' finds no place behind this one; name one that comes later",
                              printable(cursor.text().substr(at.begin, at.end - at.begin))));
  }
  for (const OpenEnd& end : ends) {
    if (end.of == OpenEnd::Of::part)
      std::erase_if(utterance.places[end.place].parts, [](const PlacePart& one) { return one.places == 0; });
  }
  std::erase_if(utterance.holds, [](const HandHold& one) { return one.until == kNoPlace; });
  std::erase_if(utterance.non_manuals, [](const NonManual& one) { return one.last == kNoPlace; });
}

}  // namespace signweave::utterances
