// Counts the heap calls that any library of this program makes while counting is on, by replacing
// the C library's allocator functions. The count is always zero in sanitized builds, which have
// their own allocator.
#pragma once

#include <cstdint>

namespace tactus {

/// False in a build that counts nothing.
#ifdef TACTUS_SANITIZED
inline constexpr bool kHeapIsCounted = false;
#else
inline constexpr bool kHeapIsCounted = true;
#endif

/// Counts between construction and destruction, in this thread. Watches may be nested.
class HeapWatch {
 public:
  HeapWatch();
  ~HeapWatch();
  HeapWatch(const HeapWatch&) = delete;
  HeapWatch& operator=(const HeapWatch&) = delete;

 private:
  bool before_;
};

/// Returns the number of allocations counted in this thread.
std::uint64_t heap_allocations();

}  // namespace tactus
