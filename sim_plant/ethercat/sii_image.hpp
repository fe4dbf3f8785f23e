// SiiImage: the EEPROM of an emulated drive: identity, mailboxes, categories (ETG.1000.6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus::segment {

/// Places of the sync managers in the memory of the controller.
struct SmPlaces {
  std::uint16_t mailbox_out = 0x1000, mailbox_in = 0x1100, mailbox_bytes = 128;
  std::uint16_t outputs = 0x1200, inputs = 0x1400;
};

struct SiiIdentity {
  std::uint32_t vendor = 0, product = 0, revision = 0, serial = 0;
};

class SiiImage {
 public:
  static constexpr std::size_t kWords = 512;

  /// Writes identity, name, sync managers and the default PDOs of a drive. [init]
  void compose(const SiiIdentity& identity, const SmPlaces& places);

  /// A word; beyond the end as erased memory. [any]
  std::uint16_t word(std::uint32_t at) const { return at < kWords ? words_[at] : 0xFFFF; }

 private:
  void put8(std::uint8_t value);
  void put16(std::uint16_t value);
  void put32(std::size_t word, std::uint32_t value);
  void begin(std::uint16_t type);
  void end();
  void strings();
  void sync_managers(const SmPlaces& places);
  void pdo(bool receives);

  std::array<std::uint16_t, kWords> words_{};
  std::size_t at_ = 0, length_at_ = 0;  // bytes, and the word of the open category's length
};

}  // namespace tactus::segment
