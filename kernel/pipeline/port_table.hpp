// PortTable: every output loaded up to now, by its name in a pipeline file, "block.port".
#pragma once

#include <array>
#include <string_view>

#include "kernel/core/load_error.hpp"
#include "kernel/core/quantity.hpp"

namespace tactus {

inline constexpr int kMaxPorts = 96;

struct PortEntry {
  Name block;
  const char* port = "";
  Quantity quantity = Quantity::kJointPosition;
  const void* value = nullptr;  ///< a ValueOf<quantity>
  bool offered = true;          ///< false: the robot has none; no block may read it
};

class PortTable {
 public:
  /// False if the table is full. [init]
  bool add(const PortEntry& entry) {
    if (count_ == kMaxPorts) return false;
    entries_[static_cast<std::size_t>(count_++)] = entry;
    return true;
  }
  /// Marks the output that holds `value` as not offered by the robot. [init]
  void withhold(const void* value) {
    for (PortEntry& entry : entries_)
      if (entry.value == value) entry.offered = false;
  }
  /// Returns the output called "block.port", or null. [init]
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
