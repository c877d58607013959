#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "signweave/choose/non_manuals.h"
#include "signweave/core/text.h"
#include "signweave/live/live_score.h"

// Authored movements of the face, the gaze and the head. They are shown over the frames of the timeline when these are
// read, so what lanes show does not depend on them.
namespace signweave {
namespace {

/// A movement may last this much longer than the last sign. (ours)
constexpr Seconds kAfterLast{60.0};

}  // namespace

/// Adds the non-manuals whose places are all signed. Frames before `from` are decided.
void LiveScore::author(std::int64_t from) {
  if (round_.entries.empty() || queue_.non_manuals().empty()) return;
  const std::size_t forgotten = queue_.forgotten_non_manuals();
  NonManualOptions options = options_.synthesis.non_manuals;
  options.gaze = options.blinks = false;  // what is planned needs the whole utterance; the living rest blinks
  Score times;                            // in the utterance's time
  for (std::size_t i = 0; i < queue_.non_manuals().size(); ++i) {
    NonManual one = queue_.non_manuals()[i];
    const auto known = std::ranges::find(round_.authored, forgotten + i, &Authored::number);
    const bool goes_on = known != round_.authored.end() && known->goes_on;
    if ((known != round_.authored.end() && !goes_on) || one.last >= queue_.next() ||
        one.last < round_.entries.front().first) {
      continue;
    }
    if (times.clips.empty()) times = times_of_entries();
    one.first += queue_.forgotten();
    one.last += queue_.forgotten();
    std::vector<Notice> notices;
    for (AuthoredCurve& curve :
         author_non_manuals({.places = {}, .holds = {}, .non_manuals = {one}}, times, options, notices)) {
      const std::int64_t shift = round_.entries.back().clip->placed.core - round_.entries.back().core;
      if (goes_on) {  // what was shown of it stays
        known->curve.at.end = std::max(curve.at.end, from - shift + 1);
        known->curve.last = curve.last;
        known->goes_on = false;
        show_authored(from);
        break;
      }
      const std::vector<std::string> tracks = tracks_of(curve.curve);
      const auto is_there = [&](const std::string& track) {
        return std::ranges::find(setup_->header.tracks, track) != setup_->header.tracks.end();
      };
      if (!tracks.empty() && std::ranges::none_of(tracks, is_there)) {
        notices.push_back({{},
                           fmt::format("'{}' is not seen: the stream has no tracks for the face; open it with "
                                       "\"face\": true",
                                       printable(one.what))});
      }
      curve.at.begin = std::max(curve.at.begin, from - shift);
      curve.at.end = std::max(curve.at.end, curve.at.begin + 1);
      round_.authored.push_back({.number = forgotten + i, .curve = curve});
      curve.at = {curve.at.begin + shift, curve.at.end + shift};
      curves_.add(std::move(curve));
    }
    for (const Notice& notice : notices) {
      const auto frame = static_cast<std::uint64_t>(from);
      const auto after = std::ranges::upper_bound(events_, frame, {}, &PlayerEvent::frame);
      events_.insert(after,
                     {.kind = PlayerEvent::Kind::notice, .frame = frame, .place = one.first, .text = notice.text});
    }
  }
}

/// Lets a movement that ends with the last place go on in an utterance that is appended, if it does not end before
/// `next`. Returns false if there is one that does.
bool LiveScore::let_go_on(const Utterance& utterance, std::int64_t next) {
  const std::optional<std::size_t> number = queue_.continued(utterance);
  if (!number) return true;
  const auto known = std::ranges::find(round_.authored, *number, &Authored::number);
  if (known == round_.authored.end()) return true;  // its places are not all signed yet
  const FrameRate rate = setup_->header.rate;
  const std::int64_t shift = round_.entries.back().clip->placed.core - round_.entries.back().core;
  const Milliseconds falls = std::max(known->curve.curve.offset, known->curve.curve.head.offset);
  const std::int64_t end = known->curve.at.end + shift - frames_of(falls, rate);
  if (end <= next) return false;
  known->goes_on = true;
  known->curve.at.end += std::llround(kAfterLast.count() * rate.hertz());
  show_authored(next);
  curves_.change_from(end);
  return true;
}

/// The clips of the utterance, in its time.
Score LiveScore::times_of_entries() const {
  Score times{.skeleton = {}, .rate = setup_->header.rate, .clips = {}, .junctions = {}, .lanes = {}};
  Lane& body = times.lanes.emplace_back();
  for (const Entry& entry : round_.entries) {
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
  std::erase_if(round_.authored,
                [&](const Authored& one) { return one.curve.first > round_.entries.back().last + queue_.forgotten(); });
  std::vector<AuthoredCurve> shown;
  for (const Authored& one : round_.authored) {
    AuthoredCurve& curve = shown.emplace_back(one.curve);
    curve.at = {curve.at.begin + shift, curve.at.end + shift};
    if (curve.at.end <= next) shown.pop_back();
  }
  curves_.set(std::move(shown));
}

}  // namespace signweave
