#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "signweave/notation/utterance.h"

namespace signweave {
namespace {

std::string random_name() {
  const std::string made = *rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::element(
      'A', 'b', '#', '3', '@', '.', ',', '\'', ' ', '"', '[', ']', '{', '}', '|', ':', ';', '+', '-', '\n')));
  const std::string other =
      *rc::gen::element<std::string>("hold", "@begin", "brows up", "weak", "mouth", "..A", "+2", "\xE6\x89\x8B", "slow",
                                     "plural", "size 1.3", "move 1/2/3", "from", "to @a", "unturned");
  return made.find_first_not_of(" \n") == made.npos || *rc::gen::inRange(0, 4) == 0 ? other : made;
}

SignRef random_sign() {
  if (*rc::gen::inRange(0, 4) > 0) {
    const std::size_t token = *rc::gen::inRange<std::size_t>(0, 3);
    return {.kind = SignRef::Kind::gloss, .gloss = {random_name(), token}, .recording = {}, .span = {}};
  }
  const Milliseconds begin(*rc::gen::inRange(0, 100));
  return {.kind = SignRef::Kind::piece, .gloss = {}, .recording = random_name(), .span = {begin, begin + 5ms}};
}

Milliseconds random_offset() {
  return Milliseconds(*rc::gen::weightedElement<int>({{4, 0}, {1, 40}, {1, -1'000'000}}));
}

bool chance(int one_in) {
  return *rc::gen::inRange(0, one_in) == 0;
}
float random_float(float least, float most) {
  const int steps = *rc::gen::inRange(0, 1001);
  return *rc::gen::element(least, most, 1.0f, least + (most - least) * static_cast<float>(steps) / 1000);
}
std::array<float, 3> random_axes(float least, float most) {
  return {random_float(least, most), random_float(least, most), random_float(least, most)};
}

LocusRef random_locus(const std::vector<std::string>& names) {
  const int kind = *rc::gen::inRange(0, 3);
  if (kind == 0) return {.kind = LocusRef::Kind::name, .name = *rc::gen::elementOf(names), .numbers = {}};
  if (kind == 1) return {.kind = LocusRef::Kind::point, .name = {}, .numbers = random_axes(-100, 100)};
  const float distance = *rc::gen::element(kLocusDistance, 1.0f, 0.001f, kFarthestLocus);
  return {.kind = LocusRef::Kind::angles,
          .name = {},
          .numbers = {random_float(-180, 180), chance(2) ? 0 : random_float(-90, 90), distance}};
}

/// `names` are those of the loci that are known.
SpaceChange random_change(const std::vector<std::string>& names) {
  SpaceChange change;
  const int aim = *rc::gen::inRange(0, 6);
  if (aim == 0 || aim == 1) change.from = random_locus(names);
  if (aim == 0 || aim == 2) change.to = random_locus(names);
  if (aim == 3) change.at = random_locus(names);
  if (aim == 4) change.past = random_locus(names);
  for (std::size_t i = *rc::gen::inRange(2, 5); aim == 5 && i > 0; --i) change.along.push_back(random_locus(names));
  if (aim >= 4) change.keeps_turn = chance(2);
  if (chance(3)) change.move = random_axes(-kMostMove, kMostMove);
  if (chance(3)) change.turn = random_axes(-360, 360);
  if (chance(3)) change.scale = random_axes(kLeastScale, kMostScale);
  if (chance(5)) change.scale = {2, 2, 2};
  if (chance(3)) change.size = *rc::gen::element(kBig, kSmall, random_float(kLeastScale, kMostScale));
  if (chance(3)) change.speed = *rc::gen::element(kSlow, kFast, random_float(kSlowestSign, kFastestSign));
  if (chance(3)) change.repetitions = *rc::gen::inRange<std::size_t>(1, kMostRepetitions + 1);
  change.outward = chance(4);
  change.mirrored = chance(4);
  return change;
}

void add_random_space(Utterance& made) {
  std::vector<std::string> names(built_in_loci().begin(), built_in_loci().end());
  for (std::size_t i = 0; i < made.places.size(); ++i) {
    for (const char* name : {"a", "from", "\xE6\x89\x8B", "a+b.d'"}) {
      if (!chance(6)) continue;
      made.loci.push_back({name, random_locus(names), i});
      names.emplace_back(name);
    }
    if (chance(2)) made.places[i].space = random_change(names);
  }
}

