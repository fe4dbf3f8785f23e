// The degrade ladder: how the robot goes down when something is wrong, and from where it comes back
// by itself. Everything that can happen is a cause; the table says which rung it leads to from
// every rung. The rungs are the stop categories of IEC 60204-1:
//
//   nominal        everything runs
//   skip_optional  optional rows are left out; nothing moves otherwise than before
//   hold           category 2: brakes, then holds; the drives stay enabled
//   stop           category 1: brakes, then, at rest or after a bounded time, the drives are
//                  disabled
//   disabled       category 0: the drives are disabled at once
//
// A brake is on the path, or at once where the path itself is the danger; the cause says which, and
// a brake that has been at once is not on the path again.
// Below skip_optional only a rearm leads up again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/brake.hpp"
#include "kernel/hal.hpp"

namespace tactus {

enum class Rung : std::uint8_t { kNominal, kSkipOptional, kHold, kStop, kDisabled };

enum class Cause : std::uint8_t {
  kOverruns,  ///< too many cycles longer than the period within a window
  kClean,     ///< a stated number of cycles without an overrun
  kSlip,      ///< more periods missed in a row than are bridged
  kLongSlip,  ///< more than twice as many
  kClock,     ///< the clock stands, runs backwards or too fast
  kRow,       ///< a row beside the control chain returned a Status that is not kOk
  kSensor,    ///< a block found its sensor at fault
  kStage,     ///< a block's step returned any other Status that is not kOk
  kCommand,   ///< the guard found a command that is not finite
  kState,     ///< the guard found a measured state that must not be
  kLimiting,  ///< the guard limited the command in too many cycles
  kWire,      ///< reading or writing failed, or the robot could not be started
  kAtRest,    ///< a brake has come to rest
  kStopTime,  ///< a brake has not come to rest in time
  kHalt,      ///< somebody asked for a stop on the path
  kOff,       ///< somebody asked for the drives to be disabled
  kRearm,     ///< somebody said so, and the robot was at rest
};

inline constexpr std::size_t kRungs = 5, kCauses = 17;
inline constexpr std::array<const char*, kRungs> kRungNames = {"nominal", "skip_optional", "hold",
                                                               "stop", "disabled"};
inline constexpr std::array<const char*, kCauses> kCauseNames = {
    "overruns", "clean",    "slip", "long_slip", "clock",     "row",  "sensor", "stage", "command",
    "state",    "limiting", "wire", "at_rest",   "stop_time", "halt", "off",    "rearm"};

/// Where one cause leads from every rung. Where the chain cannot be evaluated any more, the guard
/// brakes positions and velocities within limits; nobody can brake efforts, and the drives are
/// disabled.
struct LadderRow {
  Cause cause;
  std::array<Rung, kRungs> to;
  bool chain;  ///< the chain can still be evaluated
  BrakeWay way;
};

// clang-format off
inline constexpr std::array<LadderRow, kCauses> kLadder = {{
    //                   nominal              skip_optional        hold             stop             disabled           chain  way
    {Cause::kOverruns, {Rung::kSkipOptional, Rung::kHold,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kClean,    {Rung::kNominal,      Rung::kNominal,      Rung::kHold,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kSlip,     {Rung::kHold,         Rung::kHold,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kLongSlip, {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kClock,    {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kRow,      {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kAtOnce},
    {Cause::kSensor,   {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, false, BrakeWay::kAtOnce},
    {Cause::kStage,    {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, false, BrakeWay::kAtOnce},
    {Cause::kCommand,  {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, false, BrakeWay::kAtOnce},
    {Cause::kState,    {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, false, BrakeWay::kAtOnce},
    {Cause::kLimiting, {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kWire,     {Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled, Rung::kDisabled, Rung::kDisabled}, false, BrakeWay::kAtOnce},
    {Cause::kAtRest,   {Rung::kNominal,      Rung::kSkipOptional, Rung::kHold,     Rung::kDisabled, Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kStopTime, {Rung::kNominal,      Rung::kSkipOptional, Rung::kStop,     Rung::kDisabled, Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kHalt,     {Rung::kStop,         Rung::kStop,         Rung::kStop,     Rung::kStop,     Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kOff,      {Rung::kDisabled,     Rung::kDisabled,     Rung::kDisabled, Rung::kDisabled, Rung::kDisabled}, true,  BrakeWay::kOnPath},
    {Cause::kRearm,    {Rung::kNominal,      Rung::kSkipOptional, Rung::kNominal,  Rung::kNominal,  Rung::kNominal},  true,  BrakeWay::kOnPath},
}};
// clang-format on

constexpr const LadderRow& rule(Cause cause) {
  return kLadder[static_cast<std::size_t>(cause)];
}

/// The rung after `cause`, for a robot that is commanded in `mode`. [any]
constexpr Rung next(Rung rung, Cause cause, CommandMode mode) {
  const LadderRow& row = rule(cause);
  if (!row.chain && mode == CommandMode::kEffort) return Rung::kDisabled;
  return row.to[static_cast<std::size_t>(rung)];
}

/// Below skip_optional: references are refused. [any]
constexpr bool refuses(Rung rung) {
  return rung >= Rung::kHold;
}
/// The arm is being brought to rest, or held there, by the cycle. [any]
constexpr bool brakes(Rung rung) {
  return rung == Rung::kHold || rung == Rung::kStop;
}

constexpr const char* name(Rung rung) {
  return kRungNames[static_cast<std::size_t>(rung)];
}
constexpr const char* name(Cause cause) {
  return kCauseNames[static_cast<std::size_t>(cause)];
}

namespace detail {
/// The table is in order, and leads up only where it may: from skip_optional when cycles are clean,
/// from anywhere below by a rearm.
constexpr bool ladder_is_sound() {
  for (std::size_t row = 0; row < kCauses; ++row) {
    const LadderRow& entry = kLadder[row];
    if (static_cast<std::size_t>(entry.cause) != row) return false;
    for (std::size_t from = 0; from < kRungs; ++from) {
      const bool up = static_cast<std::size_t>(entry.to[from]) < from;
      const bool may = entry.cause == Cause::kRearm || (entry.cause == Cause::kClean && from == 1);
      if (up && !may) return false;
      if (!entry.chain && entry.to[from] < Rung::kStop) return false;
    }
  }
  return true;
}
}  // namespace detail
static_assert(detail::ladder_is_sound());

}  // namespace tactus
