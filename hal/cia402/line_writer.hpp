// LineWriter: sets the objects of one joint's lines (object_lines.hpp) in its drive, over any wire:
// reads each object, writes it only if it is not as the line has it, because what a drive keeps in
// an EEPROM wears, and reads it back.
#pragma once

#include <cstddef>

#include "hal/cia402/drive_facts.hpp"

namespace tactus::cia402 {

/// Result of an SDO transfer.
struct TransferResult {
  bool done = false;        ///< false: the drive, or the wire, has aborted it
  bool size_known = false;  ///< the drive has indicated the size of the object
  std::size_t bytes = 0;    ///< of the object that was read
  std::uint32_t value = 0;
};

class LineWriter {
 public:
  /// Begins with the first line of a joint, from 0, and notes what is written in `findings`; both
  /// must outlive the writer. [init]
  void begin(const ObjectLines& lines, int joint, StartupFindings& findings);
  /// True if no line of the joint is left. [init]
  bool done() const { return at_ == lines_->count(); }
  /// The line whose object is to be transferred next; reads(): from the drive. [init]
  const ObjectLine& line() const { return (*lines_)[at_]; }
  bool reads() const { return stage_ != Stage::kWrite; }
  /// Takes the end of that transfer. kRefusedByRobot: `why` has line, object and value; for an
  /// abort, its reason is to be added. [init]
  Status take(const TransferResult& transfer, Message& why);
  /// True if a line has changed the drive. [init]
  bool changed() const { return changed_; }

 private:
  enum class Stage : std::uint8_t { kCompare, kWrite, kReadBack };

  void next(int from);
  Status refuse(const TransferResult& transfer, Message& why) const;

  const ObjectLines* lines_ = nullptr;
  StartupFindings* findings_ = nullptr;
  int joint_ = 0, at_ = 0;
  Stage stage_ = Stage::kCompare;
  bool changed_ = false;
};

/// Returns the change by the n-th line, from 0, among those that changed a drive, such as "2003h:1
/// = 5 written to the drives of joints 1, 3; stored in 3"; empty after the last. [init]
Message written_text(const ObjectLines& lines, const StartupFindings& findings, int n);

}  // namespace tactus::cia402
