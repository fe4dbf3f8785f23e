// Arena: places objects one behind the other in bytes of fixed size that a board owns. Nothing is
// given back: what is placed stays until the board is switched off.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus {

class Arena {
 public:
  /// Places objects in `size` bytes at `bytes`. [init]
  Arena(std::byte* bytes, std::size_t size) : bytes_(bytes), size_(size) {}

  /// Returns `size` bytes aligned to `alignment`, a power of two, or null if so many are not left.
  /// [init]
  void* take(std::size_t size, std::size_t alignment) {
    const std::size_t unaligned =
        reinterpret_cast<std::uintptr_t>(bytes_ + used_) & (alignment - 1);
    const std::size_t skipped = unaligned > 0 ? alignment - unaligned : 0;
    if (skipped > left() || size > left() - skipped) return nullptr;
    std::byte* const taken = bytes_ + used_ + skipped;
    used_ += skipped + size;
    return taken;
  }

  std::size_t size() const { return size_; }
  std::size_t left() const { return size_ - used_; }

 private:
  std::byte* bytes_;
  std::size_t size_, used_ = 0;
};

}  // namespace tactus
