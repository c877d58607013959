#include "signweave/formats/anvil/times.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "signweave/core/text.h"
#include "signweave/formats/eaf/parse.h"

namespace signweave::anvil {
namespace {

class Times {
 public:
  Times(const eaf::Xml& xml, std::vector<Track>& tracks, std::vector<Notice>& notices)
      : xml_(xml), tracks_(tracks), notices_(notices) {}

  void run() {
    for (const std::size_t t : references_first()) {
      Track& track = tracks_[t];
      switch (track.kind) {
        case TrackKind::primary:
          for (Element& one : track.elements) one.span = own_span(one);
          break;
        case TrackKind::point:
          for (Element& one : track.elements) one.span = own_point(one);
          break;
        case TrackKind::singleton:
          for (Element& one : track.elements) take_reference(track, one);
          break;
        case TrackKind::span:
          for (Element& one : track.elements) one.span = span_over(track, one);
          break;
        case TrackKind::subdivision:
        case TrackKind::parts:
          divide(track);
          break;
      }
      sort(track);
    }
  }

 private:
  /// Without recursion, because a chain of tracks may be as long as the file.
  std::vector<std::size_t> references_first() const {
    enum class State : char { open, on_path, done };
    std::vector<State> states(tracks_.size(), State::open);
    std::vector<std::size_t> order;
    std::vector<std::size_t> path;
    for (std::size_t start = 0; start < tracks_.size(); ++start) {
      std::size_t at = start;
      for (; at != kNone && states[at] == State::open; at = tracks_[at].ref) {
        states[at] = State::on_path;
        path.push_back(at);
      }
      if (at != kNone && states[at] == State::on_path) {
        xml_.fail(tracks_[at].node, fmt::format("track '{}' refers to itself in the end; give it another ref",
                                                printable(tracks_[at].name)));
      }
      for (; !path.empty(); path.pop_back()) {
        states[path.back()] = State::done;
        order.push_back(path.back());
      }
    }
    return order;
  }

  /// Seconds as milliseconds; nullopt if the attribute is missing.
  std::optional<Milliseconds> time(const Element& one, const char* attribute) const {
    const std::string_view text = trimmed(xml_.attribute(one.node, attribute));
    if (text.empty()) return std::nullopt;
    double seconds = 0;
    const char* end = text.data() + text.size();
    const auto [parsed, error] = std::from_chars(text.data(), end, seconds);
    const auto latest = static_cast<double>(eaf::kLatest) / 1e3;
    if (error != std::errc() || parsed != end || !(seconds >= 0) || !(seconds <= latest)) {
      xml_.fail(one.node, fmt::format("{} '{}' is not a time; write seconds from 0 to {:.0f}", attribute,
                                      printable(text), latest));
    }
    return Milliseconds(std::llround(seconds * 1e3));
  }

  Milliseconds required_time(const Element& one, const char* attribute) const {
    const std::optional<Milliseconds> found = time(one, attribute);
    if (!found) xml_.fail(one.node, fmt::format("<el> has no {}; add it", attribute));
    return *found;
  }

  TimeSpan checked(const Element& one, TimeSpan span) const {
    if (span.begin > span.end) {
      xml_.fail(one.node, fmt::format("element {} ends before it begins; swap its times", one.index));
    }
    return span;
  }

  TimeSpan own_span(const Element& one) const {
    return checked(one, {required_time(one, "start"), required_time(one, "end")});
  }

  TimeSpan own_point(const Element& one) const {
    const std::optional<Milliseconds> begin = time(one, "start");  // as written by some versions
    const Milliseconds at = begin ? *begin : required_time(one, "time");
    return {at, at + Milliseconds(1)};
  }

  /// The element of the reference that an attribute names.
  std::size_t referred(const Track& track, pugi::xml_node node, const char* attribute) const {
    const std::int64_t index = index_in(xml_, node, attribute, xml_.required(node, attribute));
    const Track& reference = tracks_[track.ref];
    const auto found = reference.places.find(index);
    if (found == reference.places.end()) {
      xml_.fail(node, fmt::format("refers to element {} of track '{}', which does not exist; name one that does", index,
                                  printable(reference.name)));
    }
    return found->second;
  }

  std::size_t reference_of(const Track& track, const Element& one) const {
    const bool grouped = one.group && !xml_.attribute(one.group, "ref").empty();
    return referred(track, grouped && xml_.attribute(one.node, "ref").empty() ? one.group : one.node, "ref");
  }

  void take_reference(Track& track, Element& one) {
    one.parent = reference_of(track, one);
    Element& parent = tracks_[track.ref].elements[one.parent];
    one.span = parent.span;
    one.aligned = false;
    if (!taken_.emplace(&track, one.parent).second) {
      xml_.fail(one.node, fmt::format("a second element of '{}' for element {} of '{}'; a singleton has one each",
                                      printable(track.name), parent.index, printable(tracks_[track.ref].name)));
    }
  }

