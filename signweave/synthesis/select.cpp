#include "signweave/synthesis/select.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "signweave/features/transition_stats.h"

namespace signweave {
namespace {

struct Ends {
  Pose first;  ///< the first stroke frame
  Pose last;   ///< the last stroke frame
};

/// Reads single poses, opening each recording once.
class PoseReader {
 public:
  explicit PoseReader(const Snapshot& snapshot) : snapshot_(snapshot) {}

  Pose at(std::size_t recording, std::int64_t frame) {
    std::unique_ptr<MotionSource>& source = sources_[recording];
    if (!source) source = snapshot_.motion(snapshot_.contents().recordings[recording]);
    Pose pose(*source->skeleton());
    source->read({frame, frame + 1}, {pose.rotations, pose.translations});
    return pose;
  }

 private:
  const Snapshot& snapshot_;
  std::map<std::size_t, std::unique_ptr<MotionSource>> sources_;
};

double distance(const Pose& a, const Pose& b) {
  // Skeletons of one corpus may differ; what cannot be compared is as far as can be. Joining them is refused later, by
  // joint name.
  if (a.rotations.size() != b.rotations.size()) return 3.2;
  double sum = 0;
  for (std::size_t i = 1; i < a.rotations.size(); ++i) {  // without the root, which is aligned away
    const double cosine = std::min(1.0, std::abs(static_cast<double>(a.rotations[i].dot(b.rotations[i]))));
    sum += 2.0 * std::acos(cosine);
  }
  return a.rotations.size() > 1 ? sum / static_cast<double>(a.rotations.size() - 1) : 0.0;
}

}  // namespace

bool are_neighbours(const Contents& contents, const Candidate& a, const Candidate& b) {
  if (a.recording != b.recording || a.signs.empty() || b.signs.empty()) return false;
  const Sign& before = a.signs.back();
  const Sign& after = b.signs.front();
  if (before.tier != after.tier || after.span.begin < before.span.end || after.span.begin - before.span.end >= kRest) {
    return false;
  }
  const SegmentTable& table = contents.segments;
  const auto tier = table.find_tier(before.tier);
  const SegmentTable::RowRange rows = table.tier_rows(static_cast<std::uint32_t>(a.recording), tier);
  for (RowId row = rows.begin; row < rows.end; ++row) {  // nothing lies between the two
    const TimeSpan between = table.row(row).span;
    if (table.row(row).kind == RowKind::sign && between.begin >= before.span.end && between.end <= after.span.begin &&
        between.duration() > Milliseconds(0)) {
      return false;
    }
  }
  return true;
}

Selection select(const Snapshot& snapshot, std::span<const Choice> choices) {
  const Contents& contents = snapshot.contents();
  PoseReader poses(snapshot);
  Selection selection;
  if (choices.empty()) return selection;
  const auto ends_of = [&](const Choice& choice) {
    std::vector<Ends> ends;
    for (const Candidate& candidate : choice.candidates) {
      ends.push_back(
          {poses.at(candidate.recording, candidate.core.begin), poses.at(candidate.recording, candidate.core.end - 1)});
    }
    return ends;
  };
  std::vector<std::vector<double>> best(choices.size());
  std::vector<std::vector<double>> joins(choices.size());
  std::vector<std::vector<std::size_t>> from(choices.size());
  std::vector<Ends> before;
  // With one candidate everywhere there is nothing to choose, and no frame need be read.
  const bool open =
      std::any_of(choices.begin(), choices.end(), [](const Choice& c) { return c.candidates.size() > 1; });
  selection.measured = open;
  for (std::size_t place = 0; place < choices.size(); ++place) {
    const std::vector<Candidate>& here = choices[place].candidates;
    std::vector<Ends> ends = open ? ends_of(choices[place]) : std::vector<Ends>(here.size());
    best[place].assign(here.size(), std::numeric_limits<double>::infinity());
    joins[place].assign(here.size(), 0.0);
    from[place].assign(here.size(), 0);
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (place == 0) {
        best[0][i] = here[i].cost;
        continue;
      }
      const std::vector<Candidate>& last = choices[place - 1].candidates;
      for (std::size_t j = 0; j < last.size(); ++j) {
        const bool kept = choices[place].pause_before == Milliseconds(0) && are_neighbours(contents, last[j], here[i]);
        const double join = kept || !open ? 0.0 : distance(before[j].last, ends[i].first);
        const double cost = best[place - 1][j] + join + here[i].cost;
        if (cost < best[place][i]) {
          best[place][i] = cost;
          joins[place][i] = join;
          from[place][i] = j;
        }
      }
    }
    before = std::move(ends);
  }
  selection.chosen.resize(choices.size());
  selection.join_costs.resize(choices.size());
  std::size_t at =
      static_cast<std::size_t>(std::min_element(best.back().begin(), best.back().end()) - best.back().begin());
  selection.total = best.back()[at];
  for (std::size_t place = choices.size(); place-- > 0;) {
    selection.chosen[place] = at;
    selection.join_costs[place] = joins[place][at];
    at = from[place][at];
  }
  return selection;
}

}  // namespace signweave
