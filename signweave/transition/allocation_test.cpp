// Nothing is allocated once the scratch has grown, and it grows with the body and not with the gap.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "signweave/transition/test_way.h"

namespace {
// Of the whole test program: what is allocated while a test looks.
std::atomic<bool> counting = false;
std::atomic<std::size_t> allocations = 0;
std::atomic<std::size_t> bytes = 0;

void* counted(std::size_t size) {
  if (counting) {
    ++allocations;
    bytes += size;
  }
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace signweave {
namespace {

using namespace testing_way;

struct Counted {
  std::size_t allocations;
  std::size_t bytes;
};
template <class Call>
Counted count(Call call) {
  allocations = 0;
  bytes = 0;
  counting = true;
  call();
  counting = false;
  return {allocations, bytes};
}

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
    EXPECT_EQ(count([&] { make({90, 189}, GroupSet::all()); }).allocations, 0u) << method.name;
    EXPECT_EQ(count([&] { make({100, 101}, {JointGroup::left_arm}); }).allocations, 0u) << method.name;
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
      return count([&] {
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
