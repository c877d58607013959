#include "signweave/choose/missing_glosses.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::size_t kMostWordsOfAGloss = 4;
constexpr std::size_t kMostNamed = 8;  // in one line

using FoldedGlosses = std::unordered_map<std::string, std::vector<std::string>>;  // by loose form

bool is_there(const SignRef& sign, const Segments& segments) {
  if (sign.kind != SignRef::Kind::gloss) return true;
  const std::string form = match_form(sign.gloss.gloss);
  return std::ranges::any_of(segments.members(), [&](const Segments::Member& member) {
    const std::uint32_t label = member.table.find_text(form);
    if (label == SegmentTable::kNone) return false;
    const std::span<const RowId> rows = member.table.with_label(RowKind::sign, label);
    return std::ranges::any_of(
        rows, [&](RowId row) { return member.numbers[member.table.recording(row)] != Segments::kNone; });
  });
}

/// True if a place may be one word of a gloss of several: it has neither token, pause nor quotes, and behind the first
/// nothing in space.
bool is_word(const Utterance& utterance, std::size_t i, bool first) {
  const Place& place = utterance.places[i];
  const bool word = place.kind == Place::Kind::gloss && place.gloss.token == 0 && place.parts.empty();
  if (!word || first) return word;
  return place.pause_before == Milliseconds(0) && place.space == SpaceChange{} &&
         !std::ranges::binary_search(utterance.loci, i, {}, &LocusSetup::from);
}

/// The longest gloss formed by several places from this one, at least one of which is missing; or none.
MissingGloss joined_from(const Utterance& utterance, std::size_t place, const std::vector<bool>& there,
                         const FoldedGlosses& folded) {
  MissingGloss best;
  std::string words;
  bool missing = false;
  for (std::size_t i = place; i < std::min(place + kMostWordsOfAGloss, utterance.places.size()); ++i) {
    if (!is_word(utterance, i, i == place)) break;
    if (i > place) words += ' ';
    words += utterance.places[i].gloss.gloss;
    missing = missing || !there[i];
    if (i == place || !missing) continue;
    const auto found = folded.find(loose_form(words));
    if (found != folded.end()) best = {place, i + 1 - place, words, found->second, true};
  }
  return best;
}

/// The signs of parts whose glosses are missing, without matches.
std::vector<MissingGloss> missing_in_parts(const Utterance& utterance, const Segments& segments) {
  std::vector<MissingGloss> missing;
  for (std::size_t i = 0; i < utterance.places.size(); ++i) {
    const std::vector<PlacePart>& parts = utterance.places[i].parts;
    for (std::size_t part = 0; part < parts.size(); ++part) {
      for (std::size_t k = 0; k < parts[part].signs.size(); ++k) {
        const PartSign& one = parts[part].signs[k];
        if (one.rest || is_there(one.sign, segments)) continue;
        missing.push_back({.place = i, .gloss = one.sign.gloss.gloss, .part = PartSignNumber{part, k}});
      }
    }
  }
  return missing;
}

/// Those of places, then those of parts, each in the order of the utterance.
std::vector<MissingGloss> missing_of(const Utterance& utterance, const Segments& segments) {
  std::vector<bool> there;
  for (const Place& place : utterance.places) there.push_back(is_there(place, segments));
  std::vector<MissingGloss> missing;
  std::vector<MissingGloss> in_parts = missing_in_parts(utterance, segments);
  if (in_parts.empty() && std::ranges::find(there, false) == there.end()) return missing;
  const std::vector<std::string> glosses = segments.glosses();
  FoldedGlosses folded;
  for (const std::string& gloss : glosses) folded[loose_form(gloss)].push_back(gloss);
  const auto match = [&](MissingGloss& one) {
    const auto found = folded.find(loose_form(one.gloss));
    one.folds = found != folded.end();
    one.matches = one.folds ? found->second : near_matches(one.gloss, glosses);
  };
  for (std::size_t i = 0; i < utterance.places.size();) {
    if (MissingGloss joined = joined_from(utterance, i, there, folded); !joined.matches.empty()) {
      i += joined.places;
      missing.push_back(std::move(joined));
      continue;
    }
    if (!there[i]) {
      MissingGloss one{.place = i, .gloss = utterance.places[i].gloss.gloss};
      match(one);
      missing.push_back(std::move(one));
    }
    ++i;
  }
  for (MissingGloss& one : in_parts) {
    match(one);
    missing.push_back(std::move(one));
  }
  return missing;
}

