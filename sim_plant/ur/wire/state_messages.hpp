// Writes the packets of the state ports from the image.
#pragma once

#include "sim_plant/ur/wire/image.hpp"

namespace tactus::ur {

/// Writes the packet of port 30003, one per cycle.
void write_realtime(const Image& image, const Version& version, ByteWriter& writer);

/// Writes the state of the robot for ports 30001 and 30002, ten times a second. `whole`: includes
/// the parts that do not change, for a client that has just connected; `dh` is what it tells of the
/// kinematics.
void write_robot_state(const Image& image, const Version& version, const DhTable& dh, bool whole,
                       ByteWriter& writer);

/// Write the parts of the state that describe the arm: kinematics; limits and type.
void write_kinematics(const DhTable& dh, ByteWriter& writer);
void write_configuration(ByteWriter& writer);

/// Begins a part of a robot state; end_part() writes its length.
inline std::size_t begin_part(StatePart part, ByteWriter& writer) {
  const std::size_t at = writer.size();
  writer.u32(0);
  writer.u8(static_cast<std::uint8_t>(part));
  return at;
}
inline void end_part(std::size_t at, ByteWriter& writer) {
  writer.set_u32(at, writer.size() - at);
}

}  // namespace tactus::ur
