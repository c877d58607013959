#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "signweave/kv/sealed.h"
#include "signweave/semantic_db/segment_bytes.h"

// The bytes of a table are validated before use, so that no index in them is out of range.

namespace signweave {
namespace {

/// Checks that all numbers are below `bound`, or kNone with `or_none`. The loop does not exit early, so that the
/// compiler can vectorise it.
struct Below {
  std::uint32_t bound = 0;
  const char* what = "";
  bool or_none = false;

  const char* operator()(std::span<const std::uint32_t> values, std::size_t) const {
    std::uint32_t bad = 0;
    if (or_none) {
      for (const std::uint32_t value : values) bad |= static_cast<std::uint32_t>(value + 1 > bound);
    } else {
      for (const std::uint32_t value : values) bad |= static_cast<std::uint32_t>(value >= bound);
    }
    return bad == 0 ? nullptr : what;
  }
};

/// Checks that the numbers go from 0 to `last` and never decrease. Blocks must be passed in order.
struct Ascending {
  std::uint32_t last = 0;
  const char* what = "";
  std::size_t count = 0;  ///< numbers in all blocks
  std::uint32_t before = 0;

  const char* operator()(std::span<const std::uint32_t> values, std::size_t at) {
    std::uint32_t bad = 0;
    for (std::size_t i = 1; i < values.size(); ++i) bad |= static_cast<std::uint32_t>(values[i - 1] > values[i]);
    bad |= static_cast<std::uint32_t>(values.front() < before || (at == 0 && values.front() != 0) ||
                                      (at + values.size() == count && values.back() != last));
    before = values.back();
    return bad == 0 ? nullptr : what;
  }
};

/// Checks the flags of rows: kinds have two bits, phases are at most 4, hands at most 2, and a phase must have a sign.
struct Flags {
  std::span<const RowId> parents;

  const char* operator()(std::span<const std::uint16_t> values, std::size_t at) const {
    constexpr std::size_t kStep = 4096;
    std::array<std::uint16_t, kStep> alone;  // [row] 1: no parent. As wide as the flags, so both loops are fast
    std::uint16_t bad = 0;
    for (std::size_t first = 0; first < values.size(); first += kStep) {
      const std::size_t count = std::min(kStep, values.size() - first);
      const RowId* const parent = parents.data() + at + first;
      for (std::size_t i = 0; i < count; ++i) alone[i] = static_cast<std::uint16_t>(parent[i] == kNoRow ? 1 : 0);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint16_t flags = values[first + i];
        const int beyond = flags >> 9;
        const int phase_beyond = flags >> 4 & (flags >> 3 | flags >> 2) & 1;  // 5, 6 or 7
        const int hand_beyond = flags >> 6 & flags >> 5 & 1;                  // 3
        const int stray = flags >> 1 & ~flags & alone[i];                     // kind 2, a phase
        bad = static_cast<std::uint16_t>(bad | beyond | phase_beyond | hand_beyond | stray);
      }
    }
    return bad == 0 ? nullptr : "rows of a kind that does not exist";
  }
};

/// No check is needed: any number is valid.
struct Anything {
  template <typename T>
  const char* operator()(std::span<const T>, std::size_t) const {
    return nullptr;
  }
};

}  // namespace

/// Takes one list after another and checks that it can be used in place. Memory is read once: the checksum of each
/// block is computed and, while the block is in the cache, its numbers are checked.
class TableBytes::Reader {
 public:
  Reader(ByteSpan bytes, const std::string& where, RunningChecksum* sum) : in_(bytes, where), sum_(sum) {}

  /// For every block, check(values, index of the first value) returns a description of what is wrong, or null.
  template <typename T, typename Check>
  std::span<const T> list(std::size_t count, Check check) {
    const ByteSpan taken = in_.take((count * sizeof(T) + 7) / 8 * 8);
    const std::span<const T> all(reinterpret_cast<const T*>(taken.data()), count);
    constexpr std::size_t kBlock = std::size_t{64} << 10;
    for (std::size_t at = 0; at < taken.size(); at += kBlock) {
      const ByteSpan block = taken.subspan(at, std::min(kBlock, taken.size() - at));
      if (sum_ != nullptr) sum_->add(block);
      const std::size_t first = at / sizeof(T);
      if (const char* const wrong = check(all.subspan(first, std::min(kBlock / sizeof(T), count - first)), first)) {
        in_.fail(wrong);
      }
    }
    return all;
  }

  std::span<const std::uint32_t> below(std::size_t count, std::uint32_t bound, const char* what) {
    return list<std::uint32_t>(count, Below{.bound = bound, .what = what});
  }
  /// The same, but kNone is allowed.
  std::span<const std::uint32_t> below_or_none(std::size_t count, std::uint32_t bound, const char* what) {
    return list<std::uint32_t>(count, Below{.bound = bound, .what = what, .or_none = true});
  }
  /// From 0 to `last`; `count` + 1 numbers.
  std::span<const std::uint32_t> ascending(std::size_t count, std::uint32_t last, const char* what) {
    return list<std::uint32_t>(count + 1, Ascending{.last = last, .what = what, .count = count + 1});
  }

