#include "sim_plant/ur/wire/rtde_fields.hpp"

#include <variant>

namespace tactus::ur {
namespace {

bool eat(std::string_view& text, std::string_view word) {
  if (text.substr(0, word.size()) != word) return false;
  text.remove_prefix(word.size());
  return true;
}

/// Returns the number that a text of up to three digits is; -1 for other texts.
int number(std::string_view text) {
  if (text.empty() || text.size() > 3 || (text.size() > 1 && text[0] == '0')) return -1;
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return -1;
    value = 10 * value + (c - '0');
  }
  return value;
}

struct InputRow {
  std::string_view name;
  FieldType type;
};

/// In the order of Input.
constexpr InputRow kInputRows[] = {
    {"speed_slider_mask", FieldType::kUint32},
    {"speed_slider_fraction", FieldType::kDouble},
    {"standard_digital_output_mask", FieldType::kUint8},
    {"standard_digital_output", FieldType::kUint8},
    {"configurable_digital_output_mask", FieldType::kUint8},
    {"configurable_digital_output", FieldType::kUint8},
    {"tool_digital_output_mask", FieldType::kUint8},
    {"tool_digital_output", FieldType::kUint8},
    {"standard_analog_output_mask", FieldType::kUint8},
    {"standard_analog_output_type", FieldType::kUint8},
    {"standard_analog_output_0", FieldType::kDouble},
    {"standard_analog_output_1", FieldType::kDouble},
    {"external_force_torque", FieldType::kVector6d},
};

using Member = std::variant<double Image::*, Vector6 Image::*, Vector3 Image::*,
                            std::int32_t Image::*, std::uint32_t Image::*, std::uint64_t Image::*,
                            std::array<std::int32_t, 6> Image::*>;

/// In the order of the alternatives of Member.
constexpr FieldType kTypes[] = {FieldType::kDouble,      FieldType::kVector6d, FieldType::kVector3d,
                                FieldType::kInt32,       FieldType::kUint32,   FieldType::kUint64,
                                FieldType::kVector6Int32};

struct OutputRow {
  std::string_view name;
  Member member;
  std::uint32_t minor = 0, bugfix = 0, major = 3;  ///< of the software that introduced it
};

constexpr OutputRow kOutputRows[] = {
    {"timestamp", &Image::timestamp},
    {"target_q", &Image::target_q},
    {"target_qd", &Image::target_qd},
    {"target_qdd", &Image::target_qdd},
    {"target_current", &Image::target_current},
    {"target_moment", &Image::target_moment},
    {"actual_q", &Image::actual_q},
    {"actual_qd", &Image::actual_qd},
    {"actual_current", &Image::actual_current},
    {"joint_control_output", &Image::joint_control_output},
    {"actual_TCP_pose", &Image::actual_tcp_pose},
    {"actual_TCP_speed", &Image::actual_tcp_speed},
    {"actual_TCP_force", &Image::actual_tcp_force},
    {"ft_raw_wrench", &Image::ft_raw_wrench, 9, 0, 5},
    {"target_TCP_pose", &Image::target_tcp_pose},
    {"target_TCP_speed", &Image::target_tcp_speed},
    {"actual_digital_input_bits", &Image::actual_digital_input_bits},
    {"joint_temperatures", &Image::joint_temperatures},
    {"actual_execution_time", &Image::actual_execution_time},
    {"robot_mode", &Image::robot_mode},
    {"joint_mode", &Image::joint_mode},
    {"safety_mode", &Image::safety_mode},
    {"safety_status", &Image::safety_status, 10},
    {"actual_tool_accelerometer", &Image::actual_tool_accelerometer},
    {"speed_scaling", &Image::speed_scaling},
    {"target_speed_fraction", &Image::target_speed_fraction},
    {"actual_momentum", &Image::actual_momentum},
    {"actual_main_voltage", &Image::actual_main_voltage},
    {"actual_robot_voltage", &Image::actual_robot_voltage},
    {"actual_robot_current", &Image::actual_robot_current},
    {"actual_joint_voltage", &Image::actual_joint_voltage},
    {"actual_digital_output_bits", &Image::actual_digital_output_bits},
    {"runtime_state", &Image::runtime_state},
    {"elbow_position", &Image::elbow_position, 5},
    {"elbow_velocity", &Image::elbow_velocity, 5},
    {"robot_status_bits", &Image::robot_status_bits},
    {"safety_status_bits", &Image::safety_status_bits},
    {"analog_io_types", &Image::analog_io_types},
    {"standard_analog_input0", &Image::standard_analog_input0},
    {"standard_analog_input1", &Image::standard_analog_input1},
    {"standard_analog_output0", &Image::standard_analog_output0},
    {"standard_analog_output1", &Image::standard_analog_output1},
    {"io_current", &Image::io_current},
    {"euromap67_input_bits", &Image::euromap67_input_bits},
    {"euromap67_output_bits", &Image::euromap67_output_bits},
    {"euromap67_24V_voltage", &Image::euromap67_24v_voltage},
    {"euromap67_24V_current", &Image::euromap67_24v_current},
    {"tool_mode", &Image::tool_mode},
    {"tool_analog_input_types", &Image::tool_analog_input_types},
    {"tool_analog_input0", &Image::tool_analog_input0},
    {"tool_analog_input1", &Image::tool_analog_input1},
    {"tool_output_voltage", &Image::tool_output_voltage},
    {"tool_output_current", &Image::tool_output_current},
    {"tool_temperature", &Image::tool_temperature},
    {"tcp_force_scalar", &Image::tcp_force_scalar},
    {"tcp_offset", &Image::tcp_offset, 12, 3},
    {"joint_position_deviation_ratio", &Image::joint_position_deviation_ratio},
    {"collision_detection_ratio", &Image::collision_detection_ratio},
    {"payload", &Image::payload, 14},
    {"payload_cog", &Image::payload_cog, 14},
    {"payload_inertia", &Image::payload_inertia, 15},
};
constexpr std::uint16_t kRegister = 0x8000;  // rows from this number on are registers
constexpr std::uint16_t kInputRegister = 0x0100;

struct Writer {
  ByteWriter& writer;

