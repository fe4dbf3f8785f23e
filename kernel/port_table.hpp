// PortTable: every output that has been loaded so far, by the name a pipeline file uses for it,
// "block.port".
#pragma once

#include <array>
#include <string_view>

#include "kernel/load_error.hpp"
#include "kernel/quantity.hpp"

namespace tactus {

inline constexpr int kMaxPorts = 96;

struct PortEntry {
  Name block;
  const char* port = "";
  Quantity quantity = Quantity::kJointPosition;
  const void* value = nullptr;  ///< a ValueOf<quantity>
  bool offered = true;          ///< false: nobody fills it, and nobody may read it
};

class PortTable {
 public:
  /// False if the table is full. [init]
  bool add(const PortEntry& entry) {
    if (count_ == kMaxPorts) return false;
    entries_[static_cast<std::size_t>(count_++)] = entry;
    return true;
  }
  /// Says of the output that holds `value` that the robot does not offer it. [init]
  void withhold(const void* value) {
    for (PortEntry& entry : entries_)
      if (entry.value == value) entry.offered = false;
  }
  /// The output called "block.port", or null. [init]
  const PortEntry* find(std::string_view name) const {
    for (int i = 0; i < count_; ++i) {
      const PortEntry& entry = (*this)[i];
      Text<2 * kMaxNameLength + 1> full = std::string_view(entry.block);
      full << "." << entry.port;
      if (std::string_view(full) == name) return &entry;
    }
    return nullptr;
  }
  int count() const { return count_; }
  const PortEntry& operator[](int index) const { return entries_[static_cast<std::size_t>(index)]; }

 private:
  std::array<PortEntry, kMaxPorts> entries_;
  int count_ = 0;
};

}  // namespace tactus
