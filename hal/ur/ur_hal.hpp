// UrHal: a Universal Robots arm with six joints behind its own ports. State and set-points go
// through RTDE, our program on the controller passes the set-points to servoj, the dashboard
// switches power on, and the primary port reports why the robot stopped.
//
// The robot's clock starts the cycles. A fault of the robot is a fault of all six drives
// (hal/ur/arm_drives.hpp), shown by the read() of the packet that shows it; the exchange continues,
// and the drives can be armed again. read() fails only if the wire does not work any more, and from
// then on until the next connect(). Neither a stop nor disconnect() changes power and brakes:
// nothing moves without the program, which only arming uploads.
#pragma once

#include "hal/ur/arm_drives.hpp"
#include "hal/ur/packet_clock.hpp"
#include "hal/ur/rtde_client.hpp"
#include "hal/ur/ur_settings.hpp"
#include "kernel/core/hal.hpp"

namespace tactus::ur {

class UrHal final : public Hal, public Clock {
 public:
  /// Takes the settings of the pipeline file, which must outlive the use of the Hal.
  /// `given` is the tool as the file gives it: what is NaN is not set in the controller, and must
  /// be zero there. With `outputs` it claims and sends the digital outputs. [init]
  void configure(const UrSettings& settings, const Tool& given, int period_us,
                 bool outputs = false);

  /// Positions, at 125 Hz (CB3, e-Series) or 500 Hz (e-Series), and 18 digital outputs, which the
  /// robot keeps as they are when the drives are disabled, and when the wire is closed or lost.
  Capabilities capabilities() const override;
  /// Connects and waits for the first state, in all no longer than `connect_ms`. kNotOffered,
  /// kBadValue, kConnectionLost, kBusTimeout, kRefusedByRobot, kRegistersInUse, kWireFormat;
  /// kMissingKey, kMismatch: hal/ur/reported_tool.hpp, of an arm that is switched on and at rest;
  /// kMismatch: hal/ur/arm_calibration.hpp; trouble() has details. [init]
  Status connect(CommandMode mode) override;
  Status read(const CycleTime& now, RobotState& state) override;
  Status write(const RobotCommand& command) override;
  Status disconnect() override;
  const char* output_name(int output) const override;

  Clock* clock() override { return this; }
  /// Waits for the packet that begins the next cycle, or until it is bridged, and gives the time by
  /// the robot's clock. kClock before configure(). [between two cycles]
  Status wait(CycleTime& now) override;

  /// Waits up to 0.2 s, once for each fault, for the robot's own code and text.
  /// [between two cycles]
  Message trouble() override;
  const UrState& state() const { return state_; }
  /// The count of the last set-point, as in the register. [any]
  std::int32_t set_points() const { return drives_.set_points().count(); }
  const RtdeClient& session() const { return session_; }
  DrivePhase phase() const { return drives_.phase(); }

 private:
  enum class Received : std::uint8_t { kNothing, kCycle, kNothingNew };

  Status open(CommandMode mode);
  Status check_rate();
  Status check_sensor();
  Status check_arm();
  Status await_state(const Deadline& deadline);
  Status await_calibration(const Deadline& deadline);
  Received receive();
  Status judge_silence();
  void show(RobotState& state);
  void close();

  const UrSettings* settings_ = nullptr;
  Tool given_;  // NaN: not given
  int period_us_ = 0;
  bool sends_outputs_ = false;

  Message why_;
  RtdeClient session_;
  ArmDrives drives_{session_, why_};
  UrState state_;
  PacketClock clock_;
  Status fault_ = Status::kNotStarted;  // of the wire
  bool listened_ = false;               // for the robot's own code of the present fault
};

}  // namespace tactus::ur
