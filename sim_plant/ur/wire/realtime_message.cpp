#include "sim_plant/ur/wire/state_messages.hpp"

namespace tactus::ur {
namespace {

template <class Vector>
void put(const Vector& v, ByteWriter& writer) {
  for (int i = 0; i < v.size(); ++i) writer.f64(v[i]);
}

void put_zeros(int count, ByteWriter& writer) {
  for (int i = 0; i < count; ++i) writer.f64(0.0);
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

}  // namespace tactus::ur
