// SiiImage: the EEPROM of an emulated drive: identity, mailboxes, categories (ETG.1000.6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus::segment {

/// Places of the sync managers in the memory of the controller, one after the other.
struct SmPlaces {
  static constexpr int kLongestMailbox = 2048;  ///< bytes; more than a frame has room for

  std::uint16_t mailbox_out = 0x1000, mailbox_in = 0x1100, outputs = 0x1200, inputs = 0x1400;
  std::uint16_t mailbox_out_bytes = 128, mailbox_in_bytes = 128;

  /// With mailboxes of 0 to kLongestMailbox bytes, of requests and of answers. [init]
  static constexpr SmPlaces with_mailboxes(int out_bytes, int in_bytes) {
    constexpr int kStep = 0x100;
    const auto behind = [](int at, int bytes) {
      return at + (bytes <= kStep ? kStep : (bytes + kStep - 1) / kStep * kStep);
    };
    SmPlaces places;
    places.mailbox_out_bytes = static_cast<std::uint16_t>(out_bytes);
    places.mailbox_in_bytes = static_cast<std::uint16_t>(in_bytes);
    places.mailbox_in = static_cast<std::uint16_t>(behind(places.mailbox_out, out_bytes));
    places.outputs = static_cast<std::uint16_t>(behind(places.mailbox_in, in_bytes));
    places.inputs = static_cast<std::uint16_t>(places.outputs + 2 * kStep);
    return places;
  }
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
