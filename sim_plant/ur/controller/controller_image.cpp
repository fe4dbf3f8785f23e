// The image that the controller shows on its ports.
#include <cmath>
#include <limits>

#include "sim_plant/ur/controller/controller.hpp"

namespace tactus::ur {
namespace {

/// Joint torque per motor current, N m/A: gear ratio 101 and motor constants of the magnitude given
/// in identification papers on the UR10.
Joints torque_constant() {
  Joints k;
  k << 14.0, 14.0, 11.0, 9.5, 9.5, 9.5;
  return k;
}
constexpr double kMovingMass_kg = 28.4;

}  // namespace

void Controller::show() {
  const Joints k = torque_constant();
  const Motion& motion = machine_.motion;
  const Body& body = machine_.body;
  if (!faults_.frozen_stamp) image_.timestamp = machine_.time_s();
  image_.target_q = motion.q();
  image_.target_qd = motion.dq() * machine_.speed_scaling;
  image_.target_qdd = (image_.target_qd - dq_before_) / machine_.cycle_s();
  image_.target_moment = body.model();
  image_.target_current = body.model().cwiseQuotient(k);
  image_.actual_q = machine_.measured_q() + faults_.encoder_offset;
  if (faults_.nan_positions) image_.actual_q.setConstant(std::numeric_limits<double>::quiet_NaN());
  image_.actual_qd = machine_.measured_dq();
  image_.actual_current = (body.tau() + machine_.sensors.torque_error()).cwiseQuotient(k);
  image_.joint_control_output = image_.actual_current;
  show_tool();
  show_io();
  show_modes();
}

void Controller::show_tool() {
  const Motion& motion = machine_.motion;
  const Frame& tool = motion.tool();
  const Joints q = machine_.measured_q(), dq = machine_.measured_dq();
  const DhTable& dh = machine_.settings.dh;
  const Frame flange = forward(q, dh), tip = flange * tool;
  image_.actual_tcp_pose = tip.pose();
  image_.actual_tcp_speed = jacobian(q, tool) * dq;
  image_.target_tcp_pose = (forward(motion.q(), dh) * tool).pose();
  image_.target_tcp_speed = jacobian(motion.q(), tool) * image_.target_qd;
  image_.actual_tcp_force = machine_.measured_wrench();
  if (machine_.settings.version.major >= 5) {  // about the sensor, in the flange
    const Vector3 force = image_.actual_tcp_force.head<3>();
    image_.actual_tcp_force.tail<3>() += (tip.p - flange.p).cross(force);
  }
  const Vector6 raw = machine_.raw_wrench();
  const Vector3 force = flange.r.transpose() * raw.head<3>();
  const Vector3 weight = flange.r.transpose() * (machine_.payload * machine_.body.base_gravity());
  image_.ft_raw_wrench.head<3>() = force + weight;
  image_.ft_raw_wrench.tail<3>() = flange.r.transpose() * raw.tail<3>() + tool.p.cross(force) +
                                   machine_.payload_cog.cross(weight);
  image_.tcp_force_scalar = image_.actual_tcp_force.head<3>().norm();
  const Vector3 v = image_.actual_tcp_speed.head<3>();
  image_.actual_tool_accelerometer =
      tip.r.transpose() *
      ((v - tcp_speed_before_) / machine_.cycle_s() - machine_.body.base_gravity());
  tcp_speed_before_ = v;
  image_.actual_momentum = 0.5 * kMovingMass_kg * v.norm();
  const Vector3 before = image_.elbow_position;
  image_.elbow_position = elbow(q);
  if (!before.isZero(0.0))
    image_.elbow_velocity = (image_.elbow_position - before) / machine_.cycle_s();
  image_.tcp_offset = machine_.tcp_offset;
  image_.payload = machine_.payload;
  image_.payload_cog = machine_.payload_cog;
}

void Controller::show_io() {
  const Io& io = machine_.io;
  image_.actual_digital_input_bits = io.digital_inputs;
  image_.actual_digital_output_bits = io.digital_outputs;
  image_.analog_io_types = io.analog_types;
  image_.standard_analog_input0 = io.analog_inputs[0];
  image_.standard_analog_input1 = io.analog_inputs[1];
  image_.standard_analog_output0 = io.analog_outputs[0];
  image_.standard_analog_output1 = io.analog_outputs[1];
  image_.tool_output_voltage = io.tool_voltage;
  image_.input = io.input;
  image_.output = io.output;
  image_.target_speed_fraction = io.speed_fraction;
  // The fraction of the slider's speed that the trajectory limiter leaves; 1 while the slider goes
  // down.
  const double scaling = machine_.speed_scaling;
  const double passes = scaling < io.speed_fraction ? scaling / io.speed_fraction : 1.0;
  image_.speed_scaling = runner_.running() ? passes : 0.0;
}

void Controller::show_modes() {
  const RobotMode mode = machine_.power.mode();
  const bool running = mode == RobotMode::kRunning;
  image_.robot_mode = static_cast<std::int32_t>(mode);
  const JointMode joint = running                       ? JointMode::kRunning
                          : mode == RobotMode::kIdle    ? JointMode::kIdle
                          : mode == RobotMode::kPowerOn ? JointMode::kBooting
                                                        : JointMode::kPowerOff;
  image_.joint_mode.fill(static_cast<std::int32_t>(joint));
  image_.tool_mode = static_cast<std::uint32_t>(joint);
  const double volts = machine_.power.powered() ? 48.0 : 0.0;
  image_.actual_robot_voltage = volts;
  image_.actual_joint_voltage.setConstant(volts);
  const SafetyMode safety = machine_.safety.mode();
  image_.safety_mode = image_.safety_status = static_cast<std::int32_t>(safety);
  image_.protective_stopped = machine_.safety.protective_stopped();
  image_.program_running = runner_.playing();
  image_.program_paused = runner_.paused();
  image_.freedrive = machine_.freedrive;
  image_.force_mode = machine_.force_mode.active;
  image_.runtime_state = static_cast<std::uint32_t>(runner_.state());
  image_.robot_status_bits = (machine_.power.powered() ? kPowerOnBit : 0u) |
                             (runner_.running() ? kProgramRunningBit : 0u) |
                             (machine_.freedrive ? kTeachButtonBit : 0u);
  // The bits are in the order of the modes; causes of a stop have a bit of their own in addition.
  std::uint32_t bits = 1u << (static_cast<unsigned>(safety) - 1);
  if (safety == SafetyMode::kViolation) bits = kViolationBit;
  if (safety == SafetyMode::kFault) bits = kFaultBit;
  if (!machine_.safety.normal()) bits |= kStoppedDueToSafetyBit;
  image_.safety_status_bits = bits;
}

}  // namespace tactus::ur
