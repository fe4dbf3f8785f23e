// RTDE, port 30004: packet types and field types. Universal Robots, "Real-Time Data Exchange (RTDE)
// Guide".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::ur {

enum class RtdeType : std::uint8_t {
  kRequestProtocolVersion = 86,  // 'V': u16 -> u8 accepted
  kGetUrcontrolVersion = 118,    // 'v': -> 4 u32
  kTextMessage = 77,             // 'M'
  kDataPackage = 85,             // 'U'
  kSetupOutputs = 79,            // 'O': v1 names -> types; v2 f64 Hz, names -> u8 recipe, types
  kSetupInputs = 73,             // 'I': names -> u8 recipe, types; recipe 0: refused
  kStart = 83,                   // 'S': -> u8 accepted
  kPause = 80,                   // 'P': -> u8 accepted
};

enum class RtdeLevel : std::uint8_t { kException = 0, kError = 1, kWarning = 2, kInfo = 3 };

enum class FieldType : std::uint8_t {
  kBool,
  kUint8,
  kUint32,
  kUint64,
  kInt32,
  kDouble,
  kVector3d,
  kVector6d,
  kVector6Int32,
  kVector6Uint32,
  // Given in place of a type:
  kNotFound,
  kInUse,
};

struct FieldTypeRow {
  std::string_view name;
  std::size_t size;  ///< bytes in a data package
};

/// In the order of FieldType.
inline constexpr std::array<FieldTypeRow, 12> kFieldTypes = {{{"BOOL", 1},
                                                              {"UINT8", 1},
                                                              {"UINT32", 4},
                                                              {"UINT64", 8},
                                                              {"INT32", 4},
                                                              {"DOUBLE", 8},
                                                              {"VECTOR3D", 24},
                                                              {"VECTOR6D", 48},
                                                              {"VECTOR6INT32", 24},
                                                              {"VECTOR6UINT32", 24},
                                                              {"NOT_FOUND", 0},
                                                              {"IN_USE", 0}}};

constexpr std::string_view name(FieldType type) {
  return kFieldTypes[static_cast<std::size_t>(type)].name;
}
constexpr std::size_t size_of(FieldType type) {
  return kFieldTypes[static_cast<std::size_t>(type)].size;
}

/// Cuts the next name off a list separated by commas. False if none is left; a comma at the end
/// adds no name.
constexpr bool next_name(std::string_view& list, std::string_view& name) {
  if (list.empty()) return false;
  const std::size_t comma = list.find(',');
  name = list.substr(0, comma);
  list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
  return true;
}

/// Lowest rate; the highest is one packet in every cycle of the controller.
inline constexpr double kRtdeSlowest_Hz = 1.0;

inline constexpr int kRegisters = 48;      ///< of integers, and of doubles, in either direction
inline constexpr int kBitRegisters = 128;  ///< in either direction

}  // namespace tactus::ur
