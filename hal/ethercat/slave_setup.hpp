// SlaveSetup: what is read from and written to one drive by SDO before its first cycle, as a list
// of steps: identity, read from all drives before the first is set up; the lines of the file,
// the facts it reports, then options, mode and PDOs, in the order that CoE demands: no PDO
// assigned, no entries, entries, their number, assignment. A drive whose PDOs cannot be changed is
// left as it is; what is then read back decides.
#pragma once

#include "hal/cia402/drive_facts.hpp"
#include "hal/cia402/setup_step.hpp"
#include "hal/ethercat/ethercat_settings.hpp"
#include "hal/ethercat/process_data.hpp"

namespace tactus::ethercat {

using cia402::SetupStep;

class SlaveSetup {
 public:
  static constexpr int kMaxSteps = 64;

  /// Lists the steps of a drive for commands of `mode`. [init]
  void begin(const EthercatSettings& ethercat, CommandMode mode, int period_us);
  int count() const { return count_; }
  /// Number of steps at the beginning that only read the identity of the drive. [init]
  int identifying() const { return identifying_; }
  const SetupStep& step(int i) const { return steps_[static_cast<std::size_t>(i)]; }

 private:
  void identity(const EthercatSettings& ethercat, CommandMode mode);
  void fact(std::uint32_t row);
  void facts();
  void options(CommandMode mode, int period_us);
  void sync0();
  void pdo(std::uint16_t assignment, std::uint16_t mapping, const MappedObjects& objects);
  void expect(std::uint16_t index, std::uint8_t sub, std::uint32_t value, const char* what,
              const char* remedy, std::uint32_t mask = 0xFFFFFFFF);
  void write(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes, std::uint32_t value,
             const char* what);
  void write(const cia402::Object& object, std::uint32_t value, const char* what) {
    write(object.index, object.sub, object.bytes, value, what);
  }

  std::array<SetupStep, kMaxSteps> steps_;
  int count_ = 0, identifying_ = 0;
};

/// Reads back what is assigned and mapped: names one object after the other and takes its value.
class MappingReader {
 public:
  static constexpr int kMostPdos = 8;

  void begin(ProcessData& data);
  bool done() const { return done_; }
  std::uint16_t index() const { return pdo_ < 0 ? assignment() : mapped_; }
  std::uint8_t sub() const { return static_cast<std::uint8_t>(pdo_ < 0 ? listed_ : entry_); }
  /// False: there are more objects than fit. [init]
  bool take(std::uint32_t value);

 private:
  std::uint16_t assignment() const { return static_cast<std::uint16_t>(inputs_ ? 0x1C13 : 0x1C12); }
  bool next_pdo();
  void next_direction();

  ProcessData* data_ = nullptr;
  bool inputs_ = false, done_ = true;
  std::array<std::uint16_t, kMostPdos> pdos_{};
  int listed_ = 0, pdos_count_ = 0;  // of the assignment: sub-index to read, and its number
  int pdo_ = -1;                     // of pdos_, -1: the assignment is being read
  int entry_ = 0, entries_ = 0;      // of its mapping
  std::uint16_t mapped_ = 0;
};

}  // namespace tactus::ethercat
