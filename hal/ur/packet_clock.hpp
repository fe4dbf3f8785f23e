// PacketClock: the robot's clock is the master, and its packets begin the cycles: one cycle for
// every period of the robot, whatever the network does to the packets.
//
// A packet that does not come in time is bridged: the cycle begins without it, so that the robot
// does not wait for its set-point. When it comes after all, its cycle has been, and it begins no
// other. Packets that were left out are seen as a jump of the stamp, which the executive judges.
#pragma once

#include <cstdint>

namespace tactus::ur {

class PacketClock {
 public:
  enum class Found : std::uint8_t {
    kCycle,      ///< the next cycle
    kLate,       ///< of a cycle that has been bridged
    kRepeated,   ///< the time stamp of the packet before: nothing new
    kBackwards,  ///< the controller's clock was set back, or it was started again
  };

  /// `timestamp_s`: of the packet that was the last before the first cycle. [init]
  void start(double timestamp_s, std::int64_t period_ns) {
    period_ns_ = period_ns;
    packet_ns_ = cycle_ns_ = to_ns(timestamp_s);
    missed_ = 0;
  }

  /// A packet has come. [cyclic]
  Found packet(double timestamp_s) {
    const std::int64_t stamp_ns = to_ns(timestamp_s);
    if (stamp_ns <= packet_ns_) return stamp_ns < packet_ns_ ? Found::kBackwards : Found::kRepeated;
    packet_ns_ = stamp_ns;
    missed_ = 0;
    if (stamp_ns < cycle_ns_ + period_ns_ / 2) return Found::kLate;
    cycle_ns_ = stamp_ns;
    return Found::kCycle;
  }
  /// None has come in time: the cycle begins without it. [cyclic]
  void bridge() {
    cycle_ns_ += period_ns_;
    ++missed_;
  }

  /// Of the present cycle, by the robot's clock. [cyclic]
  std::int64_t stamp_ns() const { return cycle_ns_; }
  /// Cycles in a row without a new packet. [cyclic]
  int missed() const { return missed_; }
  /// How long to wait for the next one before it is bridged, of `periods` for one that follows
  /// another; less by half a period where that has waited already. [cyclic]
  std::int64_t patience_ns(double periods) const {
    const double left = missed_ == 0 ? periods : periods - 0.5;
    return static_cast<std::int64_t>(left * static_cast<double>(period_ns_));
  }

 private:
  static std::int64_t to_ns(double timestamp_s) {
    constexpr double kLongest_s = 9e9;  // 285 years, as many as the stamp can hold
    const bool good = timestamp_s >= 0.0 && timestamp_s < kLongest_s;
    return good ? static_cast<std::int64_t>(timestamp_s * 1e9 + 0.5) : 0;
  }

  std::int64_t period_ns_ = 0, packet_ns_ = 0, cycle_ns_ = 0;
  int missed_ = 0;
};

}  // namespace tactus::ur