  void operator()(double value) const { writer.f64(value); }
  void operator()(std::int32_t value) const { writer.i32(value); }
  void operator()(std::uint32_t value) const { writer.u32(value); }
  void operator()(std::uint64_t value) const { writer.u64(value); }
  void operator()(const Vector6& v) const {
    for (int i = 0; i < 6; ++i) writer.f64(v[i]);
  }
  void operator()(const Vector3& v) const {
    for (int i = 0; i < 3; ++i) writer.f64(v[i]);
  }
  void operator()(const std::array<std::int32_t, 6>& v) const {
    for (const std::int32_t value : v) writer.i32(value);
  }
};

FieldType type_of(Input kind) {
  switch (kind) {
    case Input::kBits: return FieldType::kUint32;
    case Input::kBit: return FieldType::kBool;
    case Input::kInts: return FieldType::kInt32;
    default: return FieldType::kDouble;
  }
}

void write_register(const Registers& registers, Input kind, std::size_t i, ByteWriter& writer) {
  if (kind == Input::kBits) writer.u32(registers.bits[i]);
  if (kind == Input::kBit) writer.u8(registers.bit(static_cast<int>(i)) ? 1 : 0);
  if (kind == Input::kInts) writer.i32(registers.ints[i]);
  if (kind == Input::kDoubles) writer.f64(registers.doubles[i]);
}

}  // namespace

bool parse_register(std::string_view name, const Version& version, RegisterName& parsed) {
  const int registers = version.at_least(3, 9) ? kRegisters : kRegisters / 2;
  parsed.input = name.substr(0, 6) == "input_";
  if (!eat(name, "input_") && !eat(name, "output_")) return false;
  if (name == "bit_registers0_to_31" || name == "bit_registers32_to_63") {
    parsed.kind = Input::kBits;
    parsed.index = name == "bit_registers0_to_31" ? 0 : 1;
    return true;
  }
  if (eat(name, "bit_register_")) {
    parsed.kind = Input::kBit;
    parsed.index = number(name);
    return version.at_least(3, 9) && parsed.index >= 64 && parsed.index < kBitRegisters;
  }
  if (eat(name, "int_register_")) {
    parsed.kind = Input::kInts;
  } else if (eat(name, "double_register_")) {
    parsed.kind = Input::kDoubles;
  } else {
    return false;
  }
  parsed.index = number(name);
  return parsed.index >= 0 && parsed.index < registers;
}

InputField find_input(std::string_view name, const Version& version) {
  InputField field;
  for (const InputRow& row : kInputRows) {
    if (row.name != name) continue;
    field.type = row.type;
    field.input = static_cast<Input>(&row - kInputRows);
    return field;
  }
  RegisterName parsed;
  if (!parse_register(name, version, parsed) || !parsed.input) return field;
  field.input = parsed.kind;
  field.index = static_cast<std::uint8_t>(parsed.index);
  field.type = type_of(parsed.kind);
  return field;
}

std::size_t InputField::variable() const {
  constexpr std::size_t kSingles = std::size(kInputRows);
  switch (input) {
    case Input::kBits: return kSingles + index;
    case Input::kBit: return kSingles + 4 + index;
    case Input::kInts: return kSingles + 4 + kBitRegisters + index;
    case Input::kDoubles: return kSingles + 4 + kBitRegisters + kRegisters + index;
    default: return static_cast<std::size_t>(input);
  }
}

OutputField find_output(std::string_view name, const Version& version) {
  OutputField field;
  for (const OutputRow& row : kOutputRows) {
    if (row.name != name) continue;
    if (!version.at_least(row.major, row.minor, row.bugfix)) return field;
    field.type = kTypes[row.member.index()];
    field.row = static_cast<std::uint16_t>(&row - kOutputRows);
    return field;
  }
  RegisterName parsed;
  if (!parse_register(name, version, parsed)) return field;
  field.type = type_of(parsed.kind);
  field.row = static_cast<std::uint16_t>(kRegister | (parsed.input ? kInputRegister : 0u) |
                                         static_cast<unsigned>(parsed.kind));
  field.index = static_cast<std::uint16_t>(parsed.index);
  return field;
}

void OutputField::write(const Image& image, ByteWriter& writer) const {
  if (row >= kRegister) {
    const Registers& registers = (row & kInputRegister) != 0 ? image.input : image.output;
    write_register(registers, static_cast<Input>(row & 0xff), index, writer);
    return;
  }
  std::visit([&](auto member) { Writer{writer}(image.*member); }, kOutputRows[row].member);
}

}  // namespace tactus::ur
