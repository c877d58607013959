#include "signweave/semantic_db/segment_chunk.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::uint32_t kNoTier = std::numeric_limits<std::uint32_t>::max();

/// About 31,000 years: far enough from the limits of int64 that sums of times cannot overflow.
constexpr std::int64_t kLatest = 1'000'000'000'000'000;

bool is_time(Milliseconds time) noexcept {
  return -kLatest <= time.count() && time.count() <= kLatest;
}

/// Gives each text a number, in order of first appearance.
class Strings {
 public:
  std::uint32_t number(const std::string& text) {
    const auto [at, added] = index_.try_emplace(text, static_cast<std::uint32_t>(list_.size()));
    if (added) list_.push_back(text);
    return at->second;
  }
  std::vector<std::string> take() { return std::move(list_); }

 private:
  std::vector<std::string> list_;
  std::unordered_map<std::string, std::uint32_t> index_;
};

/// Builds the chunk of one document. Rows are built in document order, then sorted.
class ChunkBuilder {
 public:
  ChunkBuilder(const AnnotationDocument& document, std::span<const Sign> signs) {
    add_annotations(document);
    link_parents(document);
    // All signs before the first phase: no annotation of a sign tier may be used as a phase.
    std::vector<RowId> sign_rows;
    for (const Sign& sign : signs) sign_rows.push_back(add_sign(sign));
    for (std::size_t i = 0; i < signs.size(); ++i) {
      for (const Phase& phase : signs[i].phases) add_phase(signs[i], sign_rows[i], phase);
    }
  }

