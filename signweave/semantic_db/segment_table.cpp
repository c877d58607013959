#include "signweave/semantic_db/segment_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "signweave/core/text.h"
#include "signweave/features/transition_stats.h"
#include "signweave/semantic_db/segment_bytes.h"

namespace signweave {
namespace {

/// Gives each text a number, in order of first appearance.
class Numbers {
 public:
  explicit Numbers(std::vector<std::string>& list) : list_(list) {}
  std::uint32_t of(std::string_view text) {
    const auto [at, added] = index_.try_emplace(std::string(text), static_cast<std::uint32_t>(list_.size()));
    if (added) list_.emplace_back(text);
    return at->second;
  }

 private:
  std::vector<std::string>& list_;
  std::unordered_map<std::string, std::uint32_t> index_;
};

/// Appends recordings one after the other, by name.
class TableBuilder {
 public:
  TableBuilder() : texts_(lists_.texts), tiers_(lists_.tiers) {}

  void add(const SegmentTable::Source& source) {
    begin_recording(source.recording);
    const SegmentChunk& chunk = *source.chunk;
    std::vector<std::uint32_t> texts;
    for (const std::string& label : chunk.labels) texts.push_back(text(label));
    for (const auto& row : chunk.rows) {  // the match form of each text
      lists_.labels_of_texts[texts[row.text]] = texts[row.label];
    }
    std::vector<RowId> places(chunk.rows.size());  // [row of the chunk] its row here
    for (std::size_t begin = 0; begin < chunk.rows.size();) {
      std::size_t end = begin;
      while (end < chunk.rows.size() && chunk.rows[end].tier == chunk.rows[begin].tier) ++end;
      const std::string& tier = chunk.tiers[chunk.rows[begin].tier];
      add_tier(source, tier, std::span(chunk.rows).subspan(begin, end - begin), texts,
               std::span(places).subspan(begin, end - begin));
      begin = end;
    }
    for (std::size_t i = 0; i < chunk.rows.size(); ++i) {
      if (chunk.rows[i].parent != kNoRow) lists_.parents[places[i]] = places[chunk.rows[i].parent];
    }
    end_recording();
  }

  void add(const SegmentTable::RecordingRef& part) {
    const SegmentTable& from = *part.table;
    begin_recording(std::string(from.recording_at(part.recording)));
    const SegmentTable::RowRange rows = from.recording_rows(part.recording);
    const RowId shift = lists_.rows() - rows.begin;  // modulo 2^32
    std::vector<std::uint32_t>& known = known_[part.table];
    known.resize(from.text_count(), SegmentTable::kNone);
    const auto numbered = [&](std::uint32_t text_there) {
      if (known[text_there] == SegmentTable::kNone) known[text_there] = text(from.text_at(text_there));
      return known[text_there];
    };
    // In row order, so that the same recordings give the same table whatever table they come from.
    const std::span<const SegmentTable::TierRows> there = from.tiers_of(part.recording);
    std::vector<SegmentTable::TierRows> tiers(there.begin(), there.end());
    std::ranges::sort(tiers, {}, &SegmentTable::TierRows::begin);
    for (const SegmentTable::TierRows& tier : tiers) {
      SegmentTable::TierRows moved = tier;
      moved.tier = tiers_.of(from.tier_at(tier.tier));
      moved.signer = numbered(tier.signer);
      for (RowId* each : {&moved.begin, &moved.own_end, &moved.extra_end, &moved.unit_end}) *each += shift;
      lists_.places.push_back(moved);
    }
    for (RowId row = rows.begin; row < rows.end; ++row) {
      const std::uint32_t number = numbered(from.text(row));
      lists_.labels_of_texts[number] = numbered(from.label(row));
      lists_.spans.push_back(from.span(row));
      lists_.texts_of_rows.push_back(number);
      lists_.parents.push_back(from.parent(row) == kNoRow ? kNoRow : from.parent(row) + shift);
      SegmentRow flags = from.row(row);
      lists_.flags.push_back(TableBytes::flags_of(flags));
    }
    lists_.places_of_rows.resize(lists_.spans.size());
    end_recording();
  }

  SegmentTable finish() {
    const auto owned = std::make_shared<const Bytes>(TableBytes::write(lists_));
    return TableBytes::open(*owned, owned, "segments");
  }

