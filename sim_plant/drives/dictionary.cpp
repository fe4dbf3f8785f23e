#include "sim_plant/drives/dictionary.hpp"

namespace tactus::drives {

/// Below `end`, or everywhere if it is 0.
void Dictionary::reset(std::uint8_t node, std::uint16_t end) {
  std::size_t slot = 0;
  for (const Row& row : kRows) {
    const std::size_t count = std::size_t{1} + row.last - row.first;
    const std::int64_t value = row.value + ((row.access & kAddNode) != 0 ? node : 0);
    const bool wanted = end == 0 || row.index < end;
    for (std::size_t i = 0; i < count && wanted; ++i) values_[slot + i] = value;
    slot += count;
  }
}

}  // namespace tactus::drives
