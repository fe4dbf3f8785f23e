// Tape: the inputs of a run as bytes, cycle by cycle: the robot's measurements and the client's
// requests. A tape is recorded from a run, written by a script or invented by a search: any bytes
// are a tape. Missing operands are zero. scripts/wcet/tape.py writes the same operations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tactus {

/// An operation is one byte, modulo their number, then its operands, little-endian.
enum class TapeOp : std::uint8_t {
  kCycle,       ///< one cycle
  kCycles,      ///< u8 + 1 cycles with the same state
  kStart,       ///< stops if need be, and starts from the present state
  kState,       ///< f32: q, dq, tau, ft, as measured from now on
  kJoints,      ///< i8 per joint: q as a fraction of its range, -127 and 127 being the limits
  kVelocities,  ///< i8 per joint: dq as a fraction of its limit
  kEfforts,     ///< i8 per joint: tau as a fraction of its limit
  kWrench,      ///< i8 x 6: ft, 1.3 N and 0.13 N m each
  kPoint,       ///< a point near the reference, see Player
  kTrajectory,  ///< a trajectory near the reference, see Player
  kWaypoints,   ///< a trajectory as a client gave it, see Player
  kAppend,      ///< u8: the waypoints appended to the trajectory sent last; the last if odd
  kCancel,
  kOverride,  ///< u8: the rate, in 255ths
  kPause,
  kResume,
  kLate,  ///< u8: quarters of a period by which the next cycle is late
  kDeaf,  ///< u8: the client reads no reports for so many cycles
  kCount,
};

/// Waypoints of the longest joint trajectory that is recorded: 20 s at 1 kHz.
inline constexpr int kLongestTape = 20480;

/// Bytes that are read once, front to back.
class Bytes {
 public:
  Bytes() = default;
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  const std::uint8_t* data() const { return data_; }
  std::size_t size() const { return left_; }

  template <class T>
  T take() {
    T value{};
    const std::size_t size = sizeof value < left_ ? sizeof value : left_;
    if (size == sizeof value) std::memcpy(&value, data_, size);
    data_ += size;
    left_ -= size;
    return value;
  }
  /// The next `size` bytes, or what there is.
  Bytes split(std::size_t size) {
    const Bytes front(data_, size < left_ ? size : left_);
    data_ += front.left_;
    left_ -= front.left_;
    return front;
  }

 private:
  const std::uint8_t* data_ = nullptr;
  std::size_t left_ = 0;
};

/// The next tape of a reel; each is preceded by its length as u32.
inline Bytes next_tape(Bytes& reel) {
  return reel.split(reel.take<std::uint32_t>());
}

}  // namespace tactus
