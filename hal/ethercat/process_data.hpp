// ProcessData: where the objects of a drive are in the image of a cycle; commands are encoded and
// feedback is decoded there.
#pragma once

#include <array>

#include "hal/cia402/drive_wire.hpp"
#include "hal/cia402/protocol.hpp"
#include "kernel/core/hal.hpp"

namespace tactus::ethercat {

/// The objects in the process data of one direction of a drive, bit for bit, as it maps them.
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

/// The objects to map for the commands of a pipeline, in order. [init]
struct MappedObjects {
  static constexpr int kMost = 6;
  std::array<cia402::Object, kMost> list{};
  int count = 0;

  void add(const cia402::Object& object) { list[static_cast<std::size_t>(count++)] = object; }
};
MappedObjects objects_of_outputs(CommandMode mode);
MappedObjects objects_of_inputs();

class ProcessData {
 public:
  ProcessLayout outputs, inputs;
  std::size_t out_at = 0, in_at = 0;  ///< in the image

  /// Finds the objects in the layouts. Returns the one that is missing, or does not begin with a
  /// byte; null: none. [init]
  const char* resolve(CommandMode mode);
  /// True if the cycle writes the mode of operation. [cyclic]
  bool commands_mode() const { return out_[kOutputs - 1] >= 0; }
  /// Fills in feedback from the image. [cyclic]
  void decode(const std::uint8_t* image, cia402::DriveFeedback& feedback) const;
  /// Writes a command, and the mode of operation where it is mapped, into the image. [cyclic]
  void encode(const cia402::DriveCommand& command, std::uint8_t* image) const;

 private:
  static constexpr int kOutputs = 7;

  std::array<int, kOutputs> out_{};
  int status_ = -1, position_ = -1, velocity_ = -1, torque_ = -1, error_ = -1;
  std::uint8_t mode_ = 0;
};

}  // namespace tactus::ethercat
