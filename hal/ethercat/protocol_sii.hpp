// SII, the slave information in the EEPROM of a slave (ETG.1000.6): words and categories. Both ends
// share them.
#pragma once

#include <cstdint>

namespace tactus::ethercat {

// Addresses of 16-bit words.
inline constexpr std::uint16_t kSiiChecksum = 0x07, kSiiVendor = 0x08, kSiiProduct = 0x0A,
                               kSiiRevision = 0x0C, kSiiSerial = 0x0E, kSiiMailboxOut = 0x18,
                               kSiiMailboxIn = 0x1A, kSiiProtocols = 0x1C, kSiiSize = 0x3E,
                               kSiiVersion = 0x3F, kSiiCategories = 0x40;
inline constexpr std::uint16_t kSiiCoe = 0x0004;  ///< of the protocols

// Types of categories; each begins with its type and the number of its words.
inline constexpr std::uint16_t kSiiStrings = 10, kSiiGeneral = 30, kSiiFmmus = 40, kSiiSms = 41,
                               kSiiTxPdos = 50, kSiiRxPdos = 51, kSiiEnd = 0xFFFF;
// Use of a sync manager, the last byte of its 8 in the category.
inline constexpr std::uint8_t kSiiMailboxOutSm = 1, kSiiMailboxInSm = 2, kSiiOutputsSm = 3,
                              kSiiInputsSm = 4;

}  // namespace tactus::ethercat
