#include "signweave/features/gloss_stats.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

#include "signweave/core/text.h"
#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

/// Returns the span that carries the meaning; for a sign without a stroke, all of it.
TimeSpan middle_of(const Sign& sign) {
  return sign.stroke_span().value_or(sign.span);
}

bool follows(const Sign& from, const Sign& to) {
  const Milliseconds most = from.inferred || to.inferred ? kRest : kMeeting;
  return from.tier == to.tier && to.span.begin - from.span.end <= most;
}

}  // namespace

std::vector<GlossStats> glosses_of(std::span<const Sign> signs) {
  struct Group {
    std::string gloss;
    std::vector<double> whole;
    std::vector<double> strokes;
  };
  std::map<std::string, Group> groups;
  for (const Sign& sign : signs) {
    Group& group = groups[match_form(sign.gloss)];
    if (group.whole.empty()) group.gloss = sign.gloss;
    group.whole.push_back(count_of(sign.span.duration()));
    const auto stroke = sign.stroke_span();
    if (stroke && !sign.inferred) group.strokes.push_back(count_of(stroke->duration()));
  }
  std::vector<GlossStats> result;
  for (const auto& [name, group] : groups) {
    result.push_back({group.gloss, distribution_of(group.whole), distribution_of(group.strokes)});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const GlossStats& a, const GlossStats& b) { return a.sign.count > b.sign.count; });
  return result;
}

std::vector<NgramStats> ngrams_of(std::span<const std::vector<Sign>> recordings, std::size_t length) {
  assert(length >= 2);
  struct Group {
    std::vector<std::string> glosses;
    std::size_t count = 0;
    std::vector<double> intervals;
  };
  std::map<std::vector<std::string>, Group> groups;
  for (const std::vector<Sign>& signs : recordings) {
    std::vector<std::size_t> order(signs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return signs[a].tier != signs[b].tier ? signs[a].tier < signs[b].tier : signs[a].span.begin < signs[b].span.begin;
    });
    std::size_t run = 0;  // number of consecutive signs up to here
    for (std::size_t i = 0; i < order.size(); ++i) {
      run = i > 0 && follows(signs[order[i - 1]], signs[order[i]]) ? run + 1 : 1;
      if (run < length) continue;
      const std::size_t first = i + 1 - length;
      std::vector<std::string> key;
      for (std::size_t k = first; k <= i; ++k) key.push_back(match_form(signs[order[k]].gloss));
      Group& group = groups[std::move(key)];
      ++group.count;
      for (std::size_t k = first; k <= i; ++k) {
        if (group.count == 1) group.glosses.push_back(signs[order[k]].gloss);
        if (k == first) continue;
        const TimeSpan before = middle_of(signs[order[k - 1]]);
        group.intervals.push_back(count_of(middle_of(signs[order[k]]).begin - before.end));
      }
    }
  }
  std::vector<NgramStats> result;
  for (const auto& [name, group] : groups) {
    result.push_back({group.glosses, group.count, distribution_of(group.intervals)});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const NgramStats& a, const NgramStats& b) { return a.count > b.count; });
  return result;
}

}  // namespace signweave
