// PacketClock: the robot's packets begin the cycles, one cycle for every period of the robot,
// whatever the network does to the packets.
//
// A packet that does not arrive in time is bridged: the cycle begins without it, so that the robot
// does not wait for its set-point. If the packet still arrives, it begins no other cycle. Lost
// packets show as a jump of the stamp, which the executive judges.
#pragma once

#include <cstdint>

namespace tactus::ur {

class PacketClock {
 public:
  enum class Arrival : std::uint8_t {
    kCycle,      ///< the next cycle
    kLate,       ///< belongs to a cycle that was bridged
    kRepeated,   ///< same time stamp as the packet before
    kBackwards,  ///< the controller's clock was set back, or the controller was restarted
  };

  /// `timestamp_s`: time stamp of the last packet before the first cycle. [init]
  void start(double timestamp_s, std::int64_t period_ns) {
    period_ns_ = period_ns;
    packet_ns_ = cycle_ns_ = to_ns(timestamp_s);
    missed_ = 0;
  }

  /// Takes the time stamp of a packet that has arrived. [cyclic]
  Arrival packet(double timestamp_s) {
    const std::int64_t stamp_ns = to_ns(timestamp_s);
    if (stamp_ns <= packet_ns_)
      return stamp_ns < packet_ns_ ? Arrival::kBackwards : Arrival::kRepeated;
    packet_ns_ = stamp_ns;
    missed_ = 0;
    if (stamp_ns < cycle_ns_ + period_ns_ / 2) return Arrival::kLate;
    cycle_ns_ = stamp_ns;
    return Arrival::kCycle;
  }
  /// Begins the cycle without its packet. [cyclic]
  void bridge() {
    cycle_ns_ += period_ns_;
    ++missed_;
  }

  /// Stamp of the present cycle by the robot's clock, ns. [cyclic]
  std::int64_t stamp_ns() const { return cycle_ns_; }
  /// Stamp of the newest packet, ns. [cyclic]
  std::int64_t packet_ns() const { return packet_ns_; }
  /// Cycles in a row without a new packet. [cyclic]
  int missed() const { return missed_; }
  /// How long to wait for the next packet before it is bridged, ns: `periods` after a packet, half
  /// a period less after a cycle without one, which has waited already. [cyclic]
  std::int64_t patience_ns(double periods) const {
    const double left = missed_ == 0 ? periods : periods - 0.5;
    return static_cast<std::int64_t>(left * static_cast<double>(period_ns_));
  }

 private:
  static std::int64_t to_ns(double timestamp_s) {
    constexpr double kLongest_s = 9e9;  // 285 years; the stamp can hold little more
    const bool good = timestamp_s >= 0.0 && timestamp_s < kLongest_s;
    return good ? static_cast<std::int64_t>(timestamp_s * 1e9 + 0.5) : 0;
  }

  std::int64_t period_ns_ = 0, packet_ns_ = 0, cycle_ns_ = 0;
  int missed_ = 0;
};

}  // namespace tactus::ur
