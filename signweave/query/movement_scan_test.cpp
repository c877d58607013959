#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "signweave/query/movement_check.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

/// Values of the hands, the same for every measure of a side.
class TwoColumns : public Movement {
 public:
  std::array<std::vector<float>, 2> values;  ///< [Side]

  ColumnValues column(Column column, std::uint32_t) const override {
    return {values[static_cast<std::size_t>(column.side)], nullptr};
  }
  float shoulder_width(std::uint32_t) const override { return 0.4f; }
  FrameClock clock(std::uint32_t) const override { return {}; }
  std::shared_ptr<const HandTrace> hands(std::uint32_t) const override { return nullptr; }
  std::vector<PointTrack> points(std::uint32_t, std::span<const Part>, FrameRange) const override { return {}; }
};

/// Values around 1, some of which are 1, NaN, or infinite; few or most of them above it.
std::vector<float> some_numbers(std::mt19937& random, std::size_t count) {
  std::vector<float> numbers(count);
  std::normal_distribution<float> around(std::array{-2.0f, 0.9f, 4.0f}[random() % 3], 0.6f);
  for (float& number : numbers) {
    const unsigned kind = random() % 40;
    number = kind == 0   ? kNotKnown
             : kind == 1 ? std::numeric_limits<float>::infinity()
             : kind == 2 ? -std::numeric_limits<float>::infinity()
             : kind < 6  ? std::nextafter(1.0f, static_cast<float>(random() % 3))
                         : around(random);
  }
  return numbers;
}

/// Sets of up to 24 members as numbers, some of which are NaN; few or most of them with many members.
std::vector<float> some_sets(std::mt19937& random, std::size_t count) {
  std::vector<float> sets(count);
  const bool sparse = random() % 2 == 0;
  for (float& set : sets) {
    std::uint32_t bits = random();
    for (int i = 0; sparse && i < 4; ++i) bits &= random();
    set = random() % 40 == 0 ? kNotKnown : static_cast<float>(bits & 0xFFFFFFU);
  }
  return sets;
}

RC_GTEST_PROP(MovementScan, FindsExactlyTheRowsForWhichItHolds, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const std::size_t count = random() % 700;
  TwoColumns numbers;
  for (std::vector<float>& values : numbers.values) values = some_numbers(random, count);
  TwoColumns sets;
  for (std::vector<float>& values : sets.values) values = some_sets(random, count);
  for (const char* hand : {"left_hand", "right_hand", "hand"}) {
    for (const char* what : {"speed({}) < 1 m/s", "speed({}) <= 1 m/s", "speed({}) > 1 m/s", "speed({}) >= 1 m/s",
                             "max({}).x = centre", "max({}).x != centre", "max({}).x != left", "any({}).x = left",
                             "any({}).x != left", "enters({}, chin)", "any({}).palm = up"}) {
      const PhaseQuery query = parse(fmt::format(fmt::runtime(what), hand));
      const Condition& condition = query.elements.front().term.expression.condition;
      const Quantity quantity = condition.movement.quantity;
      const bool of_sets = quantity == Quantity::any || quantity == Quantity::enters;
      const TwoColumns& movement = of_sets ? sets : numbers;
      MovementCheck check(condition, &movement);
      std::vector<RowId> expected = {3};
      for (RowId row = 0; row < count; ++row) {
        if (check.holds({.row = row}, {})) expected.push_back(row + 100);
      }
      std::vector<RowId> found = {3};
      RC_ASSERT(check.scan(0, 100, found) == (count > 0));
      RC_ASSERT(found == expected);
    }
  }
}

}  // namespace
}  // namespace signweave
