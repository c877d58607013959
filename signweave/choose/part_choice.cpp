#include "signweave/choose/part_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/database/signer_dominance.h"
#include "signweave/features/hand_rest.h"
#include "signweave/render/plan.h"

namespace signweave {
namespace {

Channel fingers(Side side) noexcept {
  return side == Side::left ? Channel::left_fingers : Channel::right_fingers;
}
Side other(Side side) noexcept {
  return side == Side::left ? Side::right : Side::left;
}

bool is_fingers(Channel channel) noexcept {
  return channel == Channel::left_fingers || channel == Channel::right_fingers;
}

std::optional<Side> side_of(Channel channel) noexcept {
  return side_of_arm(is_fingers(channel) ? *parent_of(channel) : channel);
}

/// See ChosenPart::mirrored.
std::optional<bool> mirrored(const Snapshot& snapshot, Channel channel, const Candidate& candidate) {
  const std::optional<Side> side = side_of(channel);
  if (!side || candidate.first_row == kNoRow || candidate.signs.size() != 1) return std::nullopt;
  if (candidate.signs.front().hand != Hand::both) return std::nullopt;  // annotated for this hand or the other
  const std::optional<Side> only = only_hand_of(snapshot, candidate.first_row);
  if (!only) return std::nullopt;
  return *only != *side;
}

/// The hand of a channel at rest, as captured nearest to a sign of the same signer. Throws Error{bad_input} if the hand
/// of the recording is unknown.
Candidate rest_near(const Snapshot& snapshot, Channel channel, const Candidate& sign) {
  const HandTrace trace = snapshot.hand_trace(sign.recording);
  const std::optional<FrameRange> rest = hand_rest(trace, *side_of(channel), sign.core.begin);
  if (!rest) {
    throw Error(ErrorCode::bad_input,
                fmt::format("the {} hand cannot rest: '{}' has no trace of it{}{}", name_of(channel),
                            printable(snapshot.contents().recordings[sign.recording].name),
                            trace.why_not.empty() ? "" : "; ", trace.why_not));
  }
  Candidate candidate;
  candidate.recording = sign.recording;
  candidate.whole = candidate.core = *rest;
  candidate.at_strokes = false;
  return candidate;
}

bool is_same(const Candidate& a, const Candidate& b) {
  return a.recording == b.recording && a.core == b.core && a.first_row == b.first_row;
}

}  // namespace

Channel channel_of(BodyPart part, Side dominant) noexcept {
  switch (part) {
    case BodyPart::dominant:
      return arm_channel(dominant);
    case BodyPart::weak:
      return arm_channel(other(dominant));
    case BodyPart::right:
      return Channel::right;
    case BodyPart::left:
      return Channel::left;
    case BodyPart::dominant_fingers:
      return fingers(dominant);
    case BodyPart::weak_fingers:
      return fingers(other(dominant));
    case BodyPart::right_fingers:
      return Channel::right_fingers;
    case BodyPart::left_fingers:
      return Channel::left_fingers;
    case BodyPart::head:
      return Channel::head;
  }
  return Channel::left;
}

std::vector<PartChoice> part_choices(const Contents& contents, const Utterance& utterance, Side dominant) {
  std::vector<PartChoice> choices;
  for (std::size_t i = 0; i < utterance.places.size(); ++i) {
    const Place& place = utterance.places[i];
    for (const PlacePart& part : place.parts) {
      PartChoice& choice = choices.emplace_back(
          PartChoice{.place = i,
                     .last = std::min(i + std::max<std::size_t>(part.places, 1), utterance.places.size()) - 1,
                     .channel = channel_of(part.part, place.dominant.value_or(dominant)),
                     .signs = {},
                     .sync = {}});
      for (const PartSign& sign : part.signs) {
        choice.signs.push_back(sign.rest ? std::vector<Candidate>() : candidates_for(contents, sign.sign));
        std::vector<ClipSync>& sync = choice.sync.emplace_back();
        for (const SyncMark& mark : sign.sync) {
          const bool at_end = mark.anchor == SyncMark::Anchor::end;
          sync.push_back(
              {.anchor = at_end ? ClipSync::Anchor::end : ClipSync::Anchor::begin, .with = i, .offset = mark.offset});
        }
      }
      for (const PartChoice& before : choices) {
        if (&before == &choice || before.place != i || before.channel != choice.channel) continue;
        throw Error(ErrorCode::bad_input, fmt::format("'{}': two parts are of the channel '{}'; give it one sign at a "
                                                      "time",
                                                      printable(to_string(place.gloss)), name_of(choice.channel)));
      }
    }
  }
  return choices;
}

std::set<std::size_t> clip_borders(const Utterance& utterance) {
  std::set<std::size_t> borders;
  for (std::size_t i = 0; i < utterance.places.size(); ++i) {
    for (const PlacePart& part : utterance.places[i].parts) {
      borders.insert(i);
      borders.insert(i + part.places);
    }
  }
  for (std::size_t i = 0; i < utterance.places.size(); ++i) {
    if (!utterance.places[i].dominant) continue;
    borders.insert(i);
    borders.insert(i + 1);
  }
  for (const HandHold& held : utterance.holds) {
    borders.insert(held.from == kPlaceBefore ? 0 : held.from + 1);
    borders.insert(held.until + 1);
  }
  return borders;
}

std::vector<ChosenPart> choose_parts(const Snapshot& snapshot, std::span<const PartChoice> parts,
                                     std::span<const Candidate* const> chosen, std::span<const Choice> places,
                                     const SelectOptions& options) {
  std::vector<ChosenPart> result;
  for (const PartChoice& part : parts) {
    const Candidate& own = *chosen[part.place];
    const auto find_own = [&](const std::vector<Candidate>& candidates) {
      return std::ranges::find_if(candidates, [&](const Candidate& one) { return is_same(one, own); });
    };
    const bool has_own = find_own(part.signs.front()) != part.signs.front().end();
    if (has_own && part.signs.size() == 1 && part.last == part.place && part.sync.front().empty()) continue;
    // What is signed before, the signs of the part, what is signed after.
    std::vector<Choice> chain;
    const std::size_t before = part.place > 0 ? 1 : 0;
    if (before > 0) chain.push_back({.candidates = {*chosen[part.place - 1]}});
    for (std::size_t i = 0; i < part.signs.size(); ++i) {
      if (part.signs[i].empty()) {
        chain.push_back({.candidates = {rest_near(snapshot, part.channel, own)}});
        continue;
      }
      const auto same = i == 0 ? find_own(part.signs[i]) : part.signs[i].end();
      chain.push_back(same == part.signs[i].end() ? Choice{.candidates = part.signs[i]}
                                                  : Choice{.candidates = {*same}});
    }
    if (part.last + 1 < places.size()) chain.push_back({.candidates = {*chosen[part.last + 1]}});
    const Selection selection = select(snapshot, chain, {.transition = options.transition});
    for (std::size_t i = 0; i < part.signs.size(); ++i) {
      const std::size_t at = before + i;
      result.push_back({&part, i, chain[at].candidates[selection.chosen[at]]});
      result.back().rest = part.signs[i].empty();
      result.back().mirrored =
          result.back().rest ? std::optional(false) : mirrored(snapshot, part.channel, result.back().candidate);
    }
  }
  return result;
}

ChannelClip channel_clip(const ChosenPart& chosen, std::span<const std::size_t> clip_of) {
  const PartChoice& part = *chosen.part;
  ChannelClip clip{.channel = part.channel,
                   .clip = {},
                   .first = clip_of[part.place],
                   .last = clip_of[part.last],
                   .sync = {},
                   .fill = is_fingers(part.channel) && part.signs.size() == 1 && part.sync.front().empty()};
  for (ClipSync sync : part.sync[chosen.sign]) {
    sync.with = clip_of[sync.with];
    clip.sync.push_back(sync);
  }
  if (clip.sync.empty() && chosen.sign == 0 && !chosen.rest) clip.sync.push_back({.with = clip.first});
  return clip;
}

std::vector<ChannelHold> channel_holds(const Utterance& utterance, Side dominant) {
  std::vector<ChannelHold> holds;
  for (const HandHold& held : utterance.holds) {
    const std::size_t named = held.from == kPlaceBefore ? 0 : held.from;
    const Side of_place = utterance.places[named].dominant.value_or(dominant);
    holds.push_back({.channel = channel_of(held.hand, of_place), .from = held.from, .until = held.until});
  }
  return holds;
}

}  // namespace signweave
