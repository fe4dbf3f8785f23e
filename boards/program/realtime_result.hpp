// RealtimeResult: what a run in real time came to beside its cycles, in summary.json and on the
// screen.
#pragma once

#include <cstdio>

#include "hal/os/realtime.hpp"
#include "kernel/histogram.hpp"

namespace tactus {

struct RealtimeResult {
  bool asked = false;            ///< false: the run was in virtual time, there is nothing to say
  RealtimeReport report;         ///< what the operating system granted
  Histogram latency;             ///< of the wake-ups, ns
  std::int64_t page_faults = 0;  ///< of the cycle's thread while cycles ran
};

/// Takes the steps of `settings` and warns of each that is refused, on the error stream. False:
/// one is, and the settings do not allow it.
bool prepare(Realtime& realtime, const RealtimeSettings& settings);

/// `  "realtime": {...},` of summary.json.
void write_realtime(std::FILE* file, const RealtimeResult& result);
/// The lines below the table of stages.
void print_realtime(const RealtimeResult& result);

}  // namespace tactus
