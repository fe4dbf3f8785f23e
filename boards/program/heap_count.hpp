// Counts the calls to the heap that any library of this program makes while counting is on, by
// standing in front of the C library's allocator. Absent (always zero) in sanitized builds, which
// have an allocator of their own.
#pragma once

#include <cstdint>

namespace tactus {

/// Counts between construction and destruction, in this thread.
class HeapWatch {
 public:
  HeapWatch();
  ~HeapWatch();
  HeapWatch(const HeapWatch&) = delete;
  HeapWatch& operator=(const HeapWatch&) = delete;
};

/// Allocations counted so far in this thread.
std::uint64_t heap_allocations();

}  // namespace tactus