  TimeSpan span_over(const Track& track, const Element& one) const {
    const std::vector<Element>& elements = tracks_[track.ref].elements;
    const Element& first = elements[referred(track, one.node, "start")];
    const Element& last = elements[referred(track, one.node, "end")];
    if (first.span.begin > last.span.begin) {
      xml_.fail(one.node, fmt::format("element {} ends before it begins; swap start and end", one.index));
    }
    return checked(one, {first.span.begin, last.span.end});
  }

  void divide(Track& track) {
    std::map<std::size_t, std::vector<std::size_t>> groups;  // reference -> its parts, in file order
    for (std::size_t i = 0; i < track.elements.size(); ++i) {
      track.elements[i].parent = reference_of(track, track.elements[i]);
      groups[track.elements[i].parent].push_back(i);
    }
    for (const auto& [parent, pieces] : groups) divide(track, tracks_[track.ref].elements[parent].span, pieces);
  }

  void divide(Track& track, TimeSpan whole, const std::vector<std::size_t>& pieces) {
    const bool timed = track.kind == TrackKind::subdivision;
    std::vector<std::optional<Milliseconds>> begins(pieces.size() + 1);
    for (std::size_t i = 0; i < pieces.size() && timed; ++i) begins[i] = time(track.elements[pieces[i]], "start");
    if (!begins[0]) begins[0] = whole.begin;
    begins.back() = whole.end;
    std::vector<Milliseconds> bounds(begins.size());
    for (std::size_t i = 0; i < begins.size();) {
      std::size_t next = i + 1;
      while (next < begins.size() && !begins[next]) ++next;
      bounds[i] = *begins[i];
      if (next == begins.size()) break;
      const auto parts = static_cast<std::int64_t>(next - i);
      for (std::size_t k = i + 1; k < next; ++k) {
        bounds[k] = *begins[i] + (*begins[next] - *begins[i]) * static_cast<std::int64_t>(k - i) / parts;
      }
      i = next;
    }
    track.has_gaps = track.has_gaps || bounds[0] != whole.begin;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      Element& one = track.elements[pieces[i]];
      one.span = {bounds[i], bounds[i + 1]};
      one.aligned = timed && begins[i] && begins[i + 1];
      if (const std::optional<Milliseconds> end = timed ? time(one, "end") : std::nullopt;
          end && *end != one.span.end) {
        track.has_gaps = true;
        one.span.end = *end;
        one.aligned = begins[i].has_value();
      }
      if (one.span.begin < whole.begin || one.span.end > bounds[i + 1] || one.span.begin > one.span.end) {
        xml_.fail(one.node, fmt::format("element {} of '{}' does not lie inside the one that it divides, after the "
                                        "piece before it; correct its times",
                                        one.index, printable(track.name)));
      }
    }
  }

  void sort(Track& track) {
    std::vector<Element>& elements = track.elements;
    track.order.resize(elements.size());
    std::iota(track.order.begin(), track.order.end(), std::size_t{0});
    std::stable_sort(track.order.begin(), track.order.end(), [&](std::size_t a, std::size_t b) {
      const TimeSpan& one = elements[a].span;
      const TimeSpan& other = elements[b].span;
      return one.begin != other.begin ? one.begin < other.begin : one.end < other.end;
    });
    for (std::size_t i = 1; i < track.order.size(); ++i) {
      Element& before = elements[track.order[i - 1]];
      const Element& here = elements[track.order[i]];
      if (before.span.end <= here.span.begin) continue;
      if (track.kind == TrackKind::point) {  // two points within one millisecond
        before.span.end = here.span.begin;
        continue;
      }
      notices_.push_back(xml_.notice(here.node, fmt::format("element {} overlaps element {} on track '{}'", here.index,
                                                            before.index, printable(track.name))));
    }
  }

  const eaf::Xml& xml_;
  std::vector<Track>& tracks_;
  std::vector<Notice>& notices_;
  std::set<std::pair<const Track*, std::size_t>> taken_;  ///< already have a singleton
};

}  // namespace

std::int64_t index_in(const eaf::Xml& xml, pugi::xml_node node, std::string_view attribute, std::string_view text) {
  std::int64_t index = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, index);
  if (error != std::errc() || parsed != end || index < 0) {
    xml.fail(node, fmt::format("{} '{}' is not an element index; write a whole number of 0 or more", attribute,
                               printable(text)));
  }
  return index;
}

void settle_times(const eaf::Xml& xml, std::vector<Track>& tracks, std::vector<Notice>& notices) {
  Times(xml, tracks, notices).run();
}

}  // namespace signweave::anvil
