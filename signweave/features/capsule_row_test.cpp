#include "signweave/features/capsule_row.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace signweave {
namespace {

using Eigen::Vector3f;

Vector3f point() {
  const auto number = [] { return static_cast<float>(*rc::gen::inRange(-40, 40)) / 100; };
  const float x = number(), y = number(), z = number();
  return {x, y, z};
}

/// Some are spheres, and some are parallel to the previous one.
Capsule capsule(const Capsule& before) {
  const int kind = *rc::gen::inRange(0, 5);
  const Vector3f from = point();
  const Vector3f to = kind == 0 ? from : kind == 1 ? Vector3f(from + (before.to - before.from)) : point();
  return {from, to, 0.01f * static_cast<float>(*rc::gen::inRange(0, 10))};
}

RC_GTEST_PROP(CapsuleRow, HasTheClearancesOfItsCapsules, ()) {
  CapsuleRow row;
  Capsule last;
  const auto count = static_cast<std::size_t>(*rc::gen::inRange(1, 17));
  for (std::size_t i = 0; i < count; ++i) row.add(last = capsule(last));
  const Capsule one = capsule(last);
  const std::size_t begin = static_cast<std::size_t>(*rc::gen::inRange(0, 17)) % count;
  CapsuleRow::Numbers out;
  clearances(one, row, begin, out);
  for (std::size_t i = begin; i < count; ++i) {
    RC_ASSERT(std::abs(out[i] - clearance(one, row[i])) < 1e-4f);
  }
  for (std::size_t i = count; i < (count + 7) / 8 * 8; ++i) RC_ASSERT(out[i] > 1e5f);

  const Eigen::Quaternionf turn = Eigen::Quaternionf(1, 0.3f, -0.2f, 0.5f).normalized();
  const Vector3f shift = point();
  const CapsuleRow elsewhere = moved(row, turn.toRotationMatrix(), shift);
  for (std::size_t i = 0; i < count; ++i) {
    RC_ASSERT((elsewhere[i].to - (turn * row[i].to + shift)).norm() < 1e-5f);
    RC_ASSERT(elsewhere[i].radius == row[i].radius);
  }
}

}  // namespace
}  // namespace signweave
