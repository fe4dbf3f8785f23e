// Homing: the state of the homing of one drive, and its statusword (CiA 402-2 /
// IEC 61800-7-201, homing mode).
//
// The mode is requested (6060h) and awaited (6061h), the method written (6098h); the drive is
// enabled, its brake opens, and bit 4 of the controlword starts it. Statusword bit 13 is an error;
// bits 12 and 10 together without it mean that the drive is homed. Then it is disabled, and the
// mode of the commands requested and awaited.
#pragma once

#include <cstdint>

#include "hal/cia402/protocol.hpp"

namespace tactus::cia402 {

struct Homing {
  /// Samples in a row that must show the same end: what is left of an earlier homing goes when the
  /// drive has taken the new start.
  static constexpr int kSure = 5;

  enum class Step : std::uint8_t {
    kSelect,    ///< writes the mode
    kSelected,  ///< until the drive shows it
    kMethod,    ///< writes the method
    kEnable,
    kRelease,  ///< the brake opens
    kMove,     ///< until the drive has ended
    kDisable,
    kReturn,    ///< writes the mode of the commands
    kReturned,  ///< until the drive shows it
  };
  enum class Verdict : std::uint8_t { kGoesOn, kAttained, kErrorMoving, kErrorAtRest };

  Step step = Step::kSelect;
  int joint = -1;
  bool answered = false;  ///< the request of this step was answered
  Mode shown = Mode::kNone;
  std::int64_t since_ns = 0;  ///< in this step
  std::uint32_t homed = 0;    ///< bit j: joint j was homed in this arming
  Verdict verdict = Verdict::kGoesOn;
  int samples = 0;  ///< in a row with this verdict

  bool enables() const { return step >= Step::kEnable && step <= Step::kMove; }
  /// The drive is enabled, and must stay so.
  bool operates() const { return step == Step::kRelease || step == Step::kMove; }
  bool returns() const { return step >= Step::kReturn; }

  /// Judges a sample of the statusword. [cyclic]
  static Verdict verdict_of(std::uint16_t word) {
    const bool reached = (word & kTargetReached) != 0;
    if ((word & kHomingError) != 0) return reached ? Verdict::kErrorAtRest : Verdict::kErrorMoving;
    return reached && (word & kHomingAttained) != 0 ? Verdict::kAttained : Verdict::kGoesOn;
  }
  /// Takes a sample; returns the verdict of the last kSure. [cyclic]
  Verdict take(std::uint16_t word) {
    const Verdict now = verdict_of(word);
    samples = now == verdict ? samples + (samples < kSure) : 1;
    verdict = now;
    return samples == kSure ? now : Verdict::kGoesOn;
  }
  /// Begins the message of a request that was refused. [cyclic]
  const char* refused_text() const {
    switch (step) {
      case Step::kMethod: return "its homing method (6098h) cannot be written: ";
      case Step::kSelected:
      case Step::kReturned: return "its display of the mode of operation (6061h) cannot be read: ";
      default: return "its mode of operation (6060h) cannot be written: ";
    }
  }
};

}  // namespace tactus::cia402
