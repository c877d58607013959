#include "signweave/database/signer_dominance.h"

#include <array>
#include <span>
#include <vector>

#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

namespace {

/// Calls `visit(row, paths)` for each sign of a recording, with the paths of its strokes.
void visit_signs(const Snapshot& snapshot, std::size_t recording, auto&& visit) {
  const Segments& table = snapshot.contents().segments;
  const auto number = static_cast<std::uint32_t>(recording);
  const RecordingFeatures features = snapshot.features(recording);
  const std::vector<std::vector<std::size_t>> places = phase_places_of(table, number);
  std::vector<StrokePaths> strokes;
  std::size_t sign = 0;
  const SegmentTable::RowRange rows = table.recording_rows(number);
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (table.kind(row) != RowKind::sign) continue;
    strokes.clear();
    const std::vector<std::size_t>& phases = places[sign++];
    std::size_t at = 0;
    for (const RowId child : table.children(row)) {
      if (table.kind(child) != RowKind::phase) continue;
      const std::size_t place = at < phases.size() ? phases[at++] : features.phases.size();
      if (place >= features.phases.size() || table.phase(child) != PhaseKind::stroke) continue;
      const std::array<HandOver, 2>& hands = features.phases[place].hands;
      if (hands[0].known && hands[1].known) strokes.push_back({hands[0].path_length, hands[1].path_length});
    }
    visit(row, std::span<const StrokePaths>(strokes));
  }
}

}  // namespace

Dominance dominance_of(const Snapshot& snapshot, std::size_t recording) {
  const Segments& table = snapshot.contents().segments;
  std::vector<StrokePaths> all;
  HandCounts annotated;
  visit_signs(snapshot, recording, [&](RowId row, std::span<const StrokePaths> strokes) {
    if (table.hand(row) == Hand::left) ++annotated.left;
    if (table.hand(row) == Hand::right) ++annotated.right;
    all.insert(all.end(), strokes.begin(), strokes.end());
  });
  return dominance_of(all, annotated);
}

std::optional<Side> only_hand_of(const Snapshot& snapshot, RowId sign) {
  const Segments& table = snapshot.contents().segments;
  std::optional<Side> found;
  visit_signs(snapshot, table.recording(sign), [&](RowId row, std::span<const StrokePaths> strokes) {
    if (row != sign) return;
    StrokePaths sum;
    for (const StrokePaths& stroke : strokes) {
      sum.left += stroke.left;
      sum.right += stroke.right;
    }
    found = only_hand(sum);
  });
  return found;
}

}  // namespace signweave
