// Counts the calls to the heap that any library of this program makes while counting is on, by
// standing in front of the C library's allocator. Absent (always zero) in sanitized builds, which
// have an allocator of their own.
#pragma once

#include <cstdint>

namespace tactus {

/// False where nothing is counted.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHeapIsCounted = false;
#else
inline constexpr bool kHeapIsCounted = true;
#endif

/// Counts between construction and destruction, in this thread; one may stand within another.
class HeapWatch {
 public:
  HeapWatch();
  ~HeapWatch();
  HeapWatch(const HeapWatch&) = delete;
  HeapWatch& operator=(const HeapWatch&) = delete;

 private:
  bool before_;
};

/// Allocations counted so far in this thread.
std::uint64_t heap_allocations();

}  // namespace tactus
