#include "sim_plant/ur/wire/io.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

constexpr std::size_t at(Input input) {
  return static_cast<std::size_t>(input);
}

void write_register(const InputField& field, std::uint32_t number, double value, Registers& into) {
  if (field.input == Input::kBits) into.bits[field.index] = number;
  if (field.input == Input::kBit) into.set_bit(field.index, number != 0);
  if (field.input == Input::kInts) into.ints[field.index] = static_cast<std::int32_t>(number);
  if (field.input == Input::kDoubles) into.doubles[field.index] = value;
}

}  // namespace

void Io::set_analog(int i, double ratio) {
  const bool voltage = (analog_types >> (2 + i) & 1u) != 0;
  ratio = ratio > 0.0 ? std::min(ratio, 1.0) : 0.0;  // NaN too
  analog_outputs[static_cast<std::size_t>(i)] = voltage ? 10.0 * ratio : 0.004 + 0.016 * ratio;
}

bool InputPackage::read(const InputField& field, ByteReader& reader) {
  std::uint32_t number = 0;
  double value = 0.0;
  bool finite = true;
  switch (field.type) {
    case FieldType::kBool:
    case FieldType::kUint8: number = reader.u8(); break;
    case FieldType::kUint32:
    case FieldType::kInt32: number = reader.u32(); break;
    case FieldType::kVector6d:
      for (int i = 0; i < 6; ++i) finite = std::isfinite(reader.f64()) && finite;
      return finite;  // of a wrench that nothing uses
    default: value = reader.f64(); finite = std::isfinite(value);
  }
  if (field.input >= Input::kBits) {
    if (count_ < writes_.size()) writes_[count_++] = {field, number, value};
    return true;  // a register may hold NaN
  }
  if (!finite) return false;
  bytes_[at(field.input)] = static_cast<std::uint8_t>(number);
  if (field.input == Input::kSpeedSliderMask) slider_mask_ = number;
  if (field.input == Input::kSpeedSliderFraction) slider_ = value;
  if (field.input == Input::kStandardAnalogOutput0) analog_[0] = value;
  if (field.input == Input::kStandardAnalogOutput1) analog_[1] = value;
  return true;
}

void InputPackage::apply(Io& io, std::int64_t cycle) const {
  for (std::size_t i = 0; i < count_; ++i) {
    write_register(writes_[i].field, writes_[i].number, writes_[i].value, io.input);
    io.written[writes_[i].field.variable()] = cycle;
  }
  if (slider_mask_ == 1) io.speed_fraction = std::clamp(slider_, 0.0, 1.0);
  struct Group {
    Input mask, value;
    int first, count;
  };
  constexpr Group kGroups[] = {
      {Input::kStandardDigitalOutputMask, Input::kStandardDigitalOutput, 0, 8},
      {Input::kConfigurableDigitalOutputMask, Input::kConfigurableDigitalOutput, 8, 8},
      {Input::kToolDigitalOutputMask, Input::kToolDigitalOutput, 16, 2}};
  for (const Group& group : kGroups)
    for (int i = 0; i < group.count; ++i)
      if (bytes_[at(group.mask)] >> i & 1)
        io.set_digital(group.first + i, (bytes_[at(group.value)] >> i & 1) != 0);
  for (int i = 0; i < 2; ++i) {
    if ((bytes_[at(Input::kStandardAnalogOutputMask)] >> i & 1) == 0) continue;
    const std::uint32_t bit = 4u << i;
    const bool voltage = (bytes_[at(Input::kStandardAnalogOutputType)] >> i & 1) != 0;
    io.analog_types = voltage ? io.analog_types | bit : io.analog_types & ~bit;
    io.set_analog(i, analog_[static_cast<std::size_t>(i)]);
  }
}

}  // namespace tactus::ur
