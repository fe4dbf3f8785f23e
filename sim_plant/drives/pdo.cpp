#include "sim_plant/drives/pdo.hpp"

namespace tactus::drives {

void PdoSettings::load(const Dictionary& dictionary, std::uint16_t communication,
                       std::uint16_t mapping) {
  const auto read = [&](std::uint16_t index, std::uint8_t sub) {
    const Found found = find(index, sub);
    return found.row != nullptr ? dictionary.get(found.slot) : 0;
  };
  const bool receives = communication < can::kTpdoCommunication;
  const std::int64_t cob = read(communication, can::kPdoId);
  remote = !receives && (cob & kNoRemote) == 0;
  id = static_cast<std::uint16_t>(cob & 0x7FF);
  type = static_cast<std::uint8_t>(read(communication, can::kPdoType));
  start = static_cast<std::uint8_t>(read(communication, 6));
  inhibit_ns = read(communication, can::kPdoInhibitTime) * 100'000;
  event_ns = read(communication, can::kPdoEventTimer) * 1'000'000;
  count = static_cast<int>(read(mapping, 0));
  valid = (cob & kInvalid) == 0 && count > 0;
  bytes = 0;
  const Slot first = find(mapping, 0).slot;
  for (int i = 0; i < count; ++i) {
    const auto entry = dictionary.get(static_cast<Slot>(first + 1 + i));
    entries[static_cast<std::size_t>(i)] = judge_entry(static_cast<std::uint32_t>(entry), receives);
    bytes += entries[static_cast<std::size_t>(i)].bytes;
  }
}

std::array<std::uint8_t, can::kMaxData> pack(const Dictionary& dictionary, const PdoSettings& pdo) {
  std::array<std::uint8_t, can::kMaxData> data{};
  std::size_t at = 0;
  for (int i = 0; i < pdo.count; ++i) {
    const MappedEntry& entry = pdo.entries[static_cast<std::size_t>(i)];
    if (entry.row != nullptr) encode(entry.row->type, dictionary.get(entry.slot), data.data() + at);
    at += entry.bytes;
  }
  return data;
}

}  // namespace tactus::drives
