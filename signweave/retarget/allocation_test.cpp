// A pose is put onto another body without allocating: streams do it frame by frame.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "signweave/retarget/retarget.h"
#include "signweave/retarget/retargeted_source.h"
#include "signweave/retarget/test_character.h"

namespace {
// Of the whole test program: what is allocated while a test looks.
std::atomic<bool> counting = false;
std::atomic<std::size_t> allocations = 0;

void* counted(std::size_t size) {
  if (counting) ++allocations;
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

TEST(RetargetAllocations, NoneAreMadeForAPose) {
  const Motion motion = moving(whole_person(), 20);
  const Character character = character_of(whole_person(0.9f));
  Retargeter retargeter(motion.skeleton(), model_of(motion), character);
  Pose pose(*character.skeleton);
  allocations = 0;
  counting = true;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    retargeter.pose(motion.pose(frame), pose.view());
  }
  counting = false;
  EXPECT_EQ(allocations, 0U);
}

TEST(RetargetAllocations, NoneAreMadeForFramesOfAnotherSkeleton) {
  const auto motion = std::make_shared<MemorySource>(moving(whole_person(), 100));
  const MemorySource onto(moving(whole_person(0.9f), 100, 2));
  const RetargetedSource shown(
      motion, std::make_shared<const BodyMapping>(map_body(recorded_body("b", *motion), recorded_body("a", onto))));
  Motion out(shown.skeleton(), shown.rate(), 70);
  allocations = 0;
  counting = true;
  shown.read({20, 90}, out.poses({0, 70}));
  counting = false;
  EXPECT_EQ(allocations, 0U);
}

}  // namespace
}  // namespace signweave
