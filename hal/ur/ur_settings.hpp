// UrSettings: the [ur] section of a pipeline file. Tool and payload are those of [robot].
#pragma once

#include "kernel/describe.hpp"
#include "kernel/load_error.hpp"

namespace tactus::ur {

/// What a start does about a protective stop that it finds. A stop during motion always ends it.
enum class OnProtectiveStop : std::uint8_t { kRefuse, kRelease };
inline constexpr std::array<const char*, 2> kOnProtectiveStopWords = {"refuse", "release"};

/// What a start does about a robot that is not powered, or whose brakes are closed.
enum class OnPowerOff : std::uint8_t { kRefuse, kPowerOn };
inline constexpr std::array<const char*, 2> kOnPowerOffWords = {"refuse", "power_on"};

enum class ZeroForce : std::uint8_t { kOff, kOn };
inline constexpr std::array<const char*, 2> kZeroForceWords = {"off", "on"};

struct UrSettings {
  Value address;  ///< IPv4; none: refused
  int rtde_port = 30004, primary_port = 30001, dashboard_port = 29999;
  int connect_ms = 2000;     ///< the longest that a connection, or a reply, may take
  int program_ms = 2000;     ///< the longest until the program is seen running, or stopped
  int power_ms = 30000;      ///< the longest until the brakes are released, or a stop
  int max_missed = 5;        ///< periods in a row without a packet that are bridged
  double packet_wait = 1.5;  ///< periods that a cycle waits for its packet before it begins without
  double lookahead_s = 0.1;  ///< of servoj
  double gain = 300.0;       ///< of servoj
  int patience = 12;         ///< cycles that the robot goes on without a set-point, slowing down
  double deceleration = 4.0;               ///< of the robot's own stop, rad/s^2
  ZeroForce zero_force = ZeroForce::kOff;  ///< of the sensor at the start (e-Series)
  OnProtectiveStop on_protective_stop = OnProtectiveStop::kRefuse;
  OnPowerOff on_power_off = OnPowerOff::kRefuse;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.text("address", address, "IPv4 address of the controller");
    visit.param("rtde_port", rtde_port, Range{1.0, 65535.0}, "1");
    visit.param("primary_port", primary_port, Range{1.0, 65535.0}, "1");
    visit.param("dashboard_port", dashboard_port, Range{1.0, 65535.0}, "1");
    visit.param("connect_ms", connect_ms, Range{10.0, 60000.0}, "ms");
    visit.param("program_ms", program_ms, Range{10.0, 60000.0}, "ms");
    visit.param("power_ms", power_ms, Range{10.0, 120000.0}, "ms");
    visit.param("max_missed", max_missed, Range{0.0, 100.0}, "cycles");
    visit.param("packet_wait", packet_wait, Range{1.1, 1000.0}, "cycles");
    visit.param("lookahead_s", lookahead_s, Range{0.03, 0.2}, "s");
    visit.param("gain", gain, Range{100.0, 2000.0}, "1");
    visit.param("patience", patience, Range{1.0, 125.0}, "cycles");
    visit.param("deceleration", deceleration, Range{0.1, 100.0}, "rad/s^2");
    visit.choice("zero_force", zero_force, kZeroForceWords);
    visit.choice("on_protective_stop", on_protective_stop, kOnProtectiveStopWords);
    visit.choice("on_power_off", on_power_off, kOnPowerOffWords);
  }
};

}  // namespace tactus::ur
