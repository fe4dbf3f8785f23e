// The parts of the controller on which a program acts, and how a program answers it.
#pragma once

#include <cmath>
#include <cstdint>

#include "sim_plant/ur/motion/body.hpp"
#include "sim_plant/ur/motion/force_mode.hpp"
#include "sim_plant/ur/parts/modes.hpp"
#include "sim_plant/ur/wire/io.hpp"
#include "sim_plant/ur/wire/links.hpp"
#include "sim_plant/ur/wire/robot_messages.hpp"

namespace tactus::ur {

/// Watchdogs: the watchdogs of rtde_set_watchdog. An input that is not written at `min_frequency`
/// is late. The action is then
///
///   ignore   none
///   pause    the program pauses and the clients receive C207; it may be resumed
///   stop     a protective stop, C207, which ends the program
///
/// Watchdogs end with the program. A frequency that is not positive switches a watchdog off.
enum class LateAction : std::uint8_t { kIgnore, kPause, kStop };

class Watchdogs {
 public:
  /// Sets a watchdog from `cycle` on, and replaces one of the same input. [any]
  void set(const InputField& field, double min_frequency, LateAction action, std::int64_t cycle);
  void clear() { count_ = 0; }

  /// Returns the gravest action of all late inputs, or kIgnore. A pause is returned once, until the
  /// input is written again. [cyclic]
  LateAction check(const Io& io, std::int64_t cycle, double cycle_s);

 private:
  struct Watch {
    std::size_t variable = 0;
    double longest_s = 0.0;
    LateAction action = LateAction::kIgnore;
    std::int64_t from = 0;
    bool told = false;
  };
  std::array<Watch, 8> watches_{};
  std::size_t count_ = 0;
};

/// Machine: the parts of the controller on which a program acts.
struct Machine {
  explicit Machine(const Settings& chosen)
      : settings(chosen),
        power(settings),
        safety(settings),
        messages(settings.version),
        sensors(settings.sensor_errors, settings.version),
        motion(settings.motion, settings.force) {}
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// Begins a protective stop; the cycle reports it to the clients and ends the program. [any]
  void protective_stop(const Stop& stop) {
    if (!power.powered() || !safety.protective_stop()) return;
    last_stop = stop;
    stop_unsaid = true;
  }

  const Settings settings;
  Power power;
  Safety safety;
  RobotMessages messages;
  Sensors sensors;
  Motion motion;
  Body body;
  Io io;
  Links links;
  std::int64_t cycle = 0;
  double speed_scaling = 1.0;  ///< speed of the time base
  Vector6 tcp_offset = Vector6::Zero();
  double payload = 0.0;
  Vector3 payload_cog = Vector3::Zero();
  bool freedrive = false;
  ForceMode force_mode;
  double force_damping = kForceDamping;  ///< 0 to 1
  Watchdogs watchdogs;
  Stop last_stop;
  bool stop_unsaid = false;  ///< the stop is to be reported to the clients in the next cycle

  Joints measured_q() const { return sensors.position(body.q()); }    ///< rad
  Joints measured_dq() const { return sensors.velocity(body.dq()); }  ///< rad/s

  /// The wrench on the tip as the controller sees it, base axes, N and N m.
  Vector6 measured_wrench() const { return sensors.wrench(estimated_wrench()); }
  /// The same, never set to zero.
  Vector6 raw_wrench() const { return sensors.raw_wrench(estimated_wrench()); }
  /// Takes the present wrench as zero, if there is a sensor.
  void zero_force() { sensors.set_zero(estimated_wrench()); }

  double cycle_s() const { return settings.version.cycle_s(); }
  /// Time of the controller's clock, s.
  double time_s() const { return settings.start_time_s + static_cast<double>(cycle) * cycle_s(); }
  /// Sets the tip; NaN, or a value that no tool has, stops the arm.
  void set_tcp(const Vector6& pose) {
    if (!(pose.array().abs() <= kMost).all()) return refuse();
    tcp_offset = pose;
    motion.set_tool(Frame::of(pose));
  }
  void set_payload(double mass, const Vector3& cog) {
    if (!(std::abs(mass) <= kMost) || !(cog.array().abs() <= kMost).all()) return refuse();
    payload = mass;
    payload_cog = cog;
  }
  void start_force_mode(const ForceMode& mode) {
    if (!mode.valid()) return refuse();
    force_mode = mode;
    force_mode.active = true;
  }
  /// Ends the modes that end with the program. [any]
  void end_modes() {
    freedrive = false;
    force_mode = {};
    force_damping = kForceDamping;
    watchdogs.clear();
  }

 private:
  Vector6 estimated_wrench() const;

  static constexpr double kMost = 1e4;  // m, rad or kg; beyond the range of 32 bits of millionths
  void refuse() { protective_stop({Code::kPathSanity, kInvalidSetPoint}); }
};

/// The result of the two functions of a running program. In every cycle poll() runs its main
/// thread, which reads sockets and registers; command() gives the next motion command after the
/// last has returned.
enum class ProgramStep : std::uint8_t {
  kRunning,  ///< command(): a motion command was given; poll(): the program goes on
  kWaiting,  ///< command(): no motion command in this cycle
  kEnded,
};

}  // namespace tactus::ur
