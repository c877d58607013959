#include "signweave/semantic_db/segments.h"

#include <algorithm>
#include <map>
#include <set>

namespace signweave {

Segments::Segments(SegmentTable table) {
  std::vector<Aged> one;
  one.push_back({std::move(table), 0});
  *this = Segments(std::move(one));
}

Segments::Segments(std::vector<Aged> tables, std::span<const Tombstone> tombstones) {
  RowId first = 0;
  for (std::uint32_t number = 0; number < tables.size(); ++number) {
    const std::uint32_t recordings = tables[number].table.recording_count();
    Member member{.table = std::move(tables[number].table), .first = first, .numbers = {}};
    member.numbers.assign(recordings, 0);
    for (const Tombstone& tombstone : tombstones) {
      if (tables[number].generation >= tombstone.generation) continue;
      const std::uint32_t gone = member.table.find_recording(tombstone.recording);
      if (gone == kNone) continue;
      member.numbers[gone] = kNone;
      member.whole = false;
    }
    for (std::uint32_t recording = 0; recording < recordings; ++recording) {
      if (member.numbers[recording] == kNone) continue;
      recordings_.emplace_back(number, recording);
      rows_ += member.table.recording_rows(recording).size();
    }
    first += member.table.size();
    members_.push_back(std::move(member));
  }
  const auto name = [this](const auto& place) { return members_[place.first].table.recording_at(place.second); };
  if (members_.size() > 1) std::ranges::sort(recordings_, {}, name);  // those of one table are already in order
  for (std::uint32_t i = 0; i < recordings_.size(); ++i) {
    members_[recordings_[i].first].numbers[recordings_[i].second] = i;
  }
}

std::string_view Segments::recording_name(std::uint32_t recording) const noexcept {
  return members_[recordings_[recording].first].table.recording_at(recordings_[recording].second);
}

std::uint32_t Segments::find_recording(std::string_view name) const noexcept {
  for (const Member& member : members_) {
    const std::uint32_t at = member.table.find_recording(name);
    if (at != kNone && member.numbers[at] != kNone) return member.numbers[at];
  }
  return kNone;
}

std::uint32_t Segments::recording(RowId row) const noexcept {
  const Member& member = member_of(row);
  return member.numbers[member.table.recording(row - member.first)];
}

std::string_view Segments::label(RowId row) const noexcept {
  const Member& member = member_of(row);
  return member.table.text_at(member.table.label(row - member.first));
}

std::string_view Segments::text(RowId row) const noexcept {
  const Member& member = member_of(row);
  return member.table.text_at(member.table.text(row - member.first));
}

std::string_view Segments::tier(RowId row) const noexcept {
  const Member& member = member_of(row);
  return member.table.tier_at(member.table.tier(row - member.first));
}

RowId Segments::parent(RowId row) const noexcept {
  const Member& member = member_of(row);
  const RowId parent = member.table.parent(row - member.first);
  return parent == kNoRow ? kNoRow : parent + member.first;
}

SegmentTable::RowRange Segments::recording_rows(std::uint32_t recording) const noexcept {
  const SegmentTable::RecordingRef there = part(recording);
  const SegmentTable::RowRange rows = there.table->recording_rows(there.recording);
  return {rows.begin + first_row(recording), rows.end + first_row(recording)};
}

SegmentTable::RowRange Segments::tier_rows_of(RowId row) const noexcept {
  const Member& member = member_of(row);
  const SegmentTable::RowRange rows = member.table.tier_rows_of(row - member.first).own();
  return {rows.begin + member.first, rows.end + member.first};
}

SegmentTable::RowRange Segments::tier_rows(std::uint32_t recording, std::string_view tier) const noexcept {
  const SegmentTable::RecordingRef there = part(recording);
  const SegmentTable::TierRows* rows = there.table->tier_rows(there.recording, there.table->find_tier(tier));
  if (rows == nullptr) return {};
  return {rows->begin + first_row(recording), rows->own_end + first_row(recording)};
}

std::vector<RowId> Segments::signs_with(std::string_view gloss) const {
  std::vector<RowId> rows;
  for (const Member& member : members_) {
    for (const RowId row : member.table.with_label(RowKind::sign, member.table.find_text(gloss))) {
      if (member.numbers[member.table.recording(row)] != kNone) rows.push_back(row + member.first);
    }
  }
  if (members_.size() > 1) {
    std::ranges::sort(rows, {}, [this](RowId row) { return std::pair(recording(row), row); });
  }
  return rows;
}

std::vector<std::string> Segments::glosses() const {
  std::vector<std::string> result;
  for (const Member& member : members_) {
    for (const std::uint32_t label : member.table.labels_of(RowKind::sign)) {
      if (!member.whole) {
        const auto rows = member.table.with_label(RowKind::sign, label);
        const auto counts = [&](RowId row) { return member.numbers[member.table.recording(row)] != kNone; };
        if (std::ranges::none_of(rows, counts)) continue;
      }
      result.emplace_back(member.table.text_at(label));
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<std::string> Segments::recordings() const {
  std::vector<std::string> result;
  for (std::uint32_t i = 0; i < recording_count(); ++i) result.emplace_back(recording_name(i));
  return result;
}

std::vector<std::string> Segments::tiers() const {
  std::set<std::string_view> ids;
  for (std::uint32_t i = 0; i < recording_count(); ++i) {
    const SegmentTable::RecordingRef there = part(i);
    for (const auto& rows : there.table->tiers_of(there.recording)) ids.insert(there.table->tier_at(rows.tier));
  }
  return {ids.begin(), ids.end()};
}

Sign sign_at(const Segments& segments, RowId row) {
  Sign sign{.gloss = std::string(segments.text(row)),
            .span = segments.span(row),
            .phases = {},
            .hand = segments.hand(row),
            .signer = {},
            .tier = std::string(segments.tier(row)),
            .annotation = {},
            .inferred = segments.inferred(row)};
  for (const RowId child : segments.children(row)) {
    if (segments.kind(child) != RowKind::phase) continue;
    sign.phases.push_back({segments.phase(child), segments.span(child), std::string(segments.text(child)), {}});
  }
  return sign;
}

std::vector<Sign> signs_of(const Segments& segments, std::uint32_t recording) {
  std::vector<Sign> signs;
  const SegmentTable::RowRange rows = segments.recording_rows(recording);
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (segments.kind(row) == RowKind::sign) signs.push_back(sign_at(segments, row));
  }
  return signs;
}

std::vector<std::vector<std::size_t>> phase_places_of(const Segments& segments, std::uint32_t recording) {
  const SegmentTable::RowRange rows = segments.recording_rows(recording);
  std::vector<std::size_t> places(rows.size());  // [row]
  std::size_t phases = 0;
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (segments.kind(row) == RowKind::phase) places[row - rows.begin] = phases++;
  }
  std::vector<std::vector<std::size_t>> of_signs;
  for (RowId row = rows.begin; row < rows.end; ++row) {
    if (segments.kind(row) != RowKind::sign) continue;
    of_signs.emplace_back();
    for (const RowId child : segments.children(row)) {
      if (segments.kind(child) == RowKind::phase) of_signs.back().push_back(places[child - rows.begin]);
    }
  }
  return of_signs;
}

std::vector<Sign> main_signs_of(const Segments& segments, std::uint32_t recording) {
  std::map<std::string, std::vector<Sign>> tiers;
  for (Sign& sign : signs_of(segments, recording)) tiers[sign.tier].push_back(std::move(sign));
  std::vector<Sign> main;
  for (auto& [tier, signs] : tiers) {
    if (signs.size() > main.size()) main = std::move(signs);
  }
  return main;
}

}  // namespace signweave
