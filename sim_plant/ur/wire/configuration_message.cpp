#include "sim_plant/ur/motion/kinematics.hpp"
#include "sim_plant/ur/wire/state_messages.hpp"

namespace tactus::ur {
namespace {

void put(const std::array<double, 6>& values, ByteWriter& writer) {
  for (const double value : values) writer.f64(value);
}

}  // namespace

void write_kinematics(ByteWriter& writer) {
  const std::size_t at = begin_part(StatePart::kKinematics, writer);
  // A checksum of each joint's parameters, made up: the kinematics are not calibrated.
  for (std::uint32_t i = 0; i < 6; ++i) writer.u32(0x10c30000u + i);
  put({}, writer);
  put(kDh.a, writer);
  put(kDh.d, writer);
  put(kDh.alpha, writer);
  writer.u32(0);  // not calibrated
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
  put({}, writer);
  writer.i32(4);  // masterboard
  writer.i32(1);  // controller box
  writer.i32(kRobotTypeUr10);
  writer.i32(0);
  end_part(at, writer);
}

}  // namespace tactus::ur