  SegmentChunk finish() {
    std::vector<std::uint32_t> order(rows_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto key = [this](std::uint32_t i) {
      return std::tuple(rows_[i].tier, rows_[i].extra, rows_[i].span.begin, rows_[i].span.end, i);
    };
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    std::vector<RowId> place(rows_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    SegmentChunk chunk{.tiers = tiers_.take(), .labels = labels_.take(), .rows = {}};
    chunk.rows.reserve(rows_.size());
    for (const std::uint32_t from : order) {
      SegmentRow row = rows_[from];
      if (row.parent != kNoRow) row.parent = place[row.parent];
      chunk.rows.push_back(row);
    }
    return chunk;
  }

 private:
  struct SpanKey {
    std::int64_t begin;
    std::int64_t end;
    std::uint32_t text;
    auto operator<=>(const SpanKey&) const = default;
  };

  SegmentRow labelled(SegmentRow row, const std::string& label) {
    row.text = labels_.number(label);
    row.label = labels_.number(match_form(label));
    return row;
  }

  void add_annotations(const AnnotationDocument& document) {
    for (const Tier& tier : document.tiers) {
      const std::uint32_t number = tiers_.number(tier.id);
      for (const Annotation& annotation : tier.annotations) {
        if (!is_time(annotation.span.begin) || !is_time(annotation.span.end)) {
          throw Error(ErrorCode::bad_input,
                      fmt::format("tier '{}': annotation '{}' is {} years from the start; correct its time",
                                  printable(tier.id), printable(annotation.id), kLatest / 31'557'600'000));
        }
        const auto row = static_cast<RowId>(rows_.size());
        rows_.push_back(labelled({.tier = number, .span = annotation.span}, annotation.label));
        if (!annotation.id.empty()) {
          by_id_.try_emplace(std::pair(number, annotation.id), row);
          rows_of_id_[annotation.id].push_back(row);
        }
        rows_of_span_[span_key(annotation.span, rows_.back().text)].push_back(row);
      }
    }
  }

  void link_parents(const AnnotationDocument& document) {
    RowId row = 0;
    for (const Tier& tier : document.tiers) {
      const std::uint32_t parent_tier = tier.parent.empty() ? kNoTier : tiers_.number(tier.parent);
      for (const Annotation& annotation : tier.annotations) {
        const auto parent = by_id_.find(std::pair(parent_tier, annotation.parent));
        if (parent != by_id_.end() && parent->second != row) rows_[row].parent = parent->second;
        ++row;
      }
    }
  }

  RowId add_sign(const Sign& sign) {
    const RowId row = row_of(sign);
    rows_[row].kind = RowKind::sign;
    rows_[row].hand = sign.hand;
    rows_[row].inferred = sign.inferred;
    return row;
  }

  void add_phase(const Sign& sign, RowId sign_row, const Phase& phase) {
    SegmentRow found{.kind = RowKind::phase, .phase = phase.kind, .hand = sign.hand, .parent = sign_row};
    const std::optional<RowId> row = sign.inferred ? std::nullopt : row_of(sign, phase);
    if (row && rows_[*row].kind == RowKind::annotation) {
      found.tier = rows_[*row].tier;
      found.label = rows_[*row].label;
      found.text = rows_[*row].text;
      found.span = rows_[*row].span;
      rows_[*row] = found;
      return;
    }
    found.inferred = sign.inferred;
    found.extra = true;
    found.tier = row ? rows_[*row].tier : rows_[sign_row].tier;
    found.span = row ? rows_[*row].span : phase.span;
    rows_.push_back(labelled(found, phase.label));
  }

  RowId row_of(const Sign& sign) {
    const std::uint32_t tier = tiers_.number(sign.tier);
    if (!sign.annotation.empty()) {
      const auto at = by_id_.find(std::pair(tier, sign.annotation));
      if (at != by_id_.end()) return at->second;
    } else {
      for (const RowId row : rows_of_span_[span_key(sign.span, labels_.number(sign.gloss))]) {
        if (rows_[row].tier == tier && rows_[row].kind == RowKind::annotation) return row;
      }
    }
    throw Error(ErrorCode::bad_input,
                fmt::format("sign '{}': tier '{}' has no annotation '{}'; take signs and document from one source",
                            printable(sign.gloss), printable(sign.tier), printable(sign.annotation)));
  }

  /// The first row of that annotation that is not yet a phase; otherwise the first that is.
  std::optional<RowId> row_of(const Sign& sign, const Phase& phase) {
    const std::vector<RowId>& rows = phase.annotation.empty()
                                         ? rows_of_span_[span_key(phase.span, labels_.number(phase.label))]
                                         : rows_of_id_[phase.annotation];
    std::optional<RowId> taken;
    for (const RowId row : rows) {
      if (rows_[row].kind == RowKind::annotation) return row;
      if (rows_[row].kind == RowKind::phase && !taken) taken = row;
    }
    if (!taken) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("sign '{}': the document has no annotation '{}' for its phase '{}'; take signs and "
                              "document from one source",
                              printable(sign.gloss), printable(phase.annotation), printable(phase.label)));
    }
    return taken;
  }

  static SpanKey span_key(TimeSpan span, std::uint32_t text) noexcept {
    return {span.begin.count(), span.end.count(), text};
  }

  Strings tiers_;
  Strings labels_;
  std::vector<SegmentRow> rows_;
  std::map<std::pair<std::uint32_t, std::string>, RowId> by_id_;
  std::unordered_map<std::string, std::vector<RowId>> rows_of_id_;
  std::map<SpanKey, std::vector<RowId>> rows_of_span_;
};

// A chunk as bytes (all numbers little-endian; a text is a u32 length and its bytes):
//
//   u8 version = 1
//   u32 count, that many texts    the tiers
//   u32 count, that many texts    the labels
//   u32 count, that many rows     36 bytes each:
//     u8 kind | u8 phase | u8 hand | u8 flags (1 inferred, 2 extra) | u32 tier | u32 label | u32 text
//     i64 begin | i64 end (milliseconds) | u32 parent (a row of this list, 0xFFFFFFFF for none)
constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kRowBytes = 36;
constexpr std::uint8_t kInferred = 1;
constexpr std::uint8_t kExtra = 2;

void encode(const SegmentRow& row, ByteWriter& out) {
  out.number(row.kind);
  out.number(row.phase);
  out.number(row.hand);
  out.number(static_cast<std::uint8_t>((row.inferred ? kInferred : 0) | (row.extra ? kExtra : 0)));
  out.number(row.tier);
  out.number(row.label);
  out.number(row.text);
  out.number(static_cast<std::int64_t>(row.span.begin.count()));
  out.number(static_cast<std::int64_t>(row.span.end.count()));
  out.number(row.parent);
}

SegmentRow decode_row(ByteReader& in) {
  const auto kind = in.number<std::uint8_t>();
  const auto phase = in.number<std::uint8_t>();
  const auto hand = in.number<std::uint8_t>();
  const auto flags = in.number<std::uint8_t>();
  if (kind > static_cast<std::uint8_t>(RowKind::phase)) in.fail("a kind of row that does not exist");
  if (phase > static_cast<std::uint8_t>(PhaseKind::other)) in.fail("a phase that does not exist");
  if (hand > static_cast<std::uint8_t>(Hand::left)) in.fail("a hand that does not exist");
  if (flags > (kInferred | kExtra)) in.fail("a flag that does not exist");
  SegmentRow row{.kind = static_cast<RowKind>(kind),
                 .phase = static_cast<PhaseKind>(phase),
                 .hand = static_cast<Hand>(hand),
                 .inferred = (flags & kInferred) != 0,
                 .extra = (flags & kExtra) != 0};
  row.tier = in.number<std::uint32_t>();
  row.label = in.number<std::uint32_t>();
  row.text = in.number<std::uint32_t>();
  row.span.begin = Milliseconds(in.number<std::int64_t>());
  row.span.end = Milliseconds(in.number<std::int64_t>());
  row.parent = in.number<std::uint32_t>();
  return row;
}

auto order_of(const SegmentRow& row) noexcept {
  return std::tuple(row.tier, row.extra, row.span.begin, row.span.end);
}

/// Checks the invariants that all other functions here rely on.
void check(const SegmentChunk& chunk, const ByteReader& in) {
  for (std::size_t i = 0; i < chunk.rows.size(); ++i) {
    const SegmentRow& row = chunk.rows[i];
    if (row.tier >= chunk.tiers.size()) in.fail("a row without tier");
    if (row.label >= chunk.labels.size() || row.text >= chunk.labels.size()) in.fail("a row without label");
    if (!is_time(row.span.begin) || !is_time(row.span.end)) in.fail("an invalid time");
    if (row.parent != kNoRow && (row.parent >= chunk.rows.size() || row.parent == i)) in.fail("an invalid parent");
    if (row.kind == RowKind::phase && (row.parent == kNoRow || chunk.rows[row.parent].kind != RowKind::sign)) {
      in.fail("a phase without sign");
    }
    if (i > 0 && order_of(row) < order_of(chunk.rows[i - 1])) in.fail("rows out of order");
  }
}

}  // namespace

SegmentChunk segments_of(const AnnotationDocument& document, std::span<const Sign> signs) {
  return ChunkBuilder(document, signs).finish();
}

void encode(const SegmentChunk& chunk, ByteWriter& out) {
  out.number(kVersion);
  out.number(static_cast<std::uint32_t>(chunk.tiers.size()));
  for (const std::string& tier : chunk.tiers) out.text(tier);
  out.number(static_cast<std::uint32_t>(chunk.labels.size()));
  for (const std::string& label : chunk.labels) out.text(label);
  out.number(static_cast<std::uint32_t>(chunk.rows.size()));
  for (const SegmentRow& row : chunk.rows) encode(row, out);
}

SegmentChunk decode_segments(ByteReader& in) {
  if (const auto version = in.number<std::uint8_t>(); version > kVersion) {
    throw Error(ErrorCode::unsupported,
                fmt::format("segments of version {}: this program reads up to {}; use a newer one", version, kVersion));
  } else if (version == 0) {
    in.fail("segments of version 0");
  }
  SegmentChunk chunk;
  chunk.tiers.resize(in.count(sizeof(std::uint32_t)));
  for (std::string& tier : chunk.tiers) tier = in.text();
  chunk.labels.resize(in.count(sizeof(std::uint32_t)));
  for (std::string& label : chunk.labels) label = in.text();
  chunk.rows.resize(in.count(kRowBytes));
  for (SegmentRow& row : chunk.rows) row = decode_row(in);
  check(chunk, in);
  return chunk;
}

}  // namespace signweave
