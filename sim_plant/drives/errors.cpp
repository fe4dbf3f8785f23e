#include "sim_plant/drives/errors.hpp"

namespace tactus::drives {
namespace {

constexpr Slot kRegister = slot_of(can::kErrorRegister), kHistory = slot_of(can::kErrorHistory);

/// Bits of the error register (CiA 301, 7.5.2.2).
std::uint8_t register_bits(std::uint16_t code) {
  constexpr std::uint8_t kGeneric = 0x01;
  switch (code >> 12) {
    case 0x2: return kGeneric | 0x02;
    case 0x3: return kGeneric | 0x04;
    case 0x4: return kGeneric | 0x08;
    case 0x8: return code < 0x8300 || code == kSyncMissing ? kGeneric | 0x10 : kGeneric | 0x20;
    case 0xF: return kGeneric | 0x80;
    default: return kGeneric;
  }
}

}  // namespace

bool ends_by_itself(std::uint16_t code) {
  return code == kHeartbeatLost || code == kPdoTooShort || code == kPdoTooLong ||
         code == kSyncLength || code == kRpdoTimeout || code == kSyncMissing;
}

bool Errors::present(std::uint16_t code) const {
  for (std::size_t i = 0; i < count_; ++i)
    if (codes_[i] == code) return true;
  return false;
}

std::uint16_t Errors::first_latched() const {
  for (std::size_t i = 0; i < count_; ++i)
    if (!ends_by_itself(codes_[i])) return codes_[i];
  return 0;
}

std::uint8_t Errors::update_register(Dictionary& dictionary) const {
  std::uint8_t bits = 0;
  for (std::size_t i = 0; i < count_; ++i) bits |= register_bits(codes_[i]);
  dictionary.set(kRegister, bits);
  return bits;
}

bool Errors::raise(std::uint16_t code, Dictionary& dictionary, can::Emergency& emergency) {
  if (present(code) || count_ == codes_.size()) return false;
  codes_[count_++] = code;
  emergency = {code, update_register(dictionary)};
  for (Slot i = kErrorsKept; i > 1; --i)
    dictionary.set(static_cast<Slot>(kHistory + i),
                   dictionary.get(static_cast<Slot>(kHistory + i - 1)));
  dictionary.set(kHistory + 1, code);
  const std::int64_t kept = dictionary.get(kHistory);
  dictionary.set(kHistory, kept < kErrorsKept ? kept + 1 : kErrorsKept);
  return true;
}

bool Errors::clear(std::uint16_t code, Dictionary& dictionary, can::Emergency& emergency) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (codes_[i] != code) continue;
    --count_;
    for (std::size_t j = i; j < count_; ++j) codes_[j] = codes_[j + 1];
    emergency = {0, update_register(dictionary)};
    return true;
  }
  return false;
}

}  // namespace tactus::drives