  SegmentTable::Texts texts(std::uint32_t count, std::uint32_t bytes) {
    SegmentTable::Texts made;
    made.begins = ascending(count, bytes, "texts out of order");
    made.characters = list<char>(bytes, Anything{}).data();
    return made;
  }

  void finish() { in_.finish(); }
  [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }

 private:
  ByteReader in_;
  RunningChecksum* sum_;
};

SegmentTable TableBytes::open(ByteSpan bytes, std::shared_ptr<const void> owner, const std::string& where) {
  return open_adding(bytes, std::move(owner), where, nullptr);
}

SegmentTable TableBytes::open_sealed(ByteSpan record, std::shared_ptr<const void> owner, const std::string& where) {
  try {
    ByteReader in(record, where);
    const auto expected = in.number<std::uint64_t>();
    RunningChecksum sum;
    SegmentTable table = open_adding(in.take(in.left()), std::move(owner), where, &sum);
    if (sum.value() != expected) in.fail("its checksum does not fit");
    return table;
  } catch (const Error&) {
    kv::unsealed(record, where);  // a checksum that does not match is reported first
    throw;
  }
}

SegmentTable TableBytes::open_adding(ByteSpan bytes, std::shared_ptr<const void> owner, const std::string& where,
                                     RunningChecksum* sum) {
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 != 0) {
    auto copy = std::make_shared<const Bytes>(bytes.begin(), bytes.end());
    bytes = *copy;
    owner = std::move(copy);
  }
  Reader in(bytes, where, sum);
  const std::span<const std::uint32_t> head = in.list<std::uint32_t>(kTableHead / sizeof(std::uint32_t), Anything{});
  if (head[0] > kTableVersion) {
    throw Error(ErrorCode::unsupported, fmt::format("{}: of version {}: this program reads up to {}; use a newer one",
                                                    where, head[0], kTableVersion));
  }
  TableCounts counts{};
  std::memcpy(&counts, head.data() + 2, sizeof counts);
  const bool wide = head[1] == 1;
  if (head[0] == 0 || head[1] > 1 || counts.rows == kNoRow) in.fail("an invalid head");
  if (!std::has_single_bit(counts.slots) || counts.slots <= counts.texts) in.fail("an invalid table of texts");

  SegmentTable table;
  table.owner_ = std::move(owner);
  table.bytes_ = bytes;
  table.size_ = counts.rows;
  table.texts_ = in.texts(counts.texts, counts.text_bytes);
  table.tiers_ = in.texts(counts.tiers, counts.tier_bytes);
  table.recordings_ = in.texts(counts.recordings, counts.recording_bytes);
  table.recording_tiers_ = in.ascending(counts.recordings, counts.places, "tiers out of order");
  table.recording_begins_ = in.ascending(counts.recordings, counts.rows, "recordings out of order");
  table.places_ = in.list<SegmentTable::TierRows>(
      counts.places, [&](std::span<const SegmentTable::TierRows> places, std::size_t) -> const char* {
        for (const SegmentTable::TierRows& rows : places) {
          if (rows.recording >= counts.recordings || rows.tier >= counts.tiers || rows.signer >= counts.texts ||
              rows.begin > rows.own_end || rows.own_end > rows.extra_end || rows.extra_end > rows.unit_end ||
              rows.unit_end > counts.rows) {
            return "an invalid tier";
          }
        }
        return nullptr;
      });
  table.labels_of_texts_ = in.below(counts.texts, counts.texts, "labels out of range");
  table.text_slots_ = in.below_or_none(counts.slots, counts.texts, "texts out of range");
  const RowId labelled = counts.rows - std::min(counts.units, counts.rows);
  table.rows_of_labels_ = in.ascending(counts.texts, labelled, "labels out of order");
  table.by_label_ = in.below(labelled, counts.rows, "rows out of range");
  for (std::size_t k = 0; k < kListedKinds; ++k) {
    table.labels_of_kinds_[k] = in.below(counts.labels_of_kinds[k], counts.texts, "labels out of range");
  }
  for (std::size_t k = 0; k < counts.phases.size(); ++k) {
    table.by_phase_[k] = in.below(counts.phases[k], counts.rows, "phases out of range");
  }
  table.units_ = in.below(counts.units, counts.rows, "units out of range");
  if (wide) {
    table.wide_ = in.list<std::int64_t>(2 * std::size_t{counts.rows}, Anything{});
  } else {
    table.begins_ = in.list<std::int32_t>(counts.rows, Anything{});
    table.ends_ = in.list<std::int32_t>(counts.rows, Anything{});
  }
  table.texts_of_rows_ = in.below(counts.rows, counts.texts, "texts out of range");
  table.parents_ = in.below_or_none(counts.rows, counts.rows, "parents out of range");
  table.places_of_rows_ = in.below(counts.rows, counts.places, "tiers out of range");
  table.flags_ = in.list<std::uint16_t>(counts.rows, Flags{table.parents_});
  table.child_begins_ = in.ascending(counts.rows, counts.children, "children out of order");
  table.child_list_ = in.below(counts.children, counts.rows, "children out of range");
  in.finish();
  return table;
}

}  // namespace signweave
