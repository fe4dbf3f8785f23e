// What a controller made of bytes says in a data package, and how it fails.
#pragma once

#include <array>
#include <string_view>

#include "hal/ur/protocol.hpp"

namespace tactus::ur {

/// What a data package says; in the order of the HAL's recipe.
struct FakeImage {
  double timestamp_s = 100.0;
  std::array<double, 6> q = {0.0, -1.2, 1.2, -0.1, 1.57, 0.0};
  std::array<double, 6> dq{}, moment{}, tcp_pose{}, tcp_force{};
  double speed_scaling = 1.0, speed_fraction = 1.0;
  std::int32_t robot_mode = 7, safety_mode = 1, echo = 0;
  std::uint32_t safety_bits = 1, runtime_state = 1;
};

inline constexpr std::string_view kFakeOutputs =
    "DOUBLE,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D,DOUBLE,DOUBLE,INT32,INT32,INT32,"
    "UINT32,UINT32";
inline constexpr std::string_view kFakeInputs = "INT32,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE";

/// How it fails.
struct FakeFaults {
  int reset_at = 0;   ///< type of the request at which it closes the connection
  int silent_at = 0;  ///< likewise, at which it says nothing any more
  bool only_protocol_1 = false, refuses_start = false, refuses_program = false;
  bool drops_program = false, stops_on_program = false;
  std::uint32_t major = 3, minor = 15;
  std::string_view outputs = kFakeOutputs, inputs = kFakeInputs;
  int unlock_refusals = 0;
};

/// A data package, in version 1 or 2 of the protocol.
inline void write_image(const FakeImage& image, int protocol, ByteWriter& out) {
  out.u16(0), out.u8('U');
  if (protocol == 2) out.u8(1);
  out.f64(image.timestamp_s);
  for (const auto* six :
       {&image.q, &image.q, &image.dq, &image.moment, &image.tcp_pose, &image.tcp_force})
    for (const double value : *six) out.f64(value);
  out.f64(image.speed_scaling), out.f64(image.speed_fraction);
  out.i32(image.robot_mode), out.i32(image.safety_mode), out.i32(image.echo);
  out.u32(image.safety_bits), out.u32(image.runtime_state);
  out.set_u16(0, out.size());
}

}  // namespace tactus::ur
