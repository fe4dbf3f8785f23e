// PdoLayout: which objects of a drive travel in which PDO, byte for byte: the list that is written
// to the drive's mapping, and from which commands are encoded and feedback is decoded.
//
//   feedback   TPDO 1, at every SYNC: statusword, position, with CAN FD velocity, torque
//   plain      RPDO 1 of every drive, in force at the next SYNC: controlword and targets
//   packed     all drives of a bus in common frames, in which each skips the others' bytes: with
//   CAN
//              FD (controlword, torque) of each; with classic CAN the torques in RPDO 2, and the
//              controlwords in RPDO 1, which is sent when one changes, while drives are armed
//              or stopped, and every kRefresh cycles
#pragma once

#include "hal/can/can_settings.hpp"
#include "hal/can/protocol_canopen.hpp"
#include "hal/cia402/drive_wire.hpp"
#include "hal/cia402/protocol.hpp"
#include "kernel/core/hal.hpp"

namespace tactus::can {

/// One PDO as its drive sees it.
struct Pdo {
  static constexpr int kMaxEntries = 10;

  int number = 0;                                    ///< from 1
  std::uint16_t id = 0;                              ///< COB-ID
  std::array<std::uint32_t, kMaxEntries> entries{};  ///< of its mapping
  int count = 0;                                     ///< of entries
  std::size_t size = 0;                              ///< bytes

  void add(std::uint32_t entry) {
    entries[static_cast<std::size_t>(count++)] = entry;
    size += (entry & 0xFFU) / 8;
  }
  void add(const cia402::Object& object) { add(object.mapping()); }
};

/// The place of a drive among those of its bus.
struct Slot {
  int index = 0, count = 1;     ///< of drives of this bus
  std::uint8_t node = 1;        ///< of the drive
  std::uint8_t first_node = 1;  ///< of the bus, which gives the common frames their identifier
};

class PdoLayout {
 public:
  static constexpr int kMaxCommands = 2;  ///< RPDOs of a drive
  static constexpr int kRefresh = 50;     ///< cycles

  PdoLayout() = default;
  PdoLayout(CommandMode mode, Frames frames, Commands commands);

  bool packed() const { return commands_ == Commands::kPacked; }
  bool fd() const { return frames_ == Frames::kFd; }
  /// RPDOs of a drive. [any]
  int command_frames() const { return packed() && !fd() ? 2 : 1; }
  /// Most drives of one bus that the common frames have room for. [init]
  int capacity() const;

  Pdo feedback(const Slot& slot) const;
  /// Bytes of a feedback frame. [cyclic]
  std::size_t feedback_size() const { return feedback_.size; }
  /// Fills in the RPDOs of a drive; returns their number. [init]
  int commands(const Slot& slot, std::array<Pdo, kMaxCommands>& pdos) const;

  /// Fills in feedback from a frame of its size. [cyclic]
  void decode(const CanFrame& frame, cia402::DriveFeedback& feedback) const;
  /// Writes a drive's command into its frame, or its place in the common ones: `frame` is that of
  /// RPDO `number`. [cyclic]
  void encode(int number, const Slot& slot, const cia402::DriveCommand& command,
              CanFrame& frame) const;
  /// Bytes of the frame of RPDO `number`, padded to what CAN FD can have. [cyclic]
  std::size_t frame_size(int number, const Slot& slot) const;
  /// Identifier of the frame. [cyclic]
  std::uint16_t frame_id(int number, const Slot& slot) const;
  /// True if a frame with this identifier commands the drive. [cyclic]
  bool is_command(std::uint16_t id, const Slot& slot) const {
    static_assert(kMaxCommands == 2);
    return id == frame_id(1, slot) || (command_frames() == 2 && id == frame_id(2, slot));
  }

 private:
  static constexpr int kMaxObjects = 4;
  struct Objects {
    std::array<cia402::Object, kMaxObjects> list{};
    int count = 0;
    std::size_t size = 0;

    void add(const cia402::Object& object) {
      list[static_cast<std::size_t>(count++)] = object;
      size += object.bytes;
    }
  };

  /// A drive's own objects in its RPDO `number`. [any]
  const Objects& own(int number) const { return command_[static_cast<std::size_t>(number - 1)]; }

  Frames frames_ = Frames::kClassic;
  Commands commands_ = Commands::kPlain;
  Objects feedback_;
  std::array<Objects, kMaxCommands> command_;
};

}  // namespace tactus::can
