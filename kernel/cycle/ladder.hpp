// The degrade ladder: how the robot stops in stages when something is wrong, and from where it
// recovers by itself. Every event is a cause; the table gives the rung to which it leads from every
// rung. The rungs are the stop categories of IEC 60204-1:
//
//   nominal        everything runs
//   skip_optional  optional rows are skipped; the motion does not change
//   hold           category 2: brakes, then holds; the drives stay enabled
//   stop           category 1: brakes, then, at rest or after a bounded time, the drives are
//                  disabled
//   arming         the drives are becoming enabled and hold their joints; the arm is not commanded
//   disabled       category 0: the drives are disabled at once
//
// A brake is on the path, or at once if the path itself is the danger. The cause decides which; a
// brake at once never returns to the path. Below skip_optional only arming leads up again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/core/brake.hpp"
#include "kernel/core/hal.hpp"
#include "kernel/core/names.hpp"
#include "kernel/cycle/rung.hpp"

namespace tactus {

enum class Cause : std::uint8_t {
  kOverruns,  ///< too many cycles longer than the period within a window
  kClean,     ///< a stated number of cycles without an overrun
  kSlip,      ///< more periods missed in a row than are bridged
  kLongSlip,  ///< more than twice as many
  kClock,     ///< the clock stops, runs backwards or too fast
  kRow,       ///< a row other than the control chain returned a Status that is not kOk
  kSensor,    ///< a block found its sensor at fault
  kStage,     ///< a block's step returned any other Status that is not kOk
  kCommand,   ///< the guard found a command that is not finite
  kState,     ///< the guard refused the measured state
  kLimiting,  ///< the guard limited the command in too many cycles
  kWire,      ///< reading or writing failed
  kDrive,     ///< a drive is not enabled, or could not be armed
  kAtRest,    ///< a brake has come to rest
  kStopTime,  ///< a brake has not come to rest in time
  kHalt,      ///< a stop on the path was requested
  kOff,       ///< disabling the drives was requested
  kMoved,     ///< an arm that was held at rest has moved
  kArm,       ///< arming the drives was requested
  kArmTime,   ///< the drives are not enabled, or the arm is not at rest, in time
  kRearm,     ///< the arm is commanded again
  kRefused,   ///< connecting or arming was refused
  kOldFault,  ///< a drive stood in fault before it was armed, which clears it
  kWarning,   ///< a drive warns
};

constexpr const char* name(Cause cause) {
  switch (cause) {
    case Cause::kOverruns: return "overruns";
    case Cause::kClean: return "clean";
    case Cause::kSlip: return "slip";
    case Cause::kLongSlip: return "long_slip";
    case Cause::kClock: return "clock";
    case Cause::kRow: return "row";
    case Cause::kSensor: return "sensor";
    case Cause::kStage: return "stage";
    case Cause::kCommand: return "command";
    case Cause::kState: return "state";
    case Cause::kLimiting: return "limiting";
    case Cause::kWire: return "wire";
    case Cause::kDrive: return "drive";
    case Cause::kAtRest: return "at_rest";
    case Cause::kStopTime: return "stop_time";
    case Cause::kHalt: return "halt";
    case Cause::kOff: return "off";
    case Cause::kMoved: return "moved";
    case Cause::kArm: return "arm";
    case Cause::kArmTime: return "arm_time";
    case Cause::kRearm: return "rearm";
    case Cause::kRefused: return "refused";
    case Cause::kOldFault: return "old_fault";
    case Cause::kWarning: return "warning";
  }
  return nullptr;
}

inline constexpr std::size_t kRungs = kNames<Rung>.size(), kCauses = kNames<Cause>.size();

/// The rungs to which one cause leads from every rung. If the chain can no longer be evaluated, the
/// guard brakes positions and velocities within limits; efforts cannot be braked, and the drives
/// are disabled.
struct LadderRow {
  Cause cause;
  std::array<Rung, kRungs> to;
  bool chain;  ///< the chain can still be evaluated
  BrakeWay way;
};

// clang-format off
inline constexpr std::array<LadderRow, kCauses> kLadder = {{
    //                  nominal              skip_optional        hold                 stop                 arming               disabled              chain  way
    {Cause::kOverruns, {Rung::kSkipOptional, Rung::kHold,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kClean,    {Rung::kNominal,      Rung::kNominal,      Rung::kHold,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kSlip,     {Rung::kHold,         Rung::kHold,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kLongSlip, {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kClock,    {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kDisabled,     Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kRow,      {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kAtOnce},
    {Cause::kSensor,   {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     false, BrakeWay::kAtOnce},
    {Cause::kStage,    {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     false, BrakeWay::kAtOnce},
    {Cause::kCommand,  {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     false, BrakeWay::kAtOnce},
    {Cause::kState,    {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     false, BrakeWay::kAtOnce},
    {Cause::kLimiting, {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kWire,     {Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled},     false, BrakeWay::kAtOnce},
    {Cause::kDrive,    {Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled},     false, BrakeWay::kAtOnce},
    {Cause::kAtRest,   {Rung::kNominal,      Rung::kSkipOptional, Rung::kHold,         Rung::kDisabled,     Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kStopTime, {Rung::kNominal,      Rung::kSkipOptional, Rung::kStop,         Rung::kDisabled,     Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kHalt,     {Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kStop,         Rung::kDisabled,     Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kOff,      {Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kMoved,    {Rung::kNominal,      Rung::kSkipOptional, Rung::kStop,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kArm,      {Rung::kNominal,      Rung::kSkipOptional, Rung::kHold,         Rung::kStop,         Rung::kArming,       Rung::kArming},       true,  BrakeWay::kOnPath},
    {Cause::kArmTime,  {Rung::kNominal,      Rung::kSkipOptional, Rung::kHold,         Rung::kStop,         Rung::kDisabled,     Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kRearm,    {Rung::kNominal,      Rung::kSkipOptional, Rung::kNominal,      Rung::kStop,         Rung::kNominal,      Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kRefused,  {Rung::kNominal,      Rung::kSkipOptional, Rung::kHold,         Rung::kStop,         Rung::kDisabled,     Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kOldFault, {Rung::kNominal,      Rung::kSkipOptional, Rung::kHold,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
    {Cause::kWarning,  {Rung::kNominal,      Rung::kSkipOptional, Rung::kHold,         Rung::kStop,         Rung::kArming,       Rung::kDisabled},     true,  BrakeWay::kOnPath},
}};
// clang-format on

constexpr const LadderRow& rule(Cause cause) {
  return kLadder[static_cast<std::size_t>(cause)];
}

/// Returns the rung after `cause` for a robot that is commanded in `mode`. [any]
constexpr Rung next(Rung rung, Cause cause, CommandMode mode) {
  const LadderRow& row = rule(cause);
  if (!row.chain && mode == CommandMode::kEffort) return Rung::kDisabled;
  return row.to[static_cast<std::size_t>(rung)];
}

/// True below skip_optional: references are refused. [any]
constexpr bool refuses(Rung rung) {
  return rung >= Rung::kHold;
}
/// True if the cycle brings the arm to rest or holds it there. [any]
constexpr bool brakes(Rung rung) {
  return rung == Rung::kHold || rung == Rung::kStop;
}
/// True if the drives follow commands. [any]
constexpr bool commands(Rung rung) {
  return rung <= Rung::kStop;
}

namespace detail {
/// True if the table is in order and leads up only where it may: from skip_optional when cycles are
/// clean, from disabled by arming, and from hold and arming by a rearm.
constexpr bool ladder_is_sound() {
  for (std::size_t row = 0; row < kCauses; ++row) {
    const LadderRow& entry = kLadder[row];
    if (static_cast<std::size_t>(entry.cause) != row) return false;
    for (std::size_t from = 0; from < kRungs; ++from) {
      const bool up = static_cast<std::size_t>(entry.to[from]) < from;
      const auto rung = static_cast<Rung>(from);
      const bool may =
          (entry.cause == Cause::kClean && rung == Rung::kSkipOptional) ||
          (entry.cause == Cause::kArm && rung == Rung::kDisabled) ||
          (entry.cause == Cause::kRearm && (rung == Rung::kHold || rung == Rung::kArming));
      if (up && !may) return false;
      if (!entry.chain && entry.to[from] < Rung::kStop) return false;
    }
  }
  return true;
}
}  // namespace detail
static_assert(detail::ladder_is_sound());

}  // namespace tactus
