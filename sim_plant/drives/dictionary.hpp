// Dictionary: the values of one drive's objects, a plain array with a place for every sub-index of
// dictionary_rows.hpp. It knows types and ranges; who may write when is object_access.hpp's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim_plant/drives/dictionary_rows.hpp"

namespace tactus::drives {

constexpr std::size_t size_of(Type type) {
  switch (type) {
    case Type::kU8:
    case Type::kI8: return 1;
    case Type::kU16:
    case Type::kI16: return 2;
    case Type::kU32:
    case Type::kI32: return 4;
    case Type::kText: break;
  }
  return 0;
}
constexpr bool is_signed(Type type) {
  return type == Type::kI8 || type == Type::kI16 || type == Type::kI32;
}
constexpr std::int64_t lowest(const Row& row) {
  if (row.low <= row.high) return row.low;
  return is_signed(row.type) ? -(std::int64_t{1} << (8 * size_of(row.type) - 1)) : row.low;
}
constexpr std::int64_t highest(const Row& row) {
  if (row.low <= row.high) return row.high;
  return (std::int64_t{1} << (8 * size_of(row.type) - (is_signed(row.type) ? 1 : 0))) - 1;
}

using Slot = std::uint16_t;  ///< where a value is
inline constexpr Slot kNoSlot = 0xFFFF;

/// A row and the place of one of its sub-indices.
struct Found {
  const Row* row = nullptr;  ///< null: the dictionary does not have it
  Slot slot = kNoSlot;
  bool has_index = false;  ///< the index exists, the sub-index need not
};

/// Finds a sub-index. [any]
constexpr Found find(std::uint16_t index, std::uint8_t sub) {
  Found found;
  std::size_t slot = 0;
  for (const Row& row : kRows) {
    if (row.index == index) {
      found.has_index = true;
      if (sub >= row.first && sub <= row.last) {
        found.row = &row;
        found.slot = static_cast<Slot>(slot + sub - row.first);
        return found;
      }
    }
    slot += std::size_t{1} + row.last - row.first;
  }
  return found;
}
/// The place of an object that is in the table: a constant of the compiler. [any]
constexpr Slot slot_of(std::uint16_t index, std::uint8_t sub = 0) {
  return find(index, sub).slot;
}

// Objects that several parts of a drive use (CiA 402).
inline constexpr Slot kControlword = slot_of(0x6040), kMode = slot_of(0x6060),
                      kDisplay = slot_of(0x6061), kMaxTorque = slot_of(0x6072),
                      kRatedTorque = slot_of(0x6076), kMaxSpeed = slot_of(0x6080),
                      kVelocityUnit = slot_of(0x60A9), kVelocityOffset = slot_of(0x60B1);

constexpr std::size_t count_slots() {
  std::size_t slots = 0;
  for (const Row& row : kRows) slots += std::size_t{1} + row.last - row.first;
  return slots;
}

class Dictionary {
 public:
  /// Sets all objects to their defaults. [any]
  void reset(std::uint8_t node) { reset(node, 0x0000); }
  /// Sets the objects of the communication profile to their defaults. [any]
  void reset_communication(std::uint8_t node) { reset(node, 0x2000); }

  std::int64_t get(Slot slot) const { return values_[slot]; }
  void set(Slot slot, std::int64_t value) { values_[slot] = value; }
  /// As set(), by SDO: counted.
  void write(Slot slot, std::int64_t value) {
    set(slot, value);
    ++writes_[slot];
  }
  /// Writes by SDO since it exists. [any]
  int writes(Slot slot) const { return writes_[slot]; }
  int writes() const {
    int sum = 0;
    for (const int count : writes_) sum += count;
    return sum;
  }

 private:
  /// Resets the objects below `end`; all of them if it is 0.
  void reset(std::uint8_t node, std::uint16_t end) {
    std::size_t slot = 0;
    for (const Row& row : kRows) {
      const std::size_t count = std::size_t{1} + row.last - row.first;
      const std::int64_t value = row.value + ((row.access & kAddNode) != 0 ? node : 0);
      const bool affected = end == 0 || row.index < end;
      for (std::size_t i = 0; i < count && affected; ++i) values_[slot + i] = value;
      slot += count;
    }
  }

  std::array<std::int64_t, count_slots()> values_{};
  std::array<int, count_slots()> writes_{};
};

/// Returns an integer of the wire as a value of the type. [any]
constexpr std::int64_t decode(Type type, const std::uint8_t* bytes) {
  const std::size_t size = size_of(type);
  if (size == 0) return 0;  // a text
  std::uint64_t bits = 0;
  for (std::size_t i = size; i-- > 0;) bits = bits << 8 | bytes[i];
  const std::uint64_t sign = std::uint64_t{1} << (8 * size - 1);
  const auto value = static_cast<std::int64_t>(bits);
  return is_signed(type) && (bits & sign) != 0 ? value - static_cast<std::int64_t>(2 * sign)
                                               : value;
}
constexpr void encode(Type type, std::int64_t value, std::uint8_t* bytes) {
  auto bits = static_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < size_of(type); ++i, bits >>= 8)
    bytes[i] = static_cast<std::uint8_t>(bits);
}

}  // namespace tactus::drives
