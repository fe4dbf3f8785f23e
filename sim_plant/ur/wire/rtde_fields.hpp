// The fields of RTDE: name, type, and place of an output in the image.
#pragma once

#include <string_view>

#include "sim_plant/ur/wire/image.hpp"

namespace tactus::ur {

/// One field of an output recipe.
struct OutputField {
  FieldType type = FieldType::kNotFound;
  std::uint16_t row = 0;    ///< of the table
  std::uint16_t index = 0;  ///< of a register

  void write(const Image& image, ByteWriter& writer) const;
};

/// Finds an output; its type is kNotFound if this version of the software does not have it.
OutputField find_output(std::string_view name, const Version& version);

/// The inputs that a client may write.
enum class Input : std::uint8_t {
  kSpeedSliderMask,
  kSpeedSliderFraction,
  kStandardDigitalOutputMask,
  kStandardDigitalOutput,
  kConfigurableDigitalOutputMask,
  kConfigurableDigitalOutput,
  kToolDigitalOutputMask,
  kToolDigitalOutput,
  kStandardAnalogOutputMask,
  kStandardAnalogOutputType,
  kStandardAnalogOutput0,
  kStandardAnalogOutput1,
  kExternalForceTorque,
  kBits,     // index: group of 32 bits
  kBit,      // index: bit
  kInts,     // index
  kDoubles,  // index
};
inline constexpr std::size_t kInputVariables = 13 + 4 + 128 + 48 + 48;

struct InputField {
  FieldType type = FieldType::kNotFound;
  Input input = Input::kSpeedSliderMask;
  std::uint8_t index = 0;

  /// Returns the number of the variable, below kInputVariables.
  std::size_t variable() const;
};

InputField find_input(std::string_view name, const Version& version);

/// A register's name: "input_int_register_24" is kInts 24 of the input.
struct RegisterName {
  bool input = false;
  Input kind = Input::kBits;
  int index = 0;
};
bool parse_register(std::string_view name, const Version& version, RegisterName& parsed);

}  // namespace tactus::ur
