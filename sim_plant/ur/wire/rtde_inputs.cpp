#include "sim_plant/ur/wire/rtde_fields.hpp"

namespace tactus::ur {
namespace {

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

}  // namespace

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
  field.type = parsed.kind == Input::kBits   ? FieldType::kUint32
               : parsed.kind == Input::kBit  ? FieldType::kBool
               : parsed.kind == Input::kInts ? FieldType::kInt32
                                             : FieldType::kDouble;
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

}  // namespace tactus::ur
