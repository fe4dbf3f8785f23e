#include "program/heap_count.hpp"

#include <malloc.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace {

thread_local bool watching = false;
thread_local std::uint64_t allocations = 0;

}  // namespace

namespace tactus {

HeapWatch::HeapWatch() : before_(watching) {
  watching = true;
}
HeapWatch::~HeapWatch() {
  watching = before_;
}
std::uint64_t heap_allocations() {
  return allocations;
}

}  // namespace tactus

#ifndef TACTUS_SANITIZED

namespace {

void count() {
  if (watching) ++allocations;
}

}  // namespace

// The C library's own allocator, by the names glibc exports it under.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t items, std::size_t size) {
  count();
  return __libc_calloc(items, size);
}
void* realloc(void* memory, std::size_t size) {
  count();
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  count();
  *memory = __libc_memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
}

#endif
