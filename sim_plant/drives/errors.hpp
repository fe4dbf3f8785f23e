// Errors: the errors of a drive that are present, its error register 1001h, history 1003h and the
// EMCY messages about them (CiA 301, 7.2.7).
#pragma once

#include <array>

#include "hal/can/protocol_canopen.hpp"
#include "sim_plant/drives/dictionary.hpp"

namespace tactus::drives {

// Codes that are not the drive's own.
inline constexpr std::uint16_t kCommunicationLost = 0x8100, kHeartbeatLost = 0x8130,
                               kPdoTooShort = 0x8210, kPdoTooLong = 0x8220, kSyncLength = 0x8240,
                               kRpdoTimeout = 0x8250, kSyncMissing = 0x8700;

class Errors {
 public:
  void reset() { *this = {}; }

  /// Notes an error. Returns true, and the EMCY, if it was not present before. [any]
  bool raise(std::uint16_t code, Dictionary& dictionary, can::Emergency& emergency);
  /// Takes an error back. Returns true, and the EMCY, if it was present. [any]
  bool clear(std::uint16_t code, Dictionary& dictionary, can::Emergency& emergency);

  bool present(std::uint16_t code) const;
  bool any() const { return count_ > 0; }
  std::uint16_t first() const { return count_ > 0 ? codes_[0] : std::uint16_t{0}; }
  /// The first error that fault reset clears: all but those whose cause is seen to end. 0: none.
  std::uint16_t first_latched() const;

 private:
  std::uint8_t update_register(Dictionary& dictionary) const;

  std::array<std::uint16_t, 16> codes_{};
  std::size_t count_ = 0;
};

/// True for errors that end by themselves when frames come again. [any]
bool ends_by_itself(std::uint16_t code);

}  // namespace tactus::drives
