#include "sim_plant/ur/wire/state_messages.hpp"

#include <functional>
#include <string_view>

namespace tactus::ur {
namespace {

template <class Values>
void put(const Values& values, ByteWriter& writer) {
  for (const double value : values) writer.f64(value);
}

void put_zeros(int count, ByteWriter& writer) {
  for (int i = 0; i < count; ++i) writer.f64(0.0);
}

/// Returns a checksum of a joint's parameters: the manufacturer's own rule is not published.
std::uint32_t checksum(const DhTable& dh, std::size_t joint) {
  std::array<std::uint8_t, 32> bytes;
  ByteWriter numbers(bytes.data(), bytes.size());
  put(std::array{dh.theta[joint], dh.a[joint], dh.d[joint], dh.alpha[joint]}, numbers);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return static_cast<std::uint32_t>(std::hash<std::string_view>()(text));
}

enum Control : std::uint8_t { kPosition = 0, kTeach = 1, kForce = 2 };

float single(double value) {
  return static_cast<float>(value);
}

void write_mode(const Image& image, const Version& version, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kRobotMode, writer);
  writer.u64(static_cast<std::uint64_t>(image.timestamp * 1e6 + 0.5));
  const bool powered = (image.robot_status_bits & kPowerOnBit) != 0;
  for (const bool flag : {true, true, powered, false, image.protective_stopped,
                          image.program_running, image.program_paused})
    writer.u8(flag ? 1 : 0);
  writer.u8(static_cast<std::uint8_t>(image.robot_mode));
  writer.u8(image.freedrive ? kTeach : image.force_mode ? kForce : kPosition);
  writer.f64(image.target_speed_fraction);
  writer.f64(image.speed_scaling);
  if (version.at_least(3, 2)) writer.f64(1.0);  // limit of the fraction
  if (version.at_least(3, 5)) writer.u8(0);
  end_part(at, writer);
}

void write_joints(const Image& image, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kJoints, writer);
  for (int i = 0; i < 6; ++i) {
    writer.f64(image.actual_q[i]);
    writer.f64(image.target_q[i]);
    writer.f64(image.actual_qd[i]);
    writer.f32(single(image.actual_current[i]));
    writer.f32(single(image.actual_joint_voltage[i]));
    writer.f32(single(image.joint_temperatures[i]));
    writer.f32(0.0f);
    writer.u8(static_cast<std::uint8_t>(image.joint_mode[static_cast<std::size_t>(i)]));
  }
  end_part(at, writer);
}

void write_tool(const Image& image, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kTool, writer);
  writer.u8(static_cast<std::uint8_t>(image.tool_analog_input_types & 1u));
  writer.u8(static_cast<std::uint8_t>(image.tool_analog_input_types >> 1 & 1u));
  writer.f64(image.tool_analog_input0);
  writer.f64(image.tool_analog_input1);
  writer.f32(48.0f);
  writer.u8(static_cast<std::uint8_t>(image.tool_output_voltage));
  writer.f32(single(image.tool_output_current));
  writer.f32(single(image.tool_temperature));
  writer.u8(static_cast<std::uint8_t>(image.tool_mode));
  end_part(at, writer);
}

void write_masterboard(const Image& image, const Version& version, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kMasterboard, writer);
  writer.u32(static_cast<std::uint32_t>(image.actual_digital_input_bits));
  writer.u32(static_cast<std::uint32_t>(image.actual_digital_output_bits));
  for (int i = 0; i < 2; ++i) writer.u8(static_cast<std::uint8_t>(image.analog_io_types >> i & 1));
  writer.f64(image.standard_analog_input0);
  writer.f64(image.standard_analog_input1);
  for (int i = 2; i < 4; ++i) writer.u8(static_cast<std::uint8_t>(image.analog_io_types >> i & 1));
  writer.f64(image.standard_analog_output0);
  writer.f64(image.standard_analog_output1);
  writer.f32(35.0f);
  writer.f32(single(image.actual_robot_voltage));
  writer.f32(single(image.actual_robot_current));
  writer.f32(single(image.io_current));
  writer.u8(static_cast<std::uint8_t>(image.safety_mode));
  writer.u8(image.safety_mode == static_cast<int>(SafetyMode::kReduced) ? 1 : 0);
  writer.u8(0);  // no Euromap 67
  writer.u32(0);
  if (version.at_least(3, 2)) writer.zeros(2);  // operational mode, three-position switch
  if (version.at_least(3, 5)) writer.u8(0);
  end_part(at, writer);
}

