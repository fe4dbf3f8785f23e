// SlaveScan: what one slave of a line shows without being changed: state, identity, and the name
// and the PDOs in its EEPROM. A sequence of single datagrams; frames in, frames out, time passed
// in.
#pragma once

#include "hal/ethercat/process_data.hpp"
#include "hal/ethercat/slave.hpp"

namespace tactus::ethercat {

struct SlaveReport {
  static constexpr int kMostPdos = 8;

  struct Pdo {
    std::uint16_t index = 0;
    int count = 0;  ///< of entries; more than the layout has: it has no room
    ProcessLayout layout;
  };

  std::uint16_t station = 0, al_status = 0, al_code = 0;
  Identity identity;
  bool coe = false;
  Text<63> name;
  std::array<Pdo, kMostPdos> outputs, inputs;
  int output_count = 0, input_count = 0;
};

class SlaveScan {
 public:
  static constexpr std::size_t kWords = 2048;  ///< of an EEPROM that are read

  enum class Progress : std::uint8_t { kBusy, kDone, kLost, kUnreadable };

  Exchange& exchange() { return exchange_; }
  /// Begins to count the slaves; when done, count() has them. [init]
  void begin_count(std::int64_t now_ns);
  /// Begins with the slave at a place in the line, from 0. [init]
  void begin(int position, std::int64_t now_ns);
  Progress advance(std::int64_t now_ns);  ///< [init]

  int count() const { return count_; }
  const SlaveReport& report() const { return report_; }

 private:
  enum class Stage : std::uint8_t { kCount, kStation, kState, kEeprom };

  Progress take(const Answer& answer, std::int64_t now_ns);
  Request request() const;
  bool take_words();
  void parse();
  void parse_name(std::size_t strings, std::size_t words);
  void parse_pdos(std::size_t at, std::size_t words, bool outputs);
  std::uint8_t byte(std::size_t at) const {
    return static_cast<std::uint8_t>(words_[at / 2 % kWords] >> (8 * (at % 2)));
  }

  Exchange exchange_;
  SiiReader eeprom_;
  Stage stage_ = Stage::kCount;
  int position_ = 0, count_ = 0;
  SlaveReport report_;
  std::array<std::uint16_t, kWords> words_{};
  std::size_t read_ = 0, needed_ = 0;  // words
};

}  // namespace tactus::ethercat
