// AsyncProgress: the register in which ur_rtde's program reports the progress of an operation that
// the client does not wait for. A value >= 0 is progress, 0 at the beginning; a negative value is
// the end.
//
//   until 2022   the value itself; its end -1 and -2 in turn
//   since        | operation, 7 bits | - | writes, 7 bits | running, 1 bit | progress, 15 bits |
#pragma once

#include <algorithm>
#include <cstdint>

namespace tactus::ur {

class AsyncProgress {
 public:
  enum class Coding : std::uint8_t { kNone, kValue, kCounted };

  explicit AsyncProgress(Coding coding = Coding::kNone) : coding_(coding) {}

  bool told() const { return coding_ != Coding::kNone; }
  /// True if an aborted operation is reported as ended. [any]
  bool tells_broken_off() const { return coding_ == Coding::kCounted; }

  /// Returns the content of the register for a value. [cyclic]
  std::int32_t write(std::int32_t value) {
    const bool running = value >= 0;
    if (coding_ == Coding::kValue) return running ? value : (ended_ = ended_ == -1 ? -2 : -1);
    writes_ = (writes_ + 1) & kMostCounted;
    if (value == 0) operation_ = (operation_ + 1) & kMostCounted;
    return operation_ << 24 | writes_ << 16 |
           (running ? kRunning | std::min(value, kRunning - 1) : 0);
  }

 private:
  static constexpr std::int32_t kMostCounted = 127, kRunning = 1 << 15;
  Coding coding_;
  std::int32_t ended_ = -2;
  std::int32_t writes_ = 0, operation_ = 0;
};

}  // namespace tactus::ur
