#include "signweave/query/find.h"

#include <algorithm>

#include "signweave/query/rank.h"
#include "signweave/query/search.h"

namespace signweave {

struct PreparedQuery::State {
  PhaseQuery query;
  std::shared_ptr<const Segments> segments;
  std::vector<std::unique_ptr<Search>> searches;  ///< one for each table
  const Movement* movement = nullptr;
  std::optional<std::size_t> ranked;  ///< the place that like(…) orders

  /// All that it is to choose from, and the nearest of them.
  std::vector<Segment> nearest(const FindLimits& limits);
};

std::vector<Segment> PreparedQuery::State::nearest(const FindLimits& limits) {
  Watch watch;
  watch.begin(limits);
  RankedExample example(example_at(query, *ranked), *segments, movement);
  FindLimits unlimited = limits;
  unlimited.limit.reset();
  std::vector<Segment> all;
  for (const std::unique_ptr<Search>& search : searches) {
    search->run(unlimited);
    search->append(all);
  }
  if (searches.size() > 1) std::ranges::stable_sort(all, {}, &Segment::recording);
  std::size_t part = 0;
  for (std::size_t place = 0; place < *ranked; ++place) part += 1 + query.elements[place].relations.size();
  NearestSearch search(example.shape(), std::max<std::size_t>(1, limits.limit.value_or(kNearest)));
  for (std::size_t i = 0; i < all.size(); ++i) {
    watch.tick();
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

PreparedQuery::PreparedQuery(PhaseQuery query, std::shared_ptr<const Segments> segments, const Movement* movement)
    : state_(std::make_unique<State>()) {
  state_->query = std::move(query);
  state_->segments = std::move(segments);
  state_->movement = movement;
  state_->ranked = ranked_place(state_->query);
  for (const Segments::Member& member : state_->segments->members()) {
    state_->searches.push_back(std::make_unique<Search>(state_->query, member, movement));
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
  if (state_->ranked) return state_->nearest(limits);
  std::vector<Segment> result;
  for (const std::unique_ptr<Search>& search : state_->searches) {
    search->run(limits);
    search->append(result);
  }
  if (state_->searches.size() > 1) {  // each in order, each of other recordings
    std::ranges::stable_sort(result, {}, &Segment::recording);
    if (limits.limit && result.size() > *limits.limit) result.resize(*limits.limit);
  }
  return result;
}

void PreparedQuery::find(std::vector<FoundRow>& rows, const FindLimits& limits) {
  rows.clear();
  if (state_->ranked) {
    for (const Segment& segment : state_->nearest(limits)) rows.push_back({segment.row, segment.span});
    return;
  }
  const Segments& segments = *state_->segments;
  bool ordered = true;
  for (const std::unique_ptr<Search>& search : state_->searches) {
    search->run(limits);
    const std::size_t before = rows.size();
    search->append(rows);
    if (before == 0 || before == rows.size()) continue;
    ordered = ordered && segments.recording(rows[before - 1].row) < segments.recording(rows[before].row);
  }
  if (state_->searches.size() > 1) {
    if (!ordered) {
      std::ranges::stable_sort(rows, {}, [&](const FoundRow& one) { return segments.recording(one.row); });
    }
    if (limits.limit && rows.size() > *limits.limit) rows.resize(*limits.limit);
  }
}

std::vector<Segment> find(const PhaseQuery& query, const Segments& segments, const FindLimits& limits,
                          const Movement* movement) {
  // What is borrowed outlives the query.
  return PreparedQuery(query, std::shared_ptr<const Segments>(std::shared_ptr<void>(), &segments), movement)
      .find(limits);
}

}  // namespace signweave
