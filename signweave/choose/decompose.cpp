#include "signweave/choose/decompose.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/render/plan.h"

namespace signweave {
namespace {

/// The signs of a recording that describe its whole body or the hand with more signs, and those of the other hand.
struct SignsOfHands {
  std::vector<Sign> main;
  std::vector<Sign> other;  ///< empty unless both hands have tiers of their own
};
SignsOfHands signs_of_hands(const Contents& contents, std::size_t recording) {
  SignsOfHands found;
  const auto number = static_cast<std::uint32_t>(recording);
  found.main = main_signs_of(contents.segments, number);
  if (found.main.empty() || found.main.front().hand == Hand::both) return found;
  std::map<std::string, std::vector<Sign>> tiers;
  for (Sign& sign : signs_of(contents.segments, number)) {
    const bool of_other_hand = sign.hand != Hand::both && sign.hand != found.main.front().hand;
    if (of_other_hand && sign.signer == found.main.front().signer) tiers[sign.tier].push_back(std::move(sign));
  }
  for (auto& [tier, signs] : tiers) {
    if (signs.size() > found.other.size()) found.other = std::move(signs);
  }
  return found;
}

/// Candidates for consecutive clips of one recording, with the frames between two in the first one's `whole`; the first
/// begins with the recording, the last ends with it.
std::vector<Candidate> consecutive(const Contents& contents, std::size_t recording, const std::vector<Sign>& signs) {
  std::vector<Candidate> found;
  for (const Sign& sign : signs) {
    std::optional<Candidate> next = candidate_of_run(contents, recording, {sign});
    if (!next) continue;
    if (!found.empty() && next->core.begin < found.back().core.end) {  // their strokes overlap
      Candidate& last = found.back();
      last.core.end = std::max(last.core.end, next->core.end);
      last.whole.end = std::max(last.whole.end, next->whole.end);
      last.signs.push_back(sign);
      last.last_row = next->last_row;
      continue;
    }
    if (!found.empty()) found.back().whole.end = std::max(found.back().whole.end, next->core.begin);
    found.push_back(std::move(*next));
  }
  if (found.empty()) return found;
  found.front().whole.begin = 0;
  found.back().whole.end = contents.recordings[recording].motion->frames;
  return found;
}

/// The frames between two moments of a recording, as time of a score at tempo 1.
Seconds time_between(std::int64_t begin, std::int64_t end, FrameRate rate) {
  return Seconds(static_cast<double>(end - begin) / rate.hertz());
}

/// The last place whose core has begun at a frame, or the first.
std::size_t place_at(const std::vector<Choice>& choices, std::int64_t frame) {
  std::size_t place = 0;
  while (place + 1 < choices.size() && choices[place + 1].candidates.front().core.begin <= frame) ++place;
  return place;
}

PartChoice part_of(const std::vector<Candidate>& clips, const std::vector<Choice>& places, Hand hand, FrameRate rate) {
  PartChoice part{.place = 0,
                  .last = places.size() - 1,
                  .channel = arm_channel(hand == Hand::left ? Side::left : Side::right),
                  .signs = {},
                  .sync = {}};
  std::optional<std::size_t> tied;
  for (const Candidate& clip : clips) {
    part.signs.push_back({clip});
    part.continues.push_back(part.signs.size() > 1);
    // The first one in each place is tied to it, so that the hands stay together when a place comes later.
    std::vector<ClipSync>& sync = part.sync.emplace_back();
    const std::size_t place = place_at(places, clip.core.begin);
    if (tied == place) continue;
    tied = place;
    sync.push_back(
        {.with = place, .offset = time_between(places[place].candidates.front().core.begin, clip.core.begin, rate)});
  }
  return part;
}

/// The number of the sign among some signs that a reference names.
std::size_t find_in(const std::vector<const Candidate*>& clips, const GlossRef& wanted, Side side,
                    std::string_view recording) {
  const std::string form = match_form(wanted.gloss);
  std::vector<std::size_t> found;
  std::vector<std::string> glosses;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    for (const Sign& sign : clips[i]->signs) {
      if (match_form(sign.gloss) == form) found.push_back(i);
      glosses.push_back(sign.gloss);
    }
  }
  const std::string_view hand = name_of(side == Side::left ? Hand::left : Hand::right);
  if (found.empty()) {
    throw Error(ErrorCode::not_found,
                fmt::format("no sign '{}' of the {} hand in recording '{}'{}", printable(wanted.gloss), hand, recording,
                            did_you_mean(wanted.gloss, glosses)));
  }
  if (wanted.token == 0 && found.size() > 1) {
    throw Error(ErrorCode::bad_input,
                fmt::format("'{0}' of the {1} hand occurs {2} times in recording '{3}'; say which: {0}#1 to {0}#{2}",
                            printable(wanted.gloss), hand, found.size(), recording));
  }
  if (wanted.token > found.size()) {
    throw Error(ErrorCode::not_found,
                fmt::format("no token {} of '{}' of the {} hand in recording '{}', which has {}", wanted.token,
                            printable(wanted.gloss), hand, recording, found.size()));
  }
  return found[wanted.token == 0 ? 0 : wanted.token - 1];
}

}  // namespace