void write_cartesian(const Image& image, const Version& version, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kCartesian, writer);
  put(image.actual_tcp_pose, writer);
  if (version.at_least(3, 2)) put(image.tcp_offset, writer);
  end_part(at, writer);
}

void write_force_mode(const Image& image, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kForceMode, writer);
  put(image.actual_tcp_force, writer);
  writer.f64(0.0);  // dexterity
  end_part(at, writer);
}

void write_additional(const Image& image, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kAdditional, writer);
  writer.u8(0);                        // teach button pressed
  writer.u8(1);                        // teach button enabled
  writer.u8(image.freedrive ? 1 : 0);  // input and output of freedrive
  writer.u8(0);
  end_part(at, writer);
}

}  // namespace

void write_realtime(const Image& image, const Version& version, ByteWriter& writer) {
  writer.u32(static_cast<std::uint32_t>(realtime_size(version)));
  writer.f64(image.timestamp);
  for (const Joints* joints :
       {&image.target_q, &image.target_qd, &image.target_qdd, &image.target_current,
        &image.target_moment, &image.actual_q, &image.actual_qd, &image.actual_current,
        &image.joint_control_output, &image.actual_tcp_pose, &image.actual_tcp_speed,
        &image.actual_tcp_force, &image.target_tcp_pose, &image.target_tcp_speed})
    put(*joints, writer);
  writer.f64(static_cast<double>(image.actual_digital_input_bits));
  put(image.joint_temperatures, writer);
  writer.f64(image.actual_execution_time);
  writer.f64(0.0);  // test value
  writer.f64(image.robot_mode);
  for (const std::int32_t mode : image.joint_mode) writer.f64(mode);
  writer.f64(image.safety_mode);
  put_zeros(6, writer);
  put(image.actual_tool_accelerometer, writer);
  put_zeros(6, writer);
  writer.f64(image.speed_scaling);
  writer.f64(image.actual_momentum);
  put_zeros(2, writer);
  writer.f64(image.actual_main_voltage);
  writer.f64(image.actual_robot_voltage);
  writer.f64(image.actual_robot_current);
  put(image.actual_joint_voltage, writer);
  if (version.at_least(3, 2)) {
    writer.f64(static_cast<double>(image.actual_digital_output_bits));
    writer.f64(image.runtime_state);
  }
  if (version.at_least(3, 5)) {
    put(image.elbow_position, writer);
    put(image.elbow_velocity, writer);
  }
  if (version.at_least(3, 10)) writer.f64(image.safety_status);
  if (version.at_least(5, 9)) put_zeros(3, writer);  // for the manufacturer's own use
  if (version.at_least(5, 10)) {
    writer.f64(image.payload);
    put(image.payload_cog, writer);
    put_zeros(6, writer);  // inertia
  }
}

void write_robot_state(const Image& image, const Version& version, const DhTable& dh, bool whole,
                       ByteWriter& writer) {
  const std::size_t at = writer.size();
  writer.u32(0);
  writer.i8(static_cast<std::int8_t>(StateType::kRobotState));
  write_mode(image, version, writer);
  write_joints(image, writer);
  write_cartesian(image, version, writer);
  if (whole && version.at_least(3, 6)) write_kinematics(dh, writer);
  if (whole) write_configuration(writer);
  write_masterboard(image, version, writer);
  write_tool(image, writer);
  write_force_mode(image, writer);
  write_additional(image, writer);
  writer.set_u32(at, writer.size() - at);
}

void write_kinematics(const DhTable& dh, ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kKinematics, writer);
  for (std::size_t i = 0; i < 6; ++i) writer.u32(checksum(dh, i));
  put(dh.theta, writer);
  put(dh.a, writer);
  put(dh.d, writer);
  put(dh.alpha, writer);
  writer.u32(dh.calibrated ? kLinearised : kNotCalibrated);
  end_part(at, writer);
}

void write_configuration(ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kConfiguration, writer);
  for (int i = 0; i < 6; ++i) {
    writer.f64(-363.0 * kDegree);
    writer.f64(363.0 * kDegree);
  }
  for (int i = 0; i < 6; ++i) {
    writer.f64((i < 2 ? 131.46 : 191.46) * kDegree);
    writer.f64(40.0);
  }
  for (const double value : {1.05, 1.4, 0.25, 1.2, 0.5}) writer.f64(value);
  put(kDh.a, writer);
  put(kDh.d, writer);
  put(kDh.alpha, writer);
  put_zeros(6, writer);
  writer.i32(4);  // masterboard
  writer.i32(1);  // controller box
  writer.i32(kRobotTypeUr10);
  writer.i32(0);
  end_part(at, writer);
}

}  // namespace tactus::ur
