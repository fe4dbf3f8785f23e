// SetupStep: one object that is read from or written to a drive by SDO at the start-up, over any
// bus.
#pragma once

#include <cstdint>

namespace tactus::cia402 {

struct SetupStep {
  enum class Kind : std::uint8_t {
    kExpect,  ///< read; it must be `value`, in the bits of `mask`
    kWrite,
    kMayWrite,  ///< write; ignored if the drive does not have the object or refuses it
    kAwait,     ///< read until it is `value`
    kFact,      ///< read for DriveFacts, kFacts[`value`]; a drive may not have it
    kLines,     ///< the transfers of LineWriter
    kStore,     ///< write, and wait longer; left out if LineWriter has changed nothing
  };

  Kind kind = Kind::kExpect;
  std::uint8_t sub = 0, bytes = 0;
  std::uint16_t index = 0;
  std::uint32_t value = 0, mask = 0xFFFFFFFF;
  const char* what = "";    ///< the object in words
  const char* remedy = "";  ///< for a value that is not the expected one
  bool watches = false;     ///< the object stops the drive if this program ends

  bool reads() const {
    return kind != Kind::kWrite && kind != Kind::kMayWrite && kind != Kind::kStore;
  }
};

}  // namespace tactus::cia402
