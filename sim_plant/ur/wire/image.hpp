// Image: the data that the controller shows on all its ports, updated once per cycle. The members
// have the names of the RTDE fields, whose meaning is in the guide.
#pragma once

#include <array>
#include <cstdint>

#include "hal/ur/protocol.hpp"
#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

/// The general purpose registers of one direction.
struct Registers {
  std::array<std::uint32_t, kBitRegisters / 32> bits{};
  std::array<std::int32_t, kRegisters> ints{};
  std::array<double, kRegisters> doubles{};

  bool bit(int i) const { return bits[static_cast<std::size_t>(i / 32)] >> (i % 32) & 1u; }
  void set_bit(int i, bool on) {
    const std::uint32_t mask = 1u << (i % 32);
    std::uint32_t& word = bits[static_cast<std::size_t>(i / 32)];
    word = on ? word | mask : word & ~mask;
  }
};

struct Image {
  double timestamp = 0.0;
  Joints target_q = Joints::Zero(), target_qd = Joints::Zero(), target_qdd = Joints::Zero();
  Joints target_current = Joints::Zero(), target_moment = Joints::Zero();
  Joints actual_q = Joints::Zero(), actual_qd = Joints::Zero(), actual_current = Joints::Zero();
  Joints joint_control_output = Joints::Zero();
  Vector6 actual_tcp_pose = Vector6::Zero(), actual_tcp_speed = Vector6::Zero();
  Vector6 actual_tcp_force = Vector6::Zero();
  Vector6 ft_raw_wrench = Vector6::Zero();  ///< of the sensor, in the flange, with the payload
  Vector6 target_tcp_pose = Vector6::Zero(), target_tcp_speed = Vector6::Zero();
  std::uint64_t actual_digital_input_bits = 0, actual_digital_output_bits = 0;
  Joints joint_temperatures = Joints::Constant(30.0);
  double actual_execution_time = 0.25;
  std::int32_t robot_mode = 3;
  std::array<std::int32_t, 6> joint_mode{};
  std::int32_t safety_mode = 1, safety_status = 1;
  Vector3 actual_tool_accelerometer = Vector3::Zero();
  double speed_scaling = 0.0, target_speed_fraction = 1.0;
  double actual_momentum = 0.0;
  double actual_main_voltage = 48.0, actual_robot_voltage = 48.0, actual_robot_current = 0.5;
  Joints actual_joint_voltage = Joints::Constant(48.0);
  std::uint32_t runtime_state = 1;
  Vector3 elbow_position = Vector3::Zero(), elbow_velocity = Vector3::Zero();
  std::uint32_t robot_status_bits = 0, safety_status_bits = 1;
  std::uint32_t analog_io_types = 0;
  double standard_analog_input0 = 0.0, standard_analog_input1 = 0.0;
  double standard_analog_output0 = 0.0, standard_analog_output1 = 0.0;
  double io_current = 0.0;
  std::uint32_t euromap67_input_bits = 0, euromap67_output_bits = 0;
  double euromap67_24v_voltage = 0.0, euromap67_24v_current = 0.0;
  std::uint32_t tool_mode = 253, tool_analog_input_types = 0;
  double tool_analog_input0 = 0.0, tool_analog_input1 = 0.0;
  std::int32_t tool_output_voltage = 0;
  double tool_output_current = 0.0, tool_temperature = 30.0;
  double tcp_force_scalar = 0.0;
  Vector6 tcp_offset = Vector6::Zero();
  double joint_position_deviation_ratio = 0.0, collision_detection_ratio = 0.0;
  double payload = 0.0;
  Vector3 payload_cog = Vector3::Zero();
  Vector6 payload_inertia = Vector6::Zero();
  Registers input, output;

  // Not RTDE fields.
  bool program_running = false, program_paused = false;
  bool protective_stopped = false;
  bool freedrive = false, force_mode = false;
};

}  // namespace tactus::ur
