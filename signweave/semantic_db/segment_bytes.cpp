#include "signweave/semantic_db/segment_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace signweave {
namespace {

/// Appends lists, each aligned to 8 bytes.
class ListWriter {
 public:
  template <typename T>
  void list(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = bytes_.size();
    bytes_.resize((at + values.size() * sizeof(T) + 7) / 8 * 8);
    if (!values.empty()) std::memcpy(bytes_.data() + at, values.data(), values.size() * sizeof(T));
  }
  Bytes take() noexcept { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

std::uint32_t checked(std::size_t count) {
  if (count >= kNoRow) {
    throw Error(ErrorCode::unsupported,
                fmt::format("{} annotations or letters are more than one database can hold; split it", count));
  }
  return static_cast<std::uint32_t>(count);
}

struct JoinedTexts {
  std::vector<std::uint32_t> begins = {0};
  std::vector<char> characters;

  explicit JoinedTexts(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      characters.insert(characters.end(), text.begin(), text.end());
      begins.push_back(checked(characters.size()));
    }
  }
};

/// Rows by label, then kind, then row; without units.
struct LabelLists {
  std::vector<std::uint32_t> begins;  ///< [text], and one more entry
  std::vector<RowId> rows;
  std::array<std::vector<std::uint32_t>, 3> of_kinds;
};

LabelLists label_lists(const TableLists& lists) {
  const auto kind = [&](RowId row) -> std::size_t { return lists.flags[row] & 3U; };
  std::vector<std::uint32_t> counts(lists.texts.size() * kListedKinds + 1);
  for (RowId row = 0; row < lists.rows(); ++row) {
    if (kind(row) >= kListedKinds) continue;
    ++counts[lists.labels_of_texts[lists.texts_of_rows[row]] * kListedKinds + kind(row) + 1];
  }
  LabelLists made;
  for (std::uint32_t label = 0; label < lists.texts.size(); ++label) {
    for (std::size_t k = 0; k < kListedKinds; ++k) {
      if (counts[label * kListedKinds + k + 1] > 0) made.of_kinds[k].push_back(label);
    }
  }
  for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
  for (std::size_t label = 0; label <= lists.texts.size(); ++label) made.begins.push_back(counts[label * kListedKinds]);
  made.rows.resize(counts.back());
  for (RowId row = 0; row < lists.rows(); ++row) {
    if (kind(row) >= kListedKinds) continue;
    made.rows[counts[lists.labels_of_texts[lists.texts_of_rows[row]] * kListedKinds + kind(row)]++] = row;
  }
  return made;
}

std::vector<std::uint32_t> slots_of(const std::vector<std::string>& texts) {
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * texts.size() + 1), SegmentTable::kNone);
  for (std::uint32_t i = 0; i < texts.size(); ++i) {
    std::size_t at = checksum(bytes_of(texts[i])) & (slots.size() - 1);
    while (slots[at] != SegmentTable::kNone) at = (at + 1) & (slots.size() - 1);
    slots[at] = i;
  }
  return slots;
}

struct ChildLists {
  std::vector<std::uint32_t> begins;
  std::vector<RowId> rows;
};

ChildLists child_lists(const TableLists& lists) {
  ChildLists made;
  made.begins.assign(lists.rows() + std::size_t{1}, 0);
  for (const RowId parent : lists.parents) {
    if (parent != kNoRow) ++made.begins[parent + 1];
  }
  for (std::size_t i = 1; i < made.begins.size(); ++i) made.begins[i] += made.begins[i - 1];
  made.rows.resize(made.begins.back());
  std::vector<std::uint32_t> next(made.begins.begin(), made.begins.end() - 1);
  for (RowId row = 0; row < lists.rows(); ++row) {
    if (lists.parents[row] != kNoRow) made.rows[next[lists.parents[row]]++] = row;
  }
  // Children may be on several tiers, and rows are ordered by tier first.
  const auto earlier = [&](RowId a, RowId b) {
    return std::tuple(lists.spans[a].begin, lists.spans[a].end, a) <
           std::tuple(lists.spans[b].begin, lists.spans[b].end, b);
  };
  for (RowId row = 0; row < lists.rows(); ++row) {
    const auto begin = made.rows.begin() + made.begins[row];
    const auto end = made.rows.begin() + made.begins[row + 1];
    if (!std::is_sorted(begin, end, earlier)) std::sort(begin, end, earlier);
  }
  return made;
}

}  // namespace

