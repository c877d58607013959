#include "signweave/semantic_db/segment_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "signweave/core/text.h"

namespace signweave {
namespace {

std::uint32_t intern(std::vector<std::string>& list, std::unordered_map<std::string, std::uint32_t>& index,
                     const std::string& text) {
  const auto [at, added] = index.try_emplace(text, static_cast<std::uint32_t>(list.size()));
  if (added) list.push_back(text);
  return at->second;
}

std::uint32_t find(const std::unordered_map<std::string, std::uint32_t>& index, std::string_view text) {
  const auto at = index.find(std::string(text));
  return at == index.end() ? SegmentTable::kNone : at->second;
}

std::uint64_t label_key(RowKind kind, std::uint32_t label) noexcept {
  return static_cast<std::uint64_t>(kind) << 32 | label;
}

constexpr std::size_t kRowKinds = 3;
constexpr std::size_t kPhaseKinds = 5;

}  // namespace

SegmentTable::SegmentTable(std::span<const Source> sources) {
  std::size_t total = 0;
  for (const Source& source : sources) total += source.chunk->rows.size();
  if (total >= kNoRow) {
    throw Error(ErrorCode::unsupported,
                fmt::format("{} annotations are more than one database can hold; split it", total));
  }
  rows_.reserve(total);
  for (const Source& source : sources) add(source);
  index_tiers();
  index_labels();
  index_children();
}

void SegmentTable::add(const Source& source) {
  const auto recording = static_cast<std::uint32_t>(recordings_.size());
  if (!recording_index_.try_emplace(source.recording, recording).second) {
    throw Error(ErrorCode::already_exists,
                fmt::format("recording '{}' is there twice; rename one", printable(source.recording)));
  }
  recordings_.push_back(source.recording);
  std::vector<std::uint32_t> tiers;
  std::vector<std::uint32_t> labels;
  for (const std::string& tier : source.chunk->tiers) tiers.push_back(intern(tiers_, tier_index_, tier));
  for (const std::string& label : source.chunk->labels) labels.push_back(intern(labels_, label_index_, label));
  const auto first = static_cast<RowId>(rows_.size());
  for (SegmentRow row : source.chunk->rows) {
    row.recording = recording;
    row.tier = tiers[row.tier];
    row.label = labels[row.label];
    row.text = labels[row.text];
    if (row.parent != kNoRow) row.parent += first;
    rows_.push_back(row);
  }
  recording_rows_.push_back({first, static_cast<RowId>(rows_.size())});
}

void SegmentTable::index_tiers() {
  tier_rows_.resize(recordings_.size());
  for (std::size_t recording = 0; recording < recordings_.size(); ++recording) {
    std::vector<TierRows>& list = tier_rows_[recording];
    const RowRange all = recording_rows_[recording];
    for (RowId id = all.begin; id < all.end; ++id) {
      const SegmentRow& row = rows_[id];
      if (list.empty() || list.back().tier != row.tier) list.push_back({row.tier, {id, id}, {id, id}});
      TierRows& rows = list.back();
      rows.extra.end = id + 1;
      const bool follows = rows.own.begin < id && row.extra == rows_[id - 1].extra;
      if (row.span.end < row.span.begin || (follows && row.span.begin < rows_[id - 1].span.end)) rows.apart = false;
      if (row.extra) continue;
      rows.own.end = id + 1;
      rows.extra.begin = id + 1;
    }
    std::sort(list.begin(), list.end(), [](const TierRows& a, const TierRows& b) { return a.tier < b.tier; });
  }
}

void SegmentTable::index_labels() {
  by_phase_.resize(kPhaseKinds);
  labels_of_.resize(kRowKinds);
  for (RowId id = 0; id < rows_.size(); ++id) {
    const SegmentRow& row = rows_[id];
    std::vector<RowId>& with = by_label_[label_key(row.kind, row.label)];
    if (with.empty()) labels_of_[static_cast<std::size_t>(row.kind)].push_back(row.label);
    with.push_back(id);
    if (row.kind == RowKind::phase) by_phase_[static_cast<std::size_t>(row.phase)].push_back(id);
  }
  for (std::vector<std::uint32_t>& labels : labels_of_) std::sort(labels.begin(), labels.end());
}

void SegmentTable::index_children() {
  children_begin_.assign(rows_.size() + 1, 0);
  for (const SegmentRow& row : rows_) {
    if (row.parent != kNoRow) ++children_begin_[row.parent + 1];
  }
  for (std::size_t i = 1; i < children_begin_.size(); ++i) children_begin_[i] += children_begin_[i - 1];
  child_list_.resize(children_begin_.back());
  std::vector<std::uint32_t> next(children_begin_.begin(), children_begin_.end() - 1);
  for (RowId id = 0; id < rows_.size(); ++id) {
    if (rows_[id].parent != kNoRow) child_list_[next[rows_[id].parent]++] = id;
  }
  // Children may lie on several tiers, and rows are ordered by tier first.
  const auto earlier = [this](RowId a, RowId b) {
    return std::tuple(rows_[a].span.begin, rows_[a].span.end, a) <
           std::tuple(rows_[b].span.begin, rows_[b].span.end, b);
  };
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const auto begin = child_list_.begin() + children_begin_[row];
    const auto end = child_list_.begin() + children_begin_[row + 1];
    if (!std::is_sorted(begin, end, earlier)) std::sort(begin, end, earlier);
  }
}