 private:
  std::uint32_t text(std::string_view label) {
    const std::uint32_t number = texts_.of(label);
    // A text is its own match form until a row sets another; a text in match form stays its own.
    while (lists_.labels_of_texts.size() <= number) {
      lists_.labels_of_texts.push_back(static_cast<std::uint32_t>(lists_.labels_of_texts.size()));
    }
    return number;
  }

  void begin_recording(const std::string& name) {
    if (!lists_.recordings.empty() && lists_.recordings.back() == name) {
      throw Error(ErrorCode::already_exists, fmt::format("recording '{}' occurs twice; rename one", printable(name)));
    }
    lists_.recordings.push_back(name);
  }

  void end_recording() {
    if (lists_.spans.size() >= kNoRow) {
      throw Error(ErrorCode::unsupported,
                  fmt::format("{} annotations are more than one database can hold; split it", lists_.spans.size()));
    }
    const auto first = lists_.places.begin() + lists_.recording_tiers.back();
    std::sort(first, lists_.places.end(), [](const auto& a, const auto& b) { return a.tier < b.tier; });
    for (auto at = first; at != lists_.places.end(); ++at) {
      at->recording = static_cast<std::uint32_t>(lists_.recordings.size()) - 1;
      for (RowId row = at->begin; row < at->unit_end; ++row) {
        lists_.places_of_rows[row] = static_cast<std::uint32_t>(at - lists_.places.begin());
      }
    }
    lists_.recording_tiers.push_back(static_cast<std::uint32_t>(lists_.places.size()));
    lists_.recording_begins.push_back(lists_.rows());
  }

  void add_row(const SegmentRow& row, std::uint32_t text) {
    lists_.spans.push_back(row.span);
    lists_.texts_of_rows.push_back(text);
    lists_.parents.push_back(kNoRow);
    lists_.flags.push_back(TableBytes::flags_of(row));
    lists_.places_of_rows.push_back(0);
  }

  void add_tier(const SegmentTable::Source& source, const std::string& id, std::span<const SegmentRow> rows,
                std::span<const std::uint32_t> texts, std::span<RowId> places) {
    SegmentTable::TierRows tier{.tier = tiers_.of(id), .begin = lists_.rows(), .order = 1};
    tier.own_end = tier.begin;
    tier.signer = text(signer_of(source, id));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      places[i] = lists_.rows();
      add_row(rows[i], texts[rows[i].text]);
      if (!rows[i].extra) tier.own_end = lists_.rows();
      const bool follows = i > 0 && rows[i].extra == rows[i - 1].extra;
      if (rows[i].span.end < rows[i].span.begin || (follows && rows[i].span.begin < rows[i - 1].span.end))
        tier.order = 0;
    }
    tier.extra_end = lists_.rows();
    add_units(rows);
    tier.unit_end = lists_.rows();
    lists_.places.push_back(tier);
  }

  static std::string_view signer_of(const SegmentTable::Source& source, const std::string& tier) {
    if (source.tiers != nullptr) {
      for (const TierNames::SignTier& one : source.tiers->sign_tiers) {
        if (one.id == tier && !one.signer.empty()) return one.signer;
      }
    }
    return source.signer;
  }

  /// Adds units: runs of signs in which each begins less than a rest after the end of those before it.
  void add_units(std::span<const SegmentRow> rows) {
    std::optional<SegmentRow> unit;
    const auto finish = [&] {
      if (unit) add_row(*unit, text(""));
    };
    for (const SegmentRow& row : rows) {
      if (row.kind != RowKind::sign || row.span.end < row.span.begin) continue;
      if (unit && row.span.begin - unit->span.end < kRest) {
        unit->span.end = std::max(unit->span.end, row.span.end);
        continue;
      }
      finish();
      unit = SegmentRow{.kind = RowKind::unit, .hand = row.hand, .extra = true, .span = row.span};
    }
    finish();
  }

  TableLists lists_;
  Numbers texts_;
  Numbers tiers_;
  std::unordered_map<const SegmentTable*, std::vector<std::uint32_t>> known_;  ///< [text there] its number here
};

}  // namespace

