// Counts what the whole test program allocates; frame paths must not.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>

#include "signweave/stream/test_allocations.h"

// Clang's thread sanitizer has an operator new of its own, which tells of every allocation.
#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define SIGNWEAVE_TOLD_OF_ALLOCATIONS
#include <sanitizer/allocator_interface.h>
#endif
#endif

#if defined(__GNUC__) && !defined(__clang__)
// What is allocated here is freed here; at some levels of optimisation GCC sees only one of the two.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace {
std::atomic<bool> counting = false;
std::atomic<std::size_t> allocations = 0;

#ifdef SIGNWEAVE_TOLD_OF_ALLOCATIONS

void on_allocation(const volatile void*, std::size_t) {
  if (counting) ++allocations;
}
void on_release(const volatile void*) {}
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(on_allocation, on_release);

}  // namespace

#else

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
// The library's temporary buffers ask in this way, and give back in the ordinary one.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (counting) ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  if (counting) ++allocations;
  return std::malloc(size > 0 ? size : 1);
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

#endif

namespace signweave {

std::size_t allocations_in(const std::function<void()>& call) {
  allocations = 0;
  counting = true;
  call();
  counting = false;
  return allocations;
}

namespace {

TEST(Allocation, IsCounted) {
  std::unique_ptr<int> kept;
  EXPECT_EQ(allocations_in([&] { kept = std::make_unique<int>(1); }), 1u);
  EXPECT_EQ(allocations_in([&] { *kept = 2; }), 0u);
}

}  // namespace
}  // namespace signweave
