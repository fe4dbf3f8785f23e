#include "sim_plant/ethercat/sii_image.hpp"

#include <string_view>

#include "hal/ethercat/protocol_esc.hpp"
#include "sim_plant/ethercat/default_pdos.hpp"

namespace tactus::segment {

using namespace ethercat;

namespace {

constexpr std::string_view kStrings[] = {"Tactus emulated servo drive", "Servo drives", "Outputs",
                                         "Inputs"};
constexpr std::uint8_t kNameString = 1, kGroupString = 2, kOutputsString = 3, kInputsString = 4;

/// CRC-8 of words 0 to 6: polynomial 07h, from FFh.
std::uint8_t checksum(const std::array<std::uint16_t, SiiImage::kWords>& words) {
  unsigned crc = 0xFF;
  for (std::size_t i = 0; i < 14; ++i) {
    crc ^= words[i / 2] >> (8 * (i % 2)) & 0xFFU;
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 0x80U) != 0 ? (crc << 1 ^ 0x07U) & 0xFFU : crc << 1;
  }
  return static_cast<std::uint8_t>(crc);
}

}  // namespace

void SiiImage::compose(const SiiIdentity& identity, const SmPlaces& places) {
  words_.fill(0);
  words_[0] = 0x0005;  // PDI: SPI slave
  words_[kSiiChecksum] = checksum(words_);
  put32(kSiiVendor, identity.vendor);
  put32(kSiiProduct, identity.product);
  put32(kSiiRevision, identity.revision);
  put32(kSiiSerial, identity.serial);
  words_[kSiiMailboxOut] = places.mailbox_out;
  words_[kSiiMailboxIn] = places.mailbox_in;
  words_[kSiiMailboxOut + 1] = places.mailbox_out_bytes;
  words_[kSiiMailboxIn + 1] = places.mailbox_in_bytes;
  words_[kSiiProtocols] = kSiiCoe;
  words_[kSiiSize] = kWords / 64 - 1;  // in kibibits, less one
  words_[kSiiVersion] = 1;
  at_ = 2 * std::size_t{kSiiCategories};
  strings();
  begin(kSiiGeneral);
  for (const std::uint8_t byte : {kGroupString, std::uint8_t{0}, std::uint8_t{0}, kNameString,
                                  std::uint8_t{0}, std::uint8_t{0x0F}})
    put8(byte);  // CoE: SDO and its information, assignment and mapping of PDOs
  for (int i = 6; i < 32; ++i) put8(0);
  end();
  begin(kSiiFmmus);
  for (const int use : {1, 2, 3, 0})
    put8(static_cast<std::uint8_t>(use));  // outputs, inputs, state of a mailbox
  end();
  sync_managers(places);
  pdo(false);
  pdo(true);
  put16(kSiiEnd);
}

void SiiImage::put8(std::uint8_t value) {
  const unsigned shifted = unsigned{value} << (8 * (at_ % 2));
  words_[at_ / 2] = static_cast<std::uint16_t>(words_[at_ / 2] | shifted);
  ++at_;
}
void SiiImage::put16(std::uint16_t value) {
  put8(static_cast<std::uint8_t>(value));
  put8(static_cast<std::uint8_t>(value >> 8));
}
void SiiImage::put32(std::size_t word, std::uint32_t value) {
  words_[word] = static_cast<std::uint16_t>(value);
  words_[word + 1] = static_cast<std::uint16_t>(value >> 16);
}
void SiiImage::begin(std::uint16_t type) {
  put16(type);
  length_at_ = at_ / 2;
  put16(0);
}
void SiiImage::end() {
  if (at_ % 2 != 0) put8(0);
  words_[length_at_] = static_cast<std::uint16_t>(at_ / 2 - length_at_ - 1);
}

void SiiImage::strings() {
  begin(kSiiStrings);
  put8(std::size(kStrings));
  for (const std::string_view text : kStrings) {
    put8(static_cast<std::uint8_t>(text.size()));
    for (const char c : text) put8(static_cast<std::uint8_t>(c));
  }
  end();
}

void SiiImage::sync_managers(const SmPlaces& places) {
  struct Row {
    std::uint16_t start, length;
    std::uint8_t control, use;
  };
  begin(kSiiSms);
  for (const Row& row :
       {Row{places.mailbox_out, places.mailbox_out_bytes, kMailboxOutControl, kSiiMailboxOutSm},
        Row{places.mailbox_in, places.mailbox_in_bytes, kMailboxInControl, kSiiMailboxInSm},
        Row{places.outputs, 8, kOutputsControl, kSiiOutputsSm},
        Row{places.inputs, 16, kInputsControl, kSiiInputsSm}}) {
    put16(row.start);
    put16(row.length);
    put8(row.control);
    put8(0);
    put8(kSmEnabled);
    put8(row.use);
  }
  end();
}

void SiiImage::pdo(bool receives) {
  const std::uint32_t* const entries = receives ? kDefaultOutputs.data() : kDefaultInputs.data();
  const std::size_t count = receives ? kDefaultOutputs.size() : kDefaultInputs.size();
  begin(receives ? kSiiRxPdos : kSiiTxPdos);
  put16(receives ? 0x1600 : 0x1A00);
  put8(static_cast<std::uint8_t>(count));
  put8(receives ? 2 : 3);  // sync manager
  put8(0);
  put8(receives ? kOutputsString : kInputsString);
  put16(0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = static_cast<std::uint8_t>(entries[i]);
    put16(static_cast<std::uint16_t>(entries[i] >> 16));
    put8(static_cast<std::uint8_t>(entries[i] >> 8));
    put8(0);
    put8(bits == 32 ? 0x04 : bits == 16 ? 0x03 : 0x02);  // type: INT32, INT16, INT8
    put8(bits);
    put16(0);
  }
  end();
}

}  // namespace tactus::segment