SegmentTable::SegmentTable(std::span<const Source> sources) {
  std::vector<const Source*> ordered;
  for (const Source& source : sources) ordered.push_back(&source);
  std::ranges::stable_sort(ordered, {}, &Source::recording);
  TableBuilder builder;
  for (const Source* source : ordered) builder.add(*source);
  *this = builder.finish();
}

SegmentTable SegmentTable::merged(std::span<const RecordingRef> parts) {
  std::vector<RecordingRef> ordered(parts.begin(), parts.end());
  std::ranges::stable_sort(ordered, {},
                           [](const RecordingRef& part) { return part.table->recording_at(part.recording); });
  TableBuilder builder;
  for (const RecordingRef& part : ordered) builder.add(part);
  return builder.finish();
}

SegmentTable SegmentTable::open(ByteSpan bytes, std::shared_ptr<const void> owner, const std::string& where) {
  return TableBytes::open(bytes, std::move(owner), where);
}

SegmentRow SegmentTable::row(RowId id) const noexcept {
  return {.kind = kind(id),
          .phase = phase(id),
          .hand = hand(id),
          .inferred = inferred(id),
          .extra = extra(id),
          .recording = recording(id),
          .tier = tier(id),
          .label = label(id),
          .text = text(id),
          .span = span(id),
          .parent = parent(id)};
}

std::uint32_t SegmentTable::find_text(std::string_view match_form) const noexcept {
  if (text_slots_.empty()) return kNone;
  const std::size_t mask = text_slots_.size() - 1;
  for (std::size_t at = checksum(bytes_of(match_form)) & mask, tried = 0; tried <= mask; ++tried) {
    if (text_slots_[at] == kNone) return kNone;
    if (text_at(text_slots_[at]) == match_form) return text_slots_[at];
    at = (at + 1) & mask;
  }
  return kNone;
}

std::uint32_t SegmentTable::find_tier(std::string_view id) const noexcept {
  for (std::uint32_t tier = 0; tier < tier_count(); ++tier) {
    if (tier_at(tier) == id) return tier;
  }
  return kNone;
}

std::uint32_t SegmentTable::find_recording(std::string_view name) const noexcept {
  std::uint32_t first = 0;
  for (std::uint32_t count = recording_count(); count > 0;) {
    const std::uint32_t half = count / 2;
    if (recording_at(first + half) < name) {
      first += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  return first < recording_count() && recording_at(first) == name ? first : kNone;
}

std::span<const RowId> SegmentTable::with_label(RowKind kind, std::uint32_t label) const noexcept {
  if (label >= text_count() || kind == RowKind::unit) return {};
  const std::span<const RowId> all =
      by_label_.subspan(rows_of_labels_[label], rows_of_labels_[label + 1] - rows_of_labels_[label]);
  // Most labels have rows of one kind only.
  if (!all.empty() && this->kind(all.front()) == kind && this->kind(all.back()) == kind) return all;
  const auto begin = std::ranges::lower_bound(all, kind, {}, [this](RowId row) { return this->kind(row); });
  const auto end = std::ranges::upper_bound(all, kind, {}, [this](RowId row) { return this->kind(row); });
  return {begin, end};
}

std::span<const std::uint32_t> SegmentTable::labels_of(RowKind kind) const noexcept {
  return kind == RowKind::unit ? std::span<const std::uint32_t>() : labels_of_kinds_[static_cast<std::size_t>(kind)];
}

std::span<const RowId> SegmentTable::phases(PhaseKind kind) const noexcept {
  return by_phase_[static_cast<std::size_t>(kind)];
}

std::span<const RowId> SegmentTable::units() const noexcept {
  return units_;
}

const SegmentTable::TierRows* SegmentTable::tier_rows(std::uint32_t recording, std::uint32_t tier) const noexcept {
  if (recording >= recording_count()) return nullptr;
  const std::span<const TierRows> tiers = tiers_of(recording);
  const auto at = std::ranges::lower_bound(tiers, tier, {}, &TierRows::tier);
  return at == tiers.end() || at->tier != tier ? nullptr : &*at;
}

std::vector<std::string> SegmentTable::glosses() const {
  std::vector<std::string> result;
  for (const std::uint32_t label : labels_of(RowKind::sign)) result.emplace_back(text_at(label));
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace signweave
