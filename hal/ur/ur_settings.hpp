// UrSettings: the [ur] section of a pipeline file. Tool and payload are those of [robot].
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/load_error.hpp"

namespace tactus::ur {

/// Reaction of arming to a protective stop. A stop during motion always ends the motion.
enum class OnProtectiveStop : std::uint8_t { kRefuse, kRelease };

constexpr const char* name(OnProtectiveStop reaction) {
  switch (reaction) {
    case OnProtectiveStop::kRefuse: return "refuse";
    case OnProtectiveStop::kRelease: return "release";
  }
  return nullptr;
}

/// Reaction of arming to a robot without power or with closed brakes.
enum class OnPowerOff : std::uint8_t { kRefuse, kPowerOn };

constexpr const char* name(OnPowerOff reaction) {
  switch (reaction) {
    case OnPowerOff::kRefuse: return "refuse";
    case OnPowerOff::kPowerOn: return "power_on";
  }
  return nullptr;
}

enum class ZeroForce : std::uint8_t { kOff, kOn };

constexpr const char* name(ZeroForce zero) {
  switch (zero) {
    case ZeroForce::kOff: return "off";
    case ZeroForce::kOn: return "on";
  }
  return nullptr;
}

/// The arms that are accepted: that of the program's table, or one with any calibration.
enum class Calibration : std::uint8_t { kTable, kAny };

constexpr const char* name(Calibration calibration) {
  switch (calibration) {
    case Calibration::kTable: return "table";
    case Calibration::kAny: return "any";
  }
  return nullptr;
}

struct UrSettings {
  Value address;  ///< IPv4; must be given
  int rtde_port = 30004, primary_port = 30001, dashboard_port = 29999;
  int connect_ms = 2000;      ///< longest time until the first state, in all
  int program_ms = 2000;      ///< longest time for each step of arming the program
  int power_ms = 30000;       ///< the same for power, brakes and a protective stop
  int max_missed = 5;         ///< periods in a row without a packet that are bridged
  double packet_wait = 1.5;   ///< periods after which a cycle begins without its packet
  double lookahead_s = 0.1;   ///< of servoj
  double gain = 300.0;        ///< of servoj
  int patience = 12;          ///< cycles in which the robot slows down without set-points
  double deceleration = 4.0;  ///< of the robot's own stop, rad/s^2
  ZeroForce zero_force = ZeroForce::kOff;  ///< zero the sensor when arming (e-Series)
  OnProtectiveStop on_protective_stop = OnProtectiveStop::kRefuse;
  OnPowerOff on_power_off = OnPowerOff::kRefuse;
  Calibration calibration = Calibration::kTable;
  double tip_tolerance = 0.01;  ///< largest distance of the reported from the computed tip, m

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
    visit.choice("zero_force", zero_force);
    visit.choice("on_protective_stop", on_protective_stop);
    visit.choice("on_power_off", on_power_off);
    visit.choice("calibration", calibration);
    visit.param("tip_tolerance", tip_tolerance, Range{1e-4, 0.1}, "m");
  }
};

}  // namespace tactus::ur
