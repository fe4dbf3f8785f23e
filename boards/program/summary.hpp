// Summary: what a run came to, as summary.json and as the table on the screen.
#pragma once

#include <cstdint>

#include "boards/program/realtime_result.hpp"
#include "boards/program/session.hpp"
#include "boards/program/tracking_error.hpp"

namespace tactus {

struct RunResult {
  int code = 0;  ///< 0 succeeded, else the Status or the Outcome that ended the run
  const char* name = "succeeded";
  Rung rung = Rung::kDisabled;  ///< on which the last cycle left it
  std::uint64_t seed = 0, config_hash = 0, heap_allocations = 0;
  double stretch = 0.0;  ///< of its trajectory
  double wall_s = 0.0, simulated_s = 0.0;
  std::array<TrackingError, kMaxTracking> tracking;
  int tracking_count = 0;
  RealtimeResult realtime;
};

/// False if the file cannot be written.
bool write_summary(const char* path, std::string_view pipeline, const Session& session,
                   const RunResult& result);

void print_table(std::string_view pipeline, const Session& session, const RunResult& result);

}  // namespace tactus