std::uint16_t TableBytes::flags_of(const SegmentRow& row) noexcept {
  return static_cast<std::uint16_t>(
      static_cast<unsigned>(row.kind) | static_cast<unsigned>(row.phase) << 2 | static_cast<unsigned>(row.hand) << 5 |
      (row.inferred ? SegmentTable::kInferred : 0) | (row.extra ? SegmentTable::kExtra : 0));
}

Bytes TableBytes::write(const TableLists& lists) {
  const JoinedTexts texts(lists.texts);
  const JoinedTexts tiers(lists.tiers);
  const JoinedTexts recordings(lists.recordings);
  const LabelLists labels = label_lists(lists);
  const std::vector<std::uint32_t> slots = slots_of(lists.texts);
  const ChildLists children = child_lists(lists);
  std::array<std::vector<RowId>, 5> phases;
  std::vector<RowId> units;
  constexpr std::int64_t kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  bool wide = false;
  for (RowId row = 0; row < lists.rows(); ++row) {
    const auto kind = static_cast<RowKind>(lists.flags[row] & 3U);
    if (kind == RowKind::phase) phases[lists.flags[row] >> 2 & 7U].push_back(row);
    if (kind == RowKind::unit) units.push_back(row);
    const TimeSpan span = lists.spans[row];
    wide = wide || std::min(span.begin, span.end).count() < kLeast || std::max(span.begin, span.end).count() > kMost;
  }

  TableCounts counts{};
  counts.texts = checked(lists.texts.size());
  counts.text_bytes = checked(texts.characters.size());
  counts.tiers = checked(lists.tiers.size());
  counts.tier_bytes = checked(tiers.characters.size());
  counts.recordings = checked(lists.recordings.size());
  counts.recording_bytes = checked(recordings.characters.size());
  counts.places = checked(lists.places.size());
  counts.slots = checked(slots.size());
  for (std::size_t k = 0; k < kListedKinds; ++k) counts.labels_of_kinds[k] = checked(labels.of_kinds[k].size());
  for (std::size_t k = 0; k < phases.size(); ++k) counts.phases[k] = checked(phases[k].size());
  counts.units = checked(units.size());
  counts.rows = checked(lists.spans.size());
  counts.children = checked(children.rows.size());

  std::vector<std::uint32_t> head = {kTableVersion, wide ? 1U : 0U};
  head.resize(kTableHead / sizeof(std::uint32_t));
  std::memcpy(head.data() + 2, &counts, sizeof counts);
  ListWriter out;
  out.list(head);
  for (const JoinedTexts* each : {&texts, &tiers, &recordings}) {
    out.list(each->begins);
    out.list(each->characters);
  }
  out.list(lists.recording_tiers);
  out.list(lists.recording_begins);
  out.list(lists.places);
  out.list(lists.labels_of_texts);
  out.list(slots);
  out.list(labels.begins);
  out.list(labels.rows);
  for (const auto& each : labels.of_kinds) out.list(each);
  for (const auto& each : phases) out.list(each);
  out.list(units);
  if (wide) {
    std::vector<std::int64_t> times;
    for (const TimeSpan span : lists.spans) times.insert(times.end(), {span.begin.count(), span.end.count()});
    out.list(times);
  } else {
    std::vector<std::int32_t> begins;
    std::vector<std::int32_t> ends;
    for (const TimeSpan span : lists.spans) {
      begins.push_back(static_cast<std::int32_t>(span.begin.count()));
      ends.push_back(static_cast<std::int32_t>(span.end.count()));
    }
    out.list(begins);
    out.list(ends);
  }
  out.list(lists.texts_of_rows);
  out.list(lists.parents);
  out.list(lists.places_of_rows);
  out.list(lists.flags);
  out.list(children.begins);
  out.list(children.rows);
  return out.take();
}

}  // namespace signweave
