// Fuzzes the fields of a data package, the types of a recipe, and the robot's modes. An accepted
// field must give the same bytes when it is written again.
#include "hal/ur/ur_state.hpp"
#include "tests/fuzz/fuzzing.hpp"

#include <array>
#include <cstring>

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr std::size_t kFieldBytes = 8 * (1 + 6 * 6 + 2) + 4 * 5;
constexpr std::size_t kToolBytes = 8 * (6 + 1 + 3);

void write(const UrState& state, bool tool, ByteWriter& out) {
  out.f64(state.timestamp_s);
  for (const Vector6* six :
       {&state.target_q, &state.q, &state.dq, &state.moment, &state.tcp_pose, &state.tcp_force})
    for (const double value : *six) out.f64(value);
  out.f64(state.speed_scaling);
  out.f64(state.speed_fraction);
  out.i32(state.robot_mode);
  out.i32(state.safety_mode);
  out.i32(state.echo);
  out.u32(state.safety_bits);
  out.u32(state.runtime_state);
  if (!tool) return;
  for (const double value : state.tcp_offset) out.f64(value);
  out.f64(state.payload_kg);
  for (const double value : state.payload_com) out.f64(value);
}

bool all_finite(const std::uint8_t* data, bool tool) {
  ByteReader in(data, kFieldBytes + kToolBytes);
  bool finite = true;
  for (std::size_t i = 0; i < 1 + 6 * 6 + 2; ++i) finite = std::isfinite(in.f64()) && finite;
  for (std::size_t i = 0; i < 5; ++i) in.u32();
  for (std::size_t i = 0; tool && i < 6 + 1 + 3; ++i) finite = std::isfinite(in.f64()) && finite;
  return finite;
}

/// With the fields of the tool, or without.
void decode(const std::uint8_t* data, std::size_t size, bool tool) {
  const std::size_t expected = kFieldBytes + (tool ? kToolBytes : 0);
  UrState state;
  state.echo = 4711;
  Message why;
  ByteReader in(data, size);
  const Status status = decode_state(in, {tool, tool, tool}, state, why);
  MUST((status == Status::kOk) == (size == expected && all_finite(data, tool)));
  if (status == Status::kOk) {
    std::array<std::uint8_t, kFieldBytes + kToolBytes> bytes;
    ByteWriter out(bytes.data(), bytes.size());
    write(state, tool, out);
    MUST(out.size() == size && std::memcmp(bytes.data(), data, size) == 0);
    const Status modes = judge_modes(state, why);
    if (modes == Status::kOk) MUST(state.running() && state.safety_mode <= 2);
    if (modes != Status::kOk) MUST(!std::string_view(why).empty());
  } else {
    MUST(state.echo == 4711 && !std::string_view(why).empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const bool tool : {false, true}) decode(data, size, tool);
  Message why;
  const std::string_view types(reinterpret_cast<const char*>(data), size);
  for (std::size_t count : {kOutputFields.size(), kInputFields.size()}) {
    const RecipeField* fields =
        count == kOutputFields.size() ? kOutputFields.data() : kInputFields.data();
    const Status checked = check_types(types, fields, count, why);
    const auto commas = static_cast<std::size_t>(std::count(types.begin(), types.end(), ','));
    if (checked == Status::kOk)
      MUST(commas == count - 1 || (commas == count && types.back() == ','));
  }
  return 0;
}
