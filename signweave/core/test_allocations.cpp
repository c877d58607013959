#include "signweave/core/test_allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

// Clang's thread sanitizer has its own operator new, which reports every allocation.
#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define SIGNWEAVE_ALLOCATIONS_REPORTED
#include <sanitizer/allocator_interface.h>
#endif
#endif

#if defined(__GNUC__) && !defined(__clang__)
// Allocation and release match here, but at some optimisation levels GCC sees only one of the two.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace {
std::atomic<bool> counting = false;
std::atomic<std::size_t> allocations = 0;
std::atomic<std::size_t> bytes = 0;

void count(std::size_t size) noexcept {
  if (!counting) return;
  ++allocations;
  bytes += size;
}

#ifdef SIGNWEAVE_ALLOCATIONS_REPORTED

void on_allocation(const volatile void*, std::size_t size) {
  count(size);
}
void on_release(const volatile void*) {}
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(on_allocation, on_release);

}  // namespace

#else

void* allocate(std::size_t size) noexcept {
  count(size);
  return std::malloc(size > 0 ? size : 1);
}
void* allocate(std::size_t size, std::align_val_t alignment) noexcept {
  count(size);
  const auto step = static_cast<std::size_t>(alignment);
  return std::aligned_alloc(step, (size + step - 1) / step * step + (size > 0 ? 0 : step));
}
void* checked(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) {
  return checked(allocate(size));
}
void* operator new[](std::size_t size) {
  return checked(allocate(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return checked(allocate(size, alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return checked(allocate(size, alignment));
}
// The library's temporary buffers are allocated this way and freed with the ordinary operator.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocate(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocate(size, alignment);
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
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

#endif

namespace signweave {

Allocated allocated_in(const std::function<void()>& call) {
  allocations = 0;
  bytes = 0;
  counting = true;
  call();
  counting = false;
  return {allocations, bytes};
}

}  // namespace signweave