Decomposed decompose(const Contents& contents, std::string_view recording) {
  const RecordingInfo& info = contents.at(recording);
  const auto index = static_cast<std::size_t>(&info - contents.recordings.data());
  if (!info.motion) throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion", info.name));
  const SignsOfHands signs = signs_of_hands(contents, index);
  Decomposed decomposed;
  for (Candidate& clip : consecutive(contents, index, signs.main)) {
    const bool continues = !decomposed.choices.empty();
    decomposed.choices.push_back({.candidates = {std::move(clip)}, .continues = continues});
  }
  if (decomposed.choices.empty()) {
    throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no signs with strokes", info.name));
  }
  const std::vector<Candidate> other = consecutive(contents, index, signs.other);
  if (other.empty()) return decomposed;
  decomposed.parts.push_back(part_of(other, decomposed.choices, signs.other.front().hand, info.motion->rate));
  return decomposed;
}

void replace_in_hands(const Contents& contents, std::string_view recording,
                      std::span<const HandReplacement> replacements, Decomposed& decomposed) {
  std::map<std::pair<Side, std::size_t>, const HandReplacement*> replaced;
  const std::size_t of_tiers = decomposed.parts.size();
  const FrameRate rate = contents.at(recording).motion->rate;
  const auto place_begin = [&](std::size_t place) { return decomposed.choices[place].candidates.front().core.begin; };
  for (const HandReplacement& one : replacements) {
    const Channel channel = arm_channel(one.hand);
    PartChoice* own = nullptr;
    for (std::size_t i = 0; i < of_tiers; ++i) {
      if (decomposed.parts[i].channel == channel) own = &decomposed.parts[i];
    }
    std::vector<const Candidate*> clips;
    if (own != nullptr) {
      for (const std::vector<Candidate>& sign : own->signs) clips.push_back(&sign.front());
    } else {
      for (const Choice& choice : decomposed.choices) clips.push_back(&choice.candidates.front());
    }
    const std::size_t at = find_in(clips, one.replacement.from, one.hand, recording);
    if (!replaced.emplace(std::pair(one.hand, at), &one).second) {
      throw Error(ErrorCode::bad_input, fmt::format("'{}' of the {} hand is to be replaced twice",
                                                    to_string(one.replacement.from), name_of(channel)));
    }
    const SignRef wanted{.gloss = one.replacement.to, .recording = {}, .span = {}};
    std::vector<Candidate> candidates = candidates_for(contents, wanted);
    if (own == nullptr) {
      decomposed.parts.push_back({.place = at,
                                  .last = at,
                                  .channel = channel,
                                  .signs = {std::move(candidates)},
                                  .sync = {{}},
                                  .continues = {false}});
      continue;
    }
    const std::int64_t begin = clips[at]->core.begin;
    own->signs[at] = std::move(candidates);
    own->continues[at] = false;
    if (at + 1 < own->continues.size()) own->continues[at + 1] = false;
    if (own->sync[at].empty()) {  // not before the sign that it replaces
      const std::size_t place = place_at(decomposed.choices, begin);
      own->sync[at].push_back(
          {.with = place, .offset = time_between(place_begin(place), begin, rate), .at_least = true});
    }
  }
}

}  // namespace signweave