std::uint32_t SegmentTable::find_label(std::string_view match_form) const noexcept {
  return find(label_index_, match_form);
}

std::uint32_t SegmentTable::find_tier(std::string_view id) const noexcept {
  return find(tier_index_, id);
}

std::uint32_t SegmentTable::find_recording(std::string_view name) const noexcept {
  return find(recording_index_, name);
}

std::span<const RowId> SegmentTable::with_label(RowKind kind, std::uint32_t label) const noexcept {
  const auto at = by_label_.find(label_key(kind, label));
  return at == by_label_.end() ? std::span<const RowId>() : std::span<const RowId>(at->second);
}

std::span<const std::uint32_t> SegmentTable::labels_of(RowKind kind) const noexcept {
  return labels_of_.empty() ? std::span<const std::uint32_t>() : labels_of_[static_cast<std::size_t>(kind)];
}

std::span<const RowId> SegmentTable::phases(PhaseKind kind) const noexcept {
  return by_phase_.empty() ? std::span<const RowId>() : by_phase_[static_cast<std::size_t>(kind)];
}

std::span<const SegmentTable::TierRows> SegmentTable::tiers_of(std::uint32_t recording) const noexcept {
  return recording < tier_rows_.size() ? tier_rows_[recording] : std::span<const TierRows>();
}

SegmentTable::RowRange SegmentTable::tier_rows(std::uint32_t recording, std::uint32_t tier) const noexcept {
  const std::span<const TierRows> tiers = tiers_of(recording);
  const auto at = std::lower_bound(tiers.begin(), tiers.end(), tier,
                                   [](const TierRows& rows, std::uint32_t wanted) { return rows.tier < wanted; });
  return at == tiers.end() || at->tier != tier ? RowRange() : at->own;
}

SegmentTable::RowRange SegmentTable::recording_rows(std::uint32_t recording) const noexcept {
  return recording < recording_rows_.size() ? recording_rows_[recording] : RowRange();
}

std::span<const RowId> SegmentTable::children(RowId row) const noexcept {
  return std::span(child_list_).subspan(children_begin_[row], children_begin_[row + 1] - children_begin_[row]);
}

std::vector<std::string> SegmentTable::glosses() const {
  std::vector<std::string> result;
  for (const std::uint32_t label : labels_of(RowKind::sign)) result.push_back(labels_[label]);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace signweave
