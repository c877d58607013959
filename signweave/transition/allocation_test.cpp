// Methods do not allocate once the scratch has grown; its size depends on the body, not on the gap.

#include <gtest/gtest.h>

#include "signweave/core/test_allocations.h"
#include "signweave/transition/test_gap_motion.h"

namespace signweave {
namespace {

using namespace testing_gap;

TEST(Allocation, TheSecondGapAllocatesNothing) {
  const Motion motion = lively(1.5);
  const JointGroups of = groups();
  const auto model = model_with_spans();
  for (const GapMethod& method : gap_methods()) {
    GapScratch scratch;
    std::vector<Eigen::Quaternionf> rotations(100 * kJoints);
    std::vector<Eigen::Vector3f> translations(100);
    const auto make = [&](FrameRange frames, GroupSet set) {
      const Gap gap = cut(motion, of, frames);
      method.fill({.gap = gap, .model = *model, .groups = set, .scratch = scratch}, {rotations, translations});
    };
    make({100, 120}, GroupSet::all());
    EXPECT_EQ(allocations_in([&] { make({90, 189}, GroupSet::all()); }), 0u) << method.name;
    EXPECT_EQ(allocations_in([&] { make({100, 101}, {JointGroup::left_arm}); }), 0u) << method.name;
  }
}

TEST(Allocation, AMinuteAtTwoThousandHertzNeedsNoMoreThanATenthOfASecond) {
  const Motion motion = lively(1.5, {2000, 1}, 2400);
  const JointGroups of = groups();
  const auto model = model_with_spans();
  std::vector<Eigen::Quaternionf> rotations(120'000 * kJoints);
  std::vector<Eigen::Vector3f> translations(120'000);
  for (const GapMethod& method : gap_methods()) {
    const auto needed = [&](std::int64_t frames) {
      GapScratch scratch;
      Gap gap = cut(motion, of, {1200, 1200});
      gap.count = frames;
      return allocated_in([&] {
               method.fill({.gap = gap, .model = *model, .groups = {JointGroup::left_arm}, .scratch = scratch},
                           {rotations, translations});
             })
          .bytes;
    };
    EXPECT_LE(needed(120'000), needed(1'000)) << method.name;
    EXPECT_LT(needed(120'000), 1u << 20) << method.name;
  }
}

}  // namespace
}  // namespace signweave
