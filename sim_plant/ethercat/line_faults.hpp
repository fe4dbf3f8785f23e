// Faults of an emulated EtherCAT line: what, where, and when by the count of periods of the plant.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <random>

#include "hal/ethercat/protocol_esc.hpp"

namespace tactus::segment {

enum class LineFaultKind : std::uint8_t {
  kBreak,    ///< the cable behind slave `slave` is open; 0: before the first
  kLose,     ///< frames with outputs do not come back
  kDelay,    ///< each comes back with the next one
  kCounter,  ///< `value` is added to the working counters of logical datagrams
  kFall,     ///< slave `slave` falls to SAFEOP with AL status code `value`; once
};

/// Names of the kinds in their order, as the program's option has them.
inline constexpr std::array<const char*, 5> kLineFaultNames = {"break", "lose", "delay", "counter",
                                                               "fall"};

struct LineFault {
  LineFaultKind kind = LineFaultKind::kBreak;
  int slave = 0;                                                  ///< from 1
  std::int64_t at = 0;                                            ///< active from this period on
  std::int64_t until = std::numeric_limits<std::int64_t>::max();  ///< and before this one
  double probability = 1.0;                                       ///< at each occasion
  std::uint16_t value = 0;
};

/// The faults of a line. The same seed gives the same faults.
class LineFaults {
 public:
  static constexpr std::size_t kMost = 16;

  void seed(std::uint64_t seed) {
    count_ = 0;
    done_ = {};
    random_.seed(seed);
  }
  bool add(const LineFault& fault) {
    if (count_ == kMost) return false;
    faults_[count_++] = fault;
    return true;
  }
  void clear() {
    count_ = 0;
    done_ = {};
  }
  /// Returns the fault of a kind that is active now, or null. Each call is an occasion. [any]
  const LineFault* active(LineFaultKind kind, std::int64_t periods) {
    for (std::size_t i = 0; i < count_; ++i)
      if (concerns(faults_[i], kind, periods) && happens(faults_[i])) return &faults_[i];
    return nullptr;
  }
  /// As active(), for faults that happen once; each has then happened. [any]
  const LineFault* once(LineFaultKind kind, std::int64_t periods) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (done_[i] || !concerns(faults_[i], kind, periods) || !happens(faults_[i])) continue;
      done_[i] = true;
      return &faults_[i];
    }
    return nullptr;
  }

 private:
  static bool concerns(const LineFault& fault, LineFaultKind kind, std::int64_t periods) {
    return fault.kind == kind && periods >= fault.at && periods < fault.until;
  }
  bool happens(const LineFault& fault) {
    if (fault.probability >= 1.0) return true;
    return static_cast<double>(random_() >> 11) * 0x1p-53 < fault.probability;
  }

  std::array<LineFault, kMost> faults_{};
  std::array<bool, kMost> done_{};
  std::size_t count_ = 0;
  std::mt19937_64 random_;
};

}  // namespace tactus::segment
