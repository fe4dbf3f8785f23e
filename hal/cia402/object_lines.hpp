// ObjectLines: the lines `sdo = ...` of [cia402]: objects of the drives that the file sets, such as
// a manufacturer's own. Objects that start-up or cycle write are refused.
//
//   sdo = 0x2003:1 u16 5            in the drives of all joints
//   sdo = joint3 0x2003:1 i32 -70   in that of one
#pragma once

#include <array>

#include "hal/cia402/protocol.hpp"
#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"

namespace tactus::cia402 {

/// How the value of a line is written; f32 travels as its bits (IEEE 754).
enum class ValueType : std::uint8_t { kU8, kU16, kU32, kI8, kI16, kI32, kF32 };

/// The name of a type in a file. [any]
const char* name(ValueType type);

struct ObjectLine {
  static constexpr int kEvery = -1;

  int line = 0;            ///< of the file
  int joint = kEvery;      ///< from 0
  Object object{};         ///< with the bytes of its type
  std::uint32_t bits = 0;  ///< of the value, in the lowest bytes
  ValueType type = ValueType::kU8;

  bool is_for(int of_joint) const { return joint == kEvery || joint == of_joint; }
  /// True if an object that reads `value` is as the line has it. [any]
  bool is(std::uint32_t value) const { return ((value ^ bits) & mask()) == 0; }
  /// Appends a value of this type: "-70". [any]
  void append(Message& text, std::uint32_t value) const;

 private:
  std::uint32_t mask() const { return 0xFFFFFFFFU >> (32 - 8 * object.bytes); }
};

class ObjectLines {
 public:
  static constexpr int kMost = 32, kLeast = 0;

  /// Reads a line. `why` has the place in it, the value and the limit, or the reason why this
  /// object is not for a line. [init]
  Status add(std::string_view text, int line, Message& why);

  int count() const { return count_; }
  const ObjectLine& operator[](int i) const { return lines_[static_cast<std::size_t>(i)]; }

 private:
  std::array<ObjectLine, kMost> lines_;
  int count_ = 0;
};

/// Why a line may not set an object; null: it may. [init]
const char* kept_by_program(std::uint16_t index);

}  // namespace tactus::cia402