std::vector<PlacePart> random_parts(std::size_t most_places) {
  std::vector<PlacePart> parts;
  for (const BodyPart which : *rc::gen::unique<std::vector<BodyPart>>(
           rc::gen::elementOf(std::vector<BodyPart>(kBodyParts.begin(), kBodyParts.end())))) {
    if (parts.size() == 3) break;
    PlacePart one{.part = which, .signs = {}, .places = *rc::gen::inRange<std::size_t>(1, most_places + 1)};
    for (int k = *rc::gen::inRange(1, 3); k > 0; --k) {
      PartSign sign{random_sign(), {}};
      if (*rc::gen::inRange(0, 3) == 0) sign.sync.push_back({SyncMark::Anchor::end, random_offset()});
      if (*rc::gen::inRange(0, 3) == 0) sign.sync.push_back({SyncMark::Anchor::begin, random_offset()});
      one.signs.push_back(std::move(sign));
    }
    parts.push_back(std::move(one));
  }
  return parts;
}

Utterance random_utterance() {
  Utterance made;
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, 6);
  const auto place = [&](std::size_t from) { return *rc::gen::inRange(from, count); };
  for (std::size_t i = 0; i < count; ++i) {
    Place one;
    static_cast<SignRef&>(one) = random_sign();
    if (i > 0) one.pause_before = *rc::gen::element(0ms, kComma, kFullStop);
    if (*rc::gen::inRange(0, 2) == 0) one.parts = random_parts(count - i);
    if (*rc::gen::inRange(0, 4) == 0) one.dominant = *rc::gen::element(Side::left, Side::right);
    made.places.push_back(std::move(one));
  }
  for (std::size_t from = 0; from + 1 < count; ++from) {
    if (*rc::gen::arbitrary<bool>()) made.holds.push_back({BodyPart::weak, from, place(from + 1)});
    if (*rc::gen::arbitrary<bool>()) made.holds.push_back({BodyPart::left, from, place(from + 1)});
  }
  for (int i = *rc::gen::inRange(0, 6); i > 0; --i) {
    const std::size_t first = place(0);
    made.non_manuals.push_back(
        {*rc::gen::element(NonManual::Kind::expression, NonManual::Kind::mouthing, NonManual::Kind::gaze),
         random_name(), first, place(first), random_offset(), random_offset()});
  }
  std::ranges::stable_sort(made.non_manuals, [](const NonManual& a, const NonManual& b) {
    return a.first != b.first ? a.first < b.first : a.last > b.last;
  });
  add_random_space(made);
  return made;
}

RC_GTEST_PROP(UtteranceProperties, PrintedTextParsesToTheSameUtterance, ()) {
  const Utterance made = random_utterance();
  const std::string text = to_string(made);
  RC_LOG() << text;
  RC_ASSERT(parse_utterance(text) == made);
  RC_ASSERT(to_string(parse_utterance(text)) == text);
}

RC_GTEST_PROP(UtteranceProperties, AnyTextIsReadOrHasFaultsOfOneLine, ()) {
  std::string text;
  for (const std::string& one : *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
           "A", "B#2", "r@1..2", "[", "]", "{", "}", "|", ":", ";", " ", "\n", "\"", "@begin+2", "weak",
           "weak: ", "hold", "..", "..A", "..+1", "fingers right: ", "mouth ", "gaze @left", "neg", "+0", "-40", "@a",
           " = ", "=", "@left", "from ", "to:", "along ", "slow", "plural", "move 1/2/3", "unturned", "size 1.2",
           "dominant left", ", ", "{x: ", "\x80", "\xE6\x89\x8B")))
    text += one;
  const bool database = *rc::gen::arbitrary<bool>();
  UtteranceWords words;
  if (database) words.is_gloss = [](std::string_view word) { return word.size() % 2 == 1; };
  const UtteranceText read = read_utterance(text, words);
  RC_ASSERT(read.spans.size() == read.utterance.places.size());
  std::size_t before = 0;
  for (const UtteranceFault& fault : read.faults) {
    RC_ASSERT(before <= fault.at.begin);
    RC_ASSERT(fault.at.begin < fault.at.end);
    RC_ASSERT(fault.at.end <= text.size());
    RC_ASSERT(fault.message.find('\n') == std::string::npos);
    before = fault.at.begin;
  }
  if (!read.faults.empty() || read.utterance.places.empty()) return;
  RC_ASSERT(parse_utterance(to_string(read.utterance)) == read.utterance);
}

}  // namespace
}  // namespace signweave
