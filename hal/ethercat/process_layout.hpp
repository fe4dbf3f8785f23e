// ProcessLayout: the objects in the process data of one direction of a drive, bit for bit, as its
// mapping says.
#pragma once

#include <array>

#include "hal/cia402/protocol.hpp"

namespace tactus::ethercat {

class ProcessLayout {
 public:
  static constexpr int kMostEntries = 48;
  static constexpr std::size_t kMostBytes = 128;

  void clear() { *this = {}; }
  /// Appends an entry of a mapping; index 0 is padding. False: there is no room. [init]
  bool add(std::uint32_t entry) {
    if (count_ == kMostEntries || bits_ + (entry & 0xFFU) > 8 * kMostBytes) return false;
    entries_[static_cast<std::size_t>(count_++)] = entry;
    bits_ += entry & 0xFFU;
    return true;
  }
  std::size_t bytes() const { return (bits_ + 7) / 8; }
  int count() const { return count_; }
  std::uint32_t entry(int i) const { return entries_[static_cast<std::size_t>(i)]; }
  /// The byte at which an object begins; -1: it is not mapped, has another size, or does not begin
  /// with a byte. [init]
  int find(const cia402::Object& object) const {
    std::size_t at = 0;
    for (int i = 0; i < count_; ++i) {
      if (entry(i) == object.mapping()) return at % 8 == 0 ? static_cast<int>(at / 8) : -1;
      at += entry(i) & 0xFFU;
    }
    return -1;
  }

 private:
  std::array<std::uint32_t, kMostEntries> entries_{};
  int count_ = 0;
  std::size_t bits_ = 0;
};

}  // namespace tactus::ethercat
