// ObjectAccess: reads and writes objects for SDO with the rules of CiA 301 and 402, and says what
// is wrong by the abort code of the standard.
#pragma once

#include <array>

#include "hal/can/protocol_canopen.hpp"
#include "hal/can/protocol_sdo.hpp"
#include "sim_plant/drives/dictionary.hpp"

namespace tactus::drives {

/// What decides whether an object may be written now.
struct DeviceState {
  can::NmtState nmt = can::NmtState::kBootUp;
  bool powered = false;       ///< operation enabled, or a stop from there
  std::size_t pdo_bytes = 8;  ///< the longest PDO: 64 with CAN FD
};

inline constexpr std::size_t kMaxObject = 64;  ///< bytes of the longest text

struct ObjectBytes {
  std::array<std::uint8_t, kMaxObject> data{};
  std::size_t size = 0;
};

/// Reads an object. [any]
can::SdoAbort read_object(const Dictionary& dictionary, std::uint16_t index, std::uint8_t sub,
                          ObjectBytes& bytes);

/// Judges and writes an object. On an abort nothing has changed. [any]
can::SdoAbort write_object(Dictionary& dictionary, const DeviceState& state, std::uint16_t index,
                           std::uint8_t sub, const std::uint8_t* data, std::size_t size);

/// Judges a write as far as index, sub-index, access and size go; `size` 0: not known. [any]
can::SdoAbort judge_access(std::uint16_t index, std::uint8_t sub, std::size_t size);

/// True for the modes of the drive, homing, CSP, CSV, CST, and for "no mode". [any]
bool has_mode(std::int64_t mode);

/// True if PDO number `n` (0 to 3) of the records at `communication` exists. [any]
inline bool is_valid_pdo(const Dictionary& dictionary, std::uint16_t communication) {
  return (dictionary.get(find(communication, can::kPdoId).slot) & kInvalid) == 0;
}

/// The judgement of an entry of a mapping, and its length in bytes. [any]
struct MappedEntry {
  can::SdoAbort abort = can::SdoAbort::kNone;
  std::size_t bytes = 0;
  const Row* row = nullptr;  ///< null: a dummy entry
  Slot slot = kNoSlot;
};
MappedEntry judge_entry(std::uint32_t entry, bool receives);

}  // namespace tactus::drives
