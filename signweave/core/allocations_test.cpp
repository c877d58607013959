// Tests the counter with which other modules' tests check that a code path allocates nothing.

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <new>
#include <thread>

#include "signweave/core/test_allocations.h"

namespace signweave {
namespace {

TEST(Allocations, AreCountedWithTheirBytes) {
  std::unique_ptr<int> kept;
  EXPECT_EQ(allocations_in([&] { kept = std::make_unique<int>(1); }), 1u);
  EXPECT_EQ(allocations_in([&] { *kept = 2; }), 0u);
  std::unique_ptr<std::array<char, 1000>> more;
  const Allocated made = allocated_in([&] {
    more = std::make_unique<std::array<char, 1000>>();
    kept = std::make_unique<int>(3);
  });
  EXPECT_EQ(made.times, 2u);
  EXPECT_EQ(made.bytes, 1000u + sizeof(int));
}

TEST(Allocations, NothrowAndAlignedOnesAreCounted) {
  struct alignas(64) Aligned {
    std::array<char, 64> bytes;
  };
  std::unique_ptr<int> quiet;
  EXPECT_EQ(allocations_in([&] { quiet.reset(new (std::nothrow) int(1)); }), 1u);
  std::unique_ptr<Aligned> aligned;
  EXPECT_EQ(allocations_in([&] { aligned = std::make_unique<Aligned>(); }), 1u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(aligned.get()) % 64, 0u);
  std::unique_ptr<Aligned> both;
  EXPECT_EQ(allocations_in([&] { both.reset(new (std::nothrow) Aligned()); }), 1u);
}

TEST(Allocations, OfAnotherThreadAreCounted) {
  std::unique_ptr<int> kept;
  std::atomic<bool> go = false;
  std::atomic<bool> done = false;
  std::thread other([&] {
    go.wait(false);
    kept = std::make_unique<int>(1);
    done = true;
    done.notify_one();
  });
  EXPECT_EQ(allocations_in([&] {
              go = true;
              go.notify_one();
              done.wait(false);
            }),
            1u);
  other.join();
}

}  // namespace
}  // namespace signweave