/// The utterance with missing glosses replaced by their first match; those without a match are unchanged.
Utterance suggestion_for(const Utterance& utterance, const std::vector<MissingGloss>& missing) {
  Utterance result;
  std::vector<std::size_t> now_at(utterance.places.size());  // [place] its number in the result
  auto next = missing.begin();
  for (std::size_t i = 0; i < utterance.places.size(); ++i) {
    now_at[i] = result.places.size();
    result.places.push_back(utterance.places[i]);
    if (next == missing.end() || next->part || next->place != i) continue;
    if (!next->matches.empty()) result.places.back().gloss.gloss = next->matches.front();
    for (std::size_t joined = 1; joined < next->places; ++joined) now_at[++i] = result.places.size() - 1;
    ++next;
  }
  for (; next != missing.end(); ++next) {
    if (next->matches.empty()) continue;
    PlacePart& part = result.places[now_at[next->place]].parts[next->part->part];
    part.signs[next->part->sign].sign.gloss.gloss = next->matches.front();
  }
  for (std::size_t i = 0; i < utterance.places.size(); ++i) {
    for (PlacePart& part : result.places[now_at[i]].parts) {
      if (utterance.places[i].parts.empty()) break;
      const std::size_t last = std::min(i + part.places, utterance.places.size()) - 1;
      part.places = now_at[last] - now_at[i] + 1;
    }
  }
  for (const HandHold& held : utterance.holds) {
    result.holds.push_back({.hand = held.hand, .from = now_at[held.from], .until = now_at[held.until]});
  }
  std::erase_if(result.holds, [](const HandHold& held) { return held.from == held.until; });
  for (NonManual one : utterance.non_manuals) {
    one.first = now_at[one.first];
    one.last = now_at[one.last];
    result.non_manuals.push_back(std::move(one));
  }
  for (LocusSetup one : utterance.loci) {
    one.from = now_at[one.from];
    result.loci.push_back(std::move(one));
  }
  return result;
}

MissingGlosses error_of(const Utterance& utterance, std::vector<MissingGloss> missing) {
  std::string names;
  for (std::size_t i = 0; i < std::min(missing.size(), kMostNamed); ++i) {
    if (i > 0) names += i + 1 == missing.size() ? " and " : ", ";
    names += fmt::format("'{}'", printable(missing[i].gloss));
  }
  if (missing.size() > kMostNamed) names += fmt::format(" and {} more", missing.size() - kMostNamed);
  std::string text = fmt::format("no sign{} {} in this database", missing.size() == 1 ? "" : "s", names);
  const bool all = std::ranges::none_of(missing, [](const MissingGloss& one) { return one.matches.empty(); });
  std::string suggestion = all ? to_string(suggestion_for(utterance, missing)) : std::string();
  std::string meant;
  if (missing.size() == 1 && missing.front().places == 1) {
    meant = either_of(missing.front().matches);
  } else if (all) {
    meant = printable(suggestion);
  } else {
    for (const MissingGloss& one : missing) {
      if (one.matches.empty() || meant.size() > 60) continue;
      meant += fmt::format("{}{} for '{}'", meant.empty() ? "" : ", ", one.matches.front(), printable(one.gloss));
    }
  }
  if (!meant.empty()) text += fmt::format("; did you mean {}?", meant);
  return {text, std::move(missing), std::move(suggestion)};
}

}  // namespace

void require_glosses(const Utterance& utterance, const Segments& segments) {
  std::vector<MissingGloss> missing = missing_of(utterance, segments);
  if (!missing.empty()) throw error_of(utterance, std::move(missing));
}

Utterance with_folded_glosses(const Utterance& utterance, const Segments& segments, std::vector<Notice>& notices) {
  const std::vector<MissingGloss> missing = missing_of(utterance, segments);
  std::vector<MissingGloss> unclear;
  std::ranges::copy_if(missing, std::back_inserter(unclear),
                       [](const MissingGloss& one) { return !one.folds || one.matches.size() != 1; });
  if (!unclear.empty()) throw error_of(utterance, unclear);
  for (const MissingGloss& one : missing) {
    notices.push_back({"utterance", fmt::format("'{}' is signed as {}", printable(one.gloss), one.matches.front())});
  }
  return suggestion_for(utterance, missing);
}

}  // namespace signweave
