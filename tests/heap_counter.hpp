// Counts what a program and its libraries ask of the heap, by standing in front of the C library's
// allocator; operator new ends there too. Included by one file of a program only: these are the
// definitions. One thread.
#pragma once

#include <cstddef>

namespace tactus {

inline long g_heap_allocations = 0;

/// Allocations since the program began, of whoever made them.
inline long heap_allocations() {
  return g_heap_allocations;
}

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kHeapIsCounted = false;  // the sanitizer brings an allocator of its own
#else
inline constexpr bool kHeapIsCounted = true;
#endif

}  // namespace tactus

#ifndef __SANITIZE_ADDRESS__
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++tactus::g_heap_allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++tactus::g_heap_allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) noexcept {
  ++tactus::g_heap_allocations;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++tactus::g_heap_allocations;
  return __libc_memalign(alignment, size);
}
}
#endif
