// Summary: the result of a run, as summary.json and as the table on the screen.
#pragma once

#include <cstdint>

#include "program/results/expectation.hpp"
#include "program/results/realtime_result.hpp"
#include "program/results/tracking_error.hpp"
#include "program/session/goal_watch.hpp"

namespace tactus {

struct RunResult {
  int code = 0;  ///< 0: succeeded; else a Status, or kEndedOtherwise
  const char* name = "succeeded";
  Status fault = Status::kOk;   ///< the Status that ended the run, if one did
  Reason why;                   ///< of a goal that was not reached, in words
  Rung rung = Rung::kDisabled;  ///< after the last cycle
  const OverrideOptions* overrides = nullptr;
  std::uint64_t seed = 0, config_hash = 0, heap_allocations = 0;
  int starved = 0;           ///< times that the arm waited on its path for the trajectory file
  double stretch = 0.0;      ///< time added to the trajectory, as a fraction
  SmoothingTolerance moved;  ///< how far its positions were moved at most, to smooth it
  double wall_s = 0.0, simulated_s = 0.0;
  std::int64_t cycles = 0;  ///< in which the arm was commanded
  std::array<TrackingError, kMaxTracking> tracking;
  int tracking_count = 0;
  Expectation expectation;
  RealtimeResult realtime;
};

/// Writes summary.json. False if the file cannot be written: prints the reason to stderr.
bool write_summary(const char* path, std::string_view pipeline, const Session& session,
                   const RunResult& result);

/// Prints result, tracking errors, times, events and counters.
void print_table(std::string_view pipeline, const Session& session, const RunResult& result);

}  // namespace tactus
