// The link between a board and the computer at its other end: frames in both directions, each
//
//   COBS( kind u8, number u16, payload, CRC-32 u32 ) 00
//
// with numbers big-endian and reals IEEE-754. [Cheshire, Baker: Consistent Overhead Byte Stuffing,
// IEEE/ACM Transactions on Networking 7(2), 1999; CRC-32 of IEEE 802.3, clause 3.2.9]
//
// There are two lanes. Frames of the *cycle* carry the newest value of something; a lost one is
// replaced by the next and never repeated. *Messages* are sent one at a time: the board answers
// each with its number, and the computer repeats what is not answered. A message received twice
// is answered twice and executed once.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus::serial {

inline constexpr std::uint8_t kVersion = 1;

inline constexpr std::size_t kMaxPayload = 1024;
/// Kind, number and check sum.
inline constexpr std::size_t kHead = 3, kTail = 4;
/// Bytes of the longest frame on the link: one more for each 254, one for the code and one for the
/// end.
inline constexpr std::size_t kMaxFrame = kHead + kMaxPayload + kTail + 5 + 2;

enum class Kind : std::uint8_t {
  // Cycle, to the board.
  kState = 1,  ///< Order u8, and the robot's state: cycle_frames.hpp
  kTick = 2,   ///< stamp i64, ns: begins a cycle of a board in lock-step
  // Messages to the board; the answers contain the fields behind the arrow.
  kHello = 16,       ///< -> version u8, joints u8, robot text, hash of the pipeline's text u64
  kText = 17,        ///< offset u32, bytes of a pipeline's text
  kLoad = 18,        ///< size u32, hash u64 of the text that was sent; 0: the embedded one
  kStart = 19,       ///< Pace u8: connects; cycles begin
  kStop = 20,        ///< disables the drives, without braking; cycles end
  kTrajectory = 21,  ///< begins a trajectory: reference_frames.hpp
  kWaypoints = 22,   ///< its next waypoints -> how many were taken u16
  kEnd = 23,         ///< none follow
  kPoint = 24,       ///< an online point: size u8 of its terms, the terms, its numbers
  kControl = 25,     ///< space u8, ControlKind u8, rate f64
  kReports = 26,     ///< -> up to 16 of the reports that wait
  kFault = 27,       ///< -> the fault record, if there is one
  kForget = 28,      ///< deletes the fault record
  kProvoke = 29,     ///< Provocation u8; only test images support it
  // Sent by the board.
  kCommand = 64,  ///< cycle: the command of a cycle
  kAnswer = 65,   ///< to the message whose number it has: Status u8, and the data of the message
};

/// State that the computer requests of the arm. Every kState repeats it, so a lost one does no
/// harm.
enum class Order : std::uint8_t {
  kDisabled,  ///< brake on the path, then disable the drives; at the start: leave them disabled
  kArmed,     ///< arm, and follow references
};

enum class Pace : std::uint8_t {
  kTimer,     ///< the board's timer begins every cycle
  kLockStep,  ///< a kTick does, and the clock is its stamp
};

/// Faults that a test can provoke.
enum class Provocation : std::uint8_t {
  kHardFault,
  kStackOverflow,
  kStuckBackground,
  kStuckCycle,
  kDivision,
};

/// Returns true for the frames that are answered.
constexpr bool is_message(Kind kind) {
  return kind >= Kind::kHello && kind <= Kind::kProvoke;
}

}  // namespace tactus::serial
