// NodeSetup: what is read from and written to one drive by SDO before its first PDO, as a list of
// steps: identity, read from all drives before the first is set up; the lines of the file,
// the facts it reports, then watchdogs, PDOs and mode. Everything that is written to the
// PDOs is read back. PDOs are changed in the order that CiA 301 demands (7.5.2.36): invalid, no
// entries, entries, their number, parameters, valid.
#pragma once

#include "hal/can/pdo_layout.hpp"
#include "hal/cia402/drive_facts.hpp"
#include "hal/cia402/setup_step.hpp"

namespace tactus::can {

using cia402::SetupStep;

class NodeSetup {
 public:
  static constexpr int kMaxSteps = 144;

  /// Lists the steps of a drive with PDOs for `mode`. [init]
  void begin(const CanSettings& can, const PdoLayout& layout, const Slot& slot, CommandMode mode,
             int period_us);

  int count() const { return count_; }
  /// Number of steps at the beginning that only read the identity of the drive. [init]
  int identifying() const { return identifying_; }
  const SetupStep& step(int i) const { return steps_[static_cast<std::size_t>(i)]; }

 private:
  using Kind = SetupStep::Kind;

  void identity(const CanSettings& can, CommandMode mode);
  void fact(std::uint32_t row);
  void facts();
  void watchdogs(const CanSettings& can, int period_us);
  void pdos(const CanSettings& can, const PdoLayout& layout, const Slot& slot, int period_us);
  void pdo(std::uint16_t communication, std::uint16_t mapping, const Pdo& pdo, int timeout_ms);
  void unused(std::uint16_t communication, std::uint16_t id);
  void expect(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes, std::uint32_t value,
              const char* what, const char* remedy, std::uint32_t mask = 0xFFFFFFFF);
  void write(Kind kind, std::uint16_t index, std::uint8_t sub, std::uint8_t bytes,
             std::uint32_t value, const char* what);
  void write(Kind kind, const cia402::Object& object, std::uint32_t value, const char* what);

  std::array<SetupStep, kMaxSteps> steps_;
  int count_ = 0, identifying_ = 0;
};

}  // namespace tactus::can
