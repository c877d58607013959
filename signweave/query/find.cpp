#include "signweave/query/find.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "signweave/query/rank.h"
#include "signweave/query/search.h"
#include "signweave/query/series_over.h"

namespace signweave {

struct PreparedQuery::State {
  PhaseQuery query;
  std::shared_ptr<const Segments> segments;
  std::vector<std::unique_ptr<Search>> searches;  ///< one per table
  const Movement* movement = nullptr;
  std::optional<std::size_t> ranked;  ///< the place that like(…) orders

  void run(const FindLimits& limits, bool parts = true);
  template <typename Use>
  void for_matches(const FindLimits& limits, Use&& use);
  std::vector<Segment> segments_found(const FindLimits& limits);
  /// Ranks all candidates and returns the nearest.
  std::vector<Segment> nearest(const FindLimits& limits);
};

void PreparedQuery::State::run(const FindLimits& limits, bool parts) {
  for (const std::unique_ptr<Search>& search : searches) search->run(limits, parts);
}

/// Calls `use(search, match)` for the results of the last run, by recording, until the limit. Each recording is in one
/// table only.
template <typename Use>
void PreparedQuery::State::for_matches(const FindLimits& limits, Use&& use) {
  struct Run {
    std::uint32_t recording;
    Search* search;
    std::span<const Search::Match> matches;
  };
  std::size_t left = limits.limit.value_or(std::numeric_limits<std::size_t>::max());
  std::vector<Run> runs;
  for (const std::unique_ptr<Search>& search : searches) {
    std::span<const Search::Match> all = search->matches();
    if (searches.size() == 1) runs.push_back({0, search.get(), std::exchange(all, {})});
    while (!all.empty()) {
      const auto end = std::ranges::upper_bound(all, all.front().recording, {}, &Search::Match::recording);
      const auto count = static_cast<std::size_t>(end - all.begin());
      runs.push_back({search->member().numbers[all.front().recording], search.get(), all.first(count)});
      all = all.subspan(count);
    }
  }
  std::ranges::sort(runs, {}, &Run::recording);
  for (const Run& run : runs) {
    for (const Search::Match& match : run.matches) {
      if (left-- == 0) return;
      use(*run.search, match);
    }
  }
}

std::vector<Segment> PreparedQuery::State::segments_found(const FindLimits& limits) {
  run(limits);
  std::vector<Segment> result;
  std::size_t count = 0;
  for (const std::unique_ptr<Search>& search : searches) count += search->matches().size();
  result.reserve(std::min(count, limits.limit.value_or(count)));
  for_matches(limits, [&](Search& search, const Search::Match& match) { result.push_back(search.segment_of(match)); });
  return result;
}

std::vector<Segment> PreparedQuery::State::nearest(const FindLimits& limits) {
  StopCheck stop_check;
  stop_check.begin(limits);
  RankedExample example(example_at(query, *ranked), *segments, movement);
  FindLimits unlimited = limits;
  unlimited.limit.reset();
  std::vector<Segment> all = segments_found(unlimited);
  const std::size_t part = part_of_place(query, *ranked);
  NearestSearch search(example.shape(), std::max<std::size_t>(1, limits.limit.value_or(kNearest)));
  for (std::size_t i = 0; i < all.size(); ++i) {
    stop_check.tick();
    const RowId row = all[i].parts.empty() ? all[i].row : all[i].parts[part].row;
    const TimeSpan span = all[i].parts.empty() ? all[i].span : all[i].parts[part].span;
    example.offer(static_cast<std::uint32_t>(i), segments->recording(row), span, search);
  }
  std::vector<Segment> result;
  for (const NearestSearch::Found& found : search.take()) {
    result.push_back(std::move(all[found.id]));
    result.back().distance = found.distance;
  }
  if (limits.limit && result.size() > *limits.limit) result.clear();
  return result;
}

PreparedQuery::PreparedQuery(PhaseQuery query, std::shared_ptr<const Segments> segments, const Movement* movement,
                             const FindLimits& limits)
    : state_(std::make_unique<State>()) {
  state_->query = std::move(query);
  state_->segments = std::move(segments);
  state_->movement = movement;
  state_->ranked = ranked_place(state_->query);
  if (movement != nullptr) require_tracks(state_->query, *movement);
  for (const Segments::Member& member : state_->segments->members()) {
    state_->searches.push_back(std::make_unique<Search>(state_->query, member, movement, limits));
  }
}

PreparedQuery::~PreparedQuery() = default;
PreparedQuery::PreparedQuery(PreparedQuery&&) noexcept = default;
PreparedQuery& PreparedQuery::operator=(PreparedQuery&&) noexcept = default;

FindCounts PreparedQuery::counts() const noexcept {
  FindCounts all;
  for (const std::unique_ptr<Search>& search : state_->searches) {
    all.looked_at += search->counts().looked_at;
    all.kept += search->counts().kept;
  }
  return all;
}

std::vector<Segment> PreparedQuery::find(const FindLimits& limits) {
  return state_->ranked ? state_->nearest(limits) : state_->segments_found(limits);
}

void PreparedQuery::find(std::vector<FoundRow>& rows, const FindLimits& limits) {
  rows.clear();
  if (state_->ranked) {
    for (const Segment& segment : state_->nearest(limits)) rows.push_back({segment.row, segment.span});
    return;
  }
  state_->run(limits, false);
  state_->for_matches(limits,
                      [&](const Search& search, const Search::Match& match) { rows.push_back(search.row_of(match)); });
}

std::vector<Segment> find(const PhaseQuery& query, const Segments& segments, const FindLimits& limits,
                          const Movement* movement) {
  // The borrowed arguments outlive the query.
  return PreparedQuery(query, std::shared_ptr<const Segments>(std::shared_ptr<void>(), &segments), movement, limits)
      .find(limits);
}

}  // namespace signweave
