// SiiReader: reads two words of a slave's EEPROM at a time through its registers.
#pragma once

#include "hal/ethercat/exchange.hpp"
#include "hal/ethercat/protocol_esc.hpp"
#include "hal/ethercat/protocol_sii.hpp"

namespace tactus::ethercat {

class SiiReader {
 public:
  static constexpr int kPolls = 1000;  ///< of a busy EEPROM

  enum class Progress : std::uint8_t { kBusy, kDone, kFailed };

  void begin(std::uint16_t station, std::uint16_t word) {
    station_ = station;
    by_position_ = false;
    word_ = word;
    asked_ = false;
    polls_ = 0;
    progress_ = Progress::kBusy;
  }
  /// As begin(), for a slave without a station address, by its place in the line, from 0.
  void begin_at(int position, std::uint16_t word) {
    begin(position_field(position), word);
    by_position_ = true;
  }
  Request next() const {
    const std::uint32_t control = address_of(station_, kEepromControlReg);
    if (asked_) return Request(by_position_ ? Command::kAprd : Command::kFprd, control, 10);
    Request request(by_position_ ? Command::kApwr : Command::kFpwr, control, 6);
    put(request.data.data(), kEepromRead);
    put(request.data.data() + 2, std::uint32_t{word_});
    return request;
  }
  void take(const Answer& answer) {
    if (!asked_) {
      asked_ = answer.counter == 1;
      if (!asked_) fail("the slave does not answer");
      return;
    }
    const std::uint16_t control = answer.word();
    const bool failed = answer.counter != 1 || (control & kEepromErrorBits) != 0;
    const bool busy = (control & kEepromBusy) != 0;
    control_ = answer.counter == 1 ? control : std::uint16_t{0};
    if (failed) fail(cause_of(answer.counter, control));
    if (!failed && busy && ++polls_ == kPolls) fail("it stays busy");
    if (failed || busy) return;
    value_ = get<std::uint32_t>(answer.data + 6);
    progress_ = Progress::kDone;
  }
  /// Why it failed; the word, and what its control register (0502h) shows. [any]
  const char* cause() const { return cause_; }
  std::uint16_t word() const { return word_; }
  std::uint16_t control() const { return control_; }
  Progress progress() const { return progress_; }
  /// The word at the lower address is the lower half. [any]
  std::uint32_t value() const { return value_; }

 private:
  static const char* cause_of(int counter, std::uint16_t control) {
    if (counter != 1) return "the slave does not answer";
    if ((control & kEepromError) != 0) return "it does not acknowledge (NACK)";
    return "writing to it is not enabled";
  }
  void fail(const char* cause) {
    cause_ = cause;
    progress_ = Progress::kFailed;
  }

  std::uint16_t station_ = 0, word_ = 0, control_ = 0;
  const char* cause_ = "";
  bool asked_ = false, by_position_ = false;
  int polls_ = 0;
  std::uint32_t value_ = 0;
  Progress progress_ = Progress::kDone;
};

}  // namespace tactus::ethercat
