#include "signweave/database/signer_dominance.h"

#include <vector>

#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

Dominance dominance_of(const Snapshot& snapshot, std::size_t recording) {
  const Segments& table = snapshot.contents().segments;
  const auto number = static_cast<std::uint32_t>(recording);
  const RecordingFeatures features = snapshot.features(recording);
  const std::vector<std::vector<std::size_t>> places = phase_places_of(table, number);
  std::vector<StrokePaths> strokes;
  HandCounts annotated;
  std::size_t sign = 0;
  const SegmentTable::RowRange rows = table.recording_rows(number);
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (table.kind(row) != RowKind::sign) continue;
    if (table.hand(row) == Hand::left) ++annotated.left;
    if (table.hand(row) == Hand::right) ++annotated.right;
    const std::vector<std::size_t>& phases = places[sign++];
    std::size_t at = 0;
    for (const RowId child : table.children(row)) {
      if (table.kind(child) != RowKind::phase) continue;
      const std::size_t place = at < phases.size() ? phases[at++] : features.phases.size();
      if (place >= features.phases.size() || table.phase(child) != PhaseKind::stroke) continue;
      const std::array<HandOver, 2>& hands = features.phases[place].hands;
      if (hands[0].known && hands[1].known) strokes.push_back({hands[0].path_length, hands[1].path_length});
    }
  }
  return dominance_of(strokes, annotated);
}

}  // namespace signweave
