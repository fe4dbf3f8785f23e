#include "hal/ethercat/slave_scan.hpp"

#include <algorithm>

#include "hal/net/printable.hpp"

namespace tactus::ethercat {

void SlaveScan::begin_count(std::int64_t now_ns) {
  stage_ = Stage::kCount;
  exchange_.ask(request(), now_ns);
}

void SlaveScan::begin(int position, std::int64_t now_ns) {
  stage_ = Stage::kStation;
  position_ = position;
  report_ = {};
  exchange_.ask(request(), now_ns);
}

Request SlaveScan::request() const {
  const std::uint16_t slave = position_field(position_);
  switch (stage_) {
    case Stage::kCount: return Request(Command::kBrd, address_of(0, kTypeReg), 1);
    case Stage::kStation: return Request(Command::kAprd, address_of(slave, kStationReg), 2);
    case Stage::kState: return Request(Command::kAprd, address_of(slave, kAlStatusReg), 6);
    case Stage::kEeprom: break;
  }
  return eeprom_.next();
}

SlaveScan::Progress SlaveScan::advance(std::int64_t now_ns) {
  exchange_.advance(now_ns);
  if (exchange_.progress() == Exchange::Progress::kBusy) return Progress::kBusy;
  if (exchange_.progress() != Exchange::Progress::kDone) return Progress::kLost;
  const Progress progress = take(exchange_.answer(), now_ns);
  if (progress == Progress::kBusy) exchange_.ask(request(), now_ns);
  return progress;
}

SlaveScan::Progress SlaveScan::take(const Answer& answer, std::int64_t) {
  switch (stage_) {
    case Stage::kCount: count_ = answer.counter; return Progress::kDone;
    case Stage::kStation:
      if (answer.counter != 1) return Progress::kLost;
      report_.station = answer.word();
      stage_ = Stage::kState;
      break;
    case Stage::kState:
      if (answer.counter != 1) return Progress::kLost;
      report_.al_status = answer.word();
      report_.al_code = answer.word(4);
      stage_ = Stage::kEeprom;
      words_.fill(0);
      read_ = 0;
      needed_ = kSiiCategories + 2;
      eeprom_.begin_at(position_, 0);
      break;
    case Stage::kEeprom:
      eeprom_.take(answer);
      if (eeprom_.progress() == SiiReader::Progress::kFailed) return Progress::kUnreadable;
      if (eeprom_.progress() == SiiReader::Progress::kDone && !take_words()) {
        parse();
        return Progress::kDone;
      }
  }
  return Progress::kBusy;
}

/// Reads on until the end of the categories. False: it has been reached.
bool SlaveScan::take_words() {
  words_[read_] = static_cast<std::uint16_t>(eeprom_.value());
  words_[read_ + 1] = static_cast<std::uint16_t>(eeprom_.value() >> 16);
  read_ += 2;
  // The head of the category that begins last within what has been read.
  for (std::size_t at = kSiiCategories; at + 2 <= read_;) {
    if (words_[at] == kSiiEnd) return false;
    at += 2 + std::size_t{words_[at + 1]};
    needed_ = at + 2;
  }
  if (read_ >= std::min(needed_, kWords)) return false;
  eeprom_.begin_at(position_, static_cast<std::uint16_t>(read_));
  return true;
}

void SlaveScan::parse() {
  const auto dword = [this](std::size_t at) {
    return std::uint32_t{words_[at + 1]} << 16 | words_[at];
  };
  report_.identity = {dword(kSiiVendor), dword(kSiiProduct), dword(kSiiRevision),
                      dword(kSiiSerial)};
  report_.coe = (words_[kSiiProtocols] & kSiiCoe) != 0;
  for (std::size_t at = kSiiCategories; at + 2 <= read_ && words_[at] != kSiiEnd;) {
    const std::size_t words = words_[at + 1], data = at + 2;
    if (data + words > read_) return;
    if (words_[at] == kSiiStrings) parse_name(data, words);
    if (words_[at] == kSiiRxPdos) parse_pdos(data, words, true);
    if (words_[at] == kSiiTxPdos) parse_pdos(data, words, false);
    at = data + words;
  }
}

/// The first string is the name, where the general category does not say otherwise: few do.
void SlaveScan::parse_name(std::size_t strings, std::size_t words) {
  const std::size_t at = 2 * strings, end = at + 2 * words;
  if (words == 0 || byte(at) == 0) return;
  const std::size_t size = std::min<std::size_t>(byte(at + 1), Text<63>::capacity());
  char text[Text<63>::capacity()];
  for (std::size_t i = 0; i < size; ++i)
    text[i] = at + 2 + i < end ? static_cast<char>(byte(at + 2 + i)) : ' ';
  report_.name = Text<63>(printable(std::string_view(text, size)));
}

void SlaveScan::parse_pdos(std::size_t data, std::size_t words, bool outputs) {
  auto& pdos = outputs ? report_.outputs : report_.inputs;
  int& count = outputs ? report_.output_count : report_.input_count;
  constexpr std::size_t kHead = 4, kEntry = 4;  // words
  for (std::size_t at = data; at + kHead <= data + words && count < SlaveReport::kMostPdos;) {
    SlaveReport::Pdo& pdo = pdos[static_cast<std::size_t>(count++)];
    pdo.index = words_[at];
    pdo.count = words_[at + 1] & 0xFF;
    at += kHead;
    for (int i = 0; i < pdo.count && at + kEntry <= data + words; ++i, at += kEntry) {
      const std::uint32_t bits = words_[at + 2] >> 8;
      const std::uint32_t sub = words_[at + 1] & 0xFFU;
      (void)pdo.layout.add(std::uint32_t{words_[at]} << 16 | sub << 8 | bits);
    }
  }
}

}  // namespace tactus::ethercat
