#include <algorithm>
#include <bit>

#include "signweave/query/movement_check.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// Checks of whole columns of measures at once.
namespace signweave {

#if defined(__SSE2__)
namespace {

/// Tests which of four values are not below `low` and not above `high`; an infinite bound is not tested.
template <bool kLow, bool kHigh>
struct Within {
  __m128 low, high;
  Within(float low_bound, float high_bound) noexcept : low(_mm_set1_ps(low_bound)), high(_mm_set1_ps(high_bound)) {}
  __m128 operator()(__m128 four) const noexcept {
    if constexpr (!kLow) return _mm_cmple_ps(four, high);
    if constexpr (!kHigh) return _mm_cmple_ps(low, four);
    return _mm_and_ps(_mm_cmple_ps(low, four), _mm_cmple_ps(four, high));
  }
};

/// Tests which of four values lie outside; NaN does not.
struct Outside {
  __m128 low, high;
  Outside(float low_bound, float high_bound) noexcept : low(_mm_set1_ps(low_bound)), high(_mm_set1_ps(high_bound)) {}
  __m128 operator()(__m128 four) const noexcept { return _mm_or_ps(_mm_cmplt_ps(four, low), _mm_cmpgt_ps(four, high)); }
};

/// Tests which of four sets have a bit of the mask; NaN is not a set: as an integer it has only the highest bit, which
/// the mask excludes.
struct HasBit {
  __m128i mask;
  explicit HasBit(std::uint32_t bits) noexcept : mask(_mm_set1_epi32(static_cast<int>(bits & 0x7FFFFFFFU))) {}
  __m128 operator()(__m128 four) const noexcept {
    const __m128i sets = _mm_cvttps_epi32(four);
    const __m128i none = _mm_cmpeq_epi32(_mm_and_si128(sets, mask), _mm_setzero_si128());
    return _mm_castsi128_ps(_mm_xor_si128(none, _mm_set1_epi32(-1)));
  }
};

/// Appends `first` + the indexes of the values that fit, up to the last multiple of 64; returns the number of values
/// tested.
template <typename Fits>
std::size_t append_blocks(std::span<const float> column, const Fits& fits, RowId first, std::vector<RowId>& rows) {
  constexpr std::size_t kBlock = 64;
  std::size_t i = 0;
  for (; i + kBlock <= column.size(); i += kBlock) {
    // In most blocks nothing fits: a single branch detects that first.
    const float* values = column.data() + i;
    __m128 any[4];
    for (std::size_t k = 0; k < 4; ++k) any[k] = fits(_mm_loadu_ps(values + 4 * k));
    for (std::size_t k = 4; k < kBlock / 4; ++k) any[k % 4] = _mm_or_ps(any[k % 4], fits(_mm_loadu_ps(values + 4 * k)));
    if (_mm_movemask_ps(_mm_or_ps(_mm_or_ps(any[0], any[1]), _mm_or_ps(any[2], any[3]))) == 0) continue;
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < kBlock / 4; ++k) {
      const auto four = static_cast<unsigned>(_mm_movemask_ps(fits(_mm_loadu_ps(values + 4 * k))));
      bits |= std::uint64_t{four} << 4 * k;
    }
    std::size_t end = rows.size();
    rows.resize(end + static_cast<std::size_t>(std::popcount(bits)));
    for (; bits != 0; bits &= bits - 1) {
      rows[end++] = first + static_cast<RowId>(i) + static_cast<RowId>(std::countr_zero(bits));
    }
  }
  return i;
}

}  // namespace
#endif

void MovementCheck::append_fitting(std::span<const float> column, RowId first, std::vector<RowId>& rows) const {
  std::size_t i = 0;
#if defined(__SSE2__)
  const auto append = [&](const auto& fits) { i = append_blocks(column, fits, first, rows); };
  const auto [low, high] = bounds_;
  if (reading_ == Reading::set) {
    append(HasBit(mask_));
  } else if (reading_ == Reading::outside) {
    append(Outside(low, high));
  } else if (reading_ == Reading::within && high == kUnbounded) {
    append(Within<true, false>(low, high));
  } else if (reading_ == Reading::within && low == -kUnbounded) {
    append(Within<false, true>(low, high));
  } else if (reading_ == Reading::within) {
    append(Within<true, true>(low, high));
  }
#endif
  for (; i < column.size(); ++i) {
    if (fits(column[i])) rows.push_back(first + static_cast<RowId>(i));
  }
}

bool is_scannable(const MovementTerm& term) noexcept {
  return !is_series(term.quantity) && term.quantity != Quantity::at && term.point.kind != Point::Kind::part &&
         (!term.other || term.other->kind != Point::Kind::part);
}

bool MovementCheck::scan(std::uint32_t recording, RowId first, std::vector<RowId>& rows) {
  if (!scannable()) return false;
  if (alternatives_.empty()) return true;
  load(recording);
  if (!std::ranges::all_of(alternatives_, [this](const Alternative& alternative) { return is_stored(alternative); }))
    return false;
  const std::size_t before = rows.size();
  std::vector<float> values;
  for (const Alternative& alternative : alternatives_) {
    if (!of_ends()) {
      append_fitting(alternative.column.values, first, rows);
      continue;
    }
    values.resize(alternative.ends.front().values.size());
    for (std::size_t row = 0; row < values.size(); ++row) {
      values[row] = stored_value(alternative, static_cast<RowId>(row));
    }
    append_fitting(values, first, rows);
  }
  if (alternatives_.size() < 2) return true;
  const auto from = rows.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(from, rows.end());
  rows.erase(std::unique(from, rows.end()), rows.end());
  return true;
}

}  // namespace signweave
