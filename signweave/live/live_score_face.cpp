#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "signweave/choose/non_manuals.h"
#include "signweave/core/text.h"
#include "signweave/live/live_score.h"

// Authored movements of the face, the gaze and the head. They are shown over the frames of the timeline when these are
// read, so what lanes show does not depend on them.
namespace signweave {
namespace {

/// A movement may last this much longer than the last sign. (ours)
constexpr Seconds kAfterLast{60.0};

bool has_any(const std::vector<std::string>& all, const std::vector<std::string>& wanted) {
  return std::ranges::any_of(wanted, [&](const std::string& one) { return std::ranges::find(all, one) != all.end(); });
}

}  // namespace

/// Adds the non-manuals whose places are all signed, the last of them `first` or later. Frames before `from` are
/// decided.
void LiveScore::author(std::size_t first, std::int64_t from) {
  if (round_.entries.empty()) return;
  const std::vector<NonManual>& all = queue_.non_manuals();
  const std::int64_t shift = round_.entries.back().clip->placed.core - round_.entries.back().core;
  Score times;  // in the utterance's time
  for (std::size_t i = queue_.first_over(first); i < all.size() && all[i].first < queue_.next(); ++i) {
    NonManual one = all[i];
    const std::size_t number = queue_.forgotten_non_manuals() + i;
    const auto known = round_.authored.find(number);
    if (known != round_.authored.end() && !known->second.goes_on) continue;
    if (one.last >= queue_.next() || one.last < round_.entries.front().first) continue;
    if (times.clips.empty()) times = times_from(one.first);
    one.first += queue_.forgotten();
    one.last += queue_.forgotten();
    std::vector<Notice> notices;
    for (AuthoredCurve& curve : author_non_manuals({.places = {}, .holds = {}, .non_manuals = {one}}, times,
                                                   options_.synthesis.non_manuals, notices)) {
      if (known != round_.authored.end()) {  // it goes on: what was shown of it stays
        known->second.curve.at.end = std::max(curve.at.end, from - shift + 1);
        known->second.curve.last = curve.last;
        known->second.goes_on = false;
        show_authored(from);
        continue;
      }
      if (const auto tracks = tracks_of(curve.curve); !tracks.empty() && !has_any(setup_->header.tracks, tracks)) {
        notices.push_back({{},
                           fmt::format("'{}' is not seen: the stream has no tracks for the face; open it with "
                                       "\"face\": true",
                                       printable(one.what))});
      }
      curve.at.begin = std::max(curve.at.begin, from - shift);
      curve.at.end = std::max(curve.at.end, curve.at.begin + 1);
      round_.authored[number] = {.curve = curve};
      curve.at = {curve.at.begin + shift, curve.at.end + shift};
      curves_.add(std::move(curve));
    }
    for (const Notice& notice : notices) notify(from, one.first, notice.text);
  }
}

/// Lets a movement that ends with the last place go on in an utterance that is appended, if it does not end before
/// `next`. Returns false if there is one that does.
bool LiveScore::let_go_on(const Utterance& utterance, std::int64_t next) {
  const std::optional<std::size_t> number = queue_.continued(utterance);
  if (!number) return true;
  const auto at = round_.authored.find(*number);
  if (at == round_.authored.end()) return true;  // its places are not all signed yet
  Authored& known = at->second;
  const FrameRate rate = setup_->header.rate;
  const std::int64_t shift = round_.entries.back().clip->placed.core - round_.entries.back().core;
  const Milliseconds falls = std::max(known.curve.curve.offset, known.curve.curve.head.offset);
  const std::int64_t end = known.curve.at.end + shift - frames_of(falls, rate);
  if (end <= next) return false;
  known.goes_on = true;
  known.curve.at.end += std::llround(kAfterLast.count() * rate.hertz());
  show_authored(next);
  curves_.change_from(end);
  return true;
}

/// The clips of the utterance from that of a place on, in its time.
Score LiveScore::times_from(std::size_t place) const {
  Score times{.skeleton = {}, .rate = setup_->header.rate, .clips = {}, .junctions = {}, .lanes = {}};
  Lane& body = times.lanes.emplace_back();
  std::size_t first = round_.entries.size() - 1;
  while (first > 0 && round_.entries[first].first > place) --first;
  for (const Entry& entry : std::span(round_.entries).subspan(first)) {
    PlacedClip placed = entry.clip->placed;
    placed.core = entry.core;
    const auto id = static_cast<ClipId>(times.clips.size());
    times.clips.push_back(signweave::clip_of(placed, id));
    body.items.push_back({ClipUse{id}, times.clips.back().at});
  }
  times.frames = times.clips.back().at.end + std::llround(kAfterLast.count() * times.rate.hertz());
  return times;
}

/// Shows the movements of the utterance again after a jump to another of its times.
void LiveScore::show_authored(std::int64_t next) {
  const std::int64_t shift = round_.entries.back().clip->placed.core - round_.entries.back().core;
  std::erase_if(round_.authored, [&](const auto& one) {
    return one.second.curve.first > round_.entries.back().last + queue_.forgotten();
  });
  std::vector<AuthoredCurve> shown;
  for (const auto& [number, one] : round_.authored) {
    AuthoredCurve& curve = shown.emplace_back(one.curve);
    curve.at = {curve.at.begin + shift, curve.at.end + shift};
    if (curve.at.end <= next) shown.pop_back();
  }
  curves_.set(std::move(shown));
}

}  // namespace signweave
